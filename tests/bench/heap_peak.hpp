// How much heap this program has in use, and the most it had: every malloc and free of it and of its
// libraries is counted (Eigen does not allocate by operator new). glibc only.
#pragma once

#include <cstddef>

namespace ballbar::bench {

std::size_t heap_in_use();
std::size_t heap_peak();
void restart_heap_peak();  // from what is in use now

}  // namespace ballbar::bench
