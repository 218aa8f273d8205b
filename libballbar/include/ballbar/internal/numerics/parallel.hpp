// Runs independent parts of work on all cores.
#pragma once

#include <cstddef>
#include <functional>

namespace ballbar {

// Calls part(i) for every i < count, in any order, from several threads. Each part must write only to its own place;
// then the result does not depend on the number of threads. If a part throws, no further part starts, and the exception
// is rethrown when the running parts have ended; of several exceptions the one with the lowest i. Each part starts with
// a check for an Interruption. Nested calls run sequentially.
void in_parallel(std::size_t count, const std::function<void(std::size_t)>& part);

}  // namespace ballbar
