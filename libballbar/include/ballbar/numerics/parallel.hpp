// Work that falls into independent parts, shared out among the processor's cores.
#pragma once

#include <cstddef>
#include <functional>

namespace ballbar {

// part(i) for every i < count, in no order, by several threads at a time. Parts write to places of their own alone, so
// that nothing depends on the number of threads. Once one throws, no more are begun, and it is thrown here when those
// that were begun have ended: of several the first by i. Interruption is asked before each part. Parts that are shared
// out once more run one after the other.
void in_parallel(std::size_t count, const std::function<void(std::size_t)>& part);

}  // namespace ballbar
