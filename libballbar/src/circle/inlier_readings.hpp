// Recordings without the readings that a robust fit discounted.
#pragma once

#include <cstddef>
#include <vector>

#include "ballbar/circle/recording.hpp"

namespace ballbar {

// `discounted` rising, numbers of readings. Times are dropped too.
Recording without(const Recording& recording, const std::vector<std::size_t>& discounted);

// Rising union of two rising lists.
std::vector<std::size_t> in_either(const std::vector<std::size_t>& first, const std::vector<std::size_t>& second);

}  // namespace ballbar
