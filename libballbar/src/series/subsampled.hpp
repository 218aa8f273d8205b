// A long series with fewer values of its target.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "ballbar/series/series.hpp"

namespace ballbar {

inline constexpr std::size_t kMostTested = 1500;  // values of the target in a preflight

// The same rows with every k-th value of the target, so that at most `most` remain, and gaps elsewhere. In addition 3 k
// values, at most 120, are kept on either side of each moment in `whole_about_s`. Inputs stay complete, so that effects
// do not change. Means are not used: the mean of correlated noise is another kind of noise, and an effect of means is
// not the mean of the effect.
Series subsampled(const Series& data, const std::string& target, std::size_t most,
                  std::span<const double> whole_about_s = {});

}  // namespace ballbar
