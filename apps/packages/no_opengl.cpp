// OpenCV asks for the functions of OpenGL here, once it shows a window. ballbar shows none, and without this function the
// program in the package would need all of OpenGL for it.

extern "C" void* glXGetProcAddressARB(const unsigned char* /*name*/) { return nullptr; }
