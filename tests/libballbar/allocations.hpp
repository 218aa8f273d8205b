// How often memory was taken so far, by new: a program that links allocations.cpp counts it.
#pragma once

#include <cstddef>

namespace ballbar {

std::size_t allocations();

}  // namespace ballbar
