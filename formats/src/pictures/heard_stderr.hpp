// The decoders of PNG and JPEG write what they find wrong to the standard error and let the program go on with a
// picture that is half made up. There is no other way to hear it.
#pragma once

#include <functional>
#include <string>

namespace ballbar {

// Runs `work` with the process's standard error kept in a nameless file, and returns the first line that was written,
// printable and without "libpng error: " or a full stop. Where no such file can be made, "" and the words go out as
// ever. For one thread at a time; a lock sees to that.
std::string heard_stderr(const std::function<void()>& work);

}  // namespace ballbar
