// `ballbar history` with Dask: a table that is kept, workers, file systems of a cloud. The package of Python does it.
#pragma once

#include <string>
#include <vector>

namespace ballbar {

// Ends this process, in whose place Python runs the command with these words. Throws Error where there is no Python.
void run_in_python(const std::vector<std::string>& words);

}  // namespace ballbar
