// What OpenCV, linked into the program, would use other libraries for. It paints a colour scale and a few letters:
// without these functions the package would need OpenGL, for windows, and TBB, for threads.
#include <opencv2/core/utility.hpp>

extern "C" void* glXGetProcAddressARB(const unsigned char* /*name*/) { return nullptr; }

namespace cv {

// All in one thread, in the place of OpenCV's parallel.cpp.
ParallelLoopBody::~ParallelLoopBody() = default;
void parallel_for_(const Range& range, const ParallelLoopBody& body, double /*stripes*/) {
  if (range.start < range.end) body(range);
}
int getNumThreads() { return 1; }
int getThreadNum() { return 0; }
int getNumberOfCPUs() { return 1; }
void setNumThreads(int /*threads*/) {}

}  // namespace cv
