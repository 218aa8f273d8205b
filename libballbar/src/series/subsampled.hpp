// A long series with fewer values of its target.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "ballbar/series/series.hpp"

namespace ballbar {

inline constexpr std::size_t kMostTested = 1500;  // values of the target, as diagnose() searches

// The same rows, the target kept at every k-th of its values, so that at most `most` are left, and a gap elsewhere.
// Beside these 3 k values to either side of each moment of `whole_about_s` are kept, of a very long series 120 of them.
// Inputs stay whole: effects run on them as before. Not means: a mean of noise with a memory has another kind of noise,
// and an effect of means is not the mean of the effect.
Series subsampled(const Series& data, const std::string& target, std::size_t most,
                  std::span<const double> whole_about_s = {});

}  // namespace ballbar
