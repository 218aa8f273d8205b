// What effects without any cause would buy on a drift series.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "ballbar/model/bound_effect.hpp"
#include "ballbar/series/series.hpp"
#include "diagnosis/statistics/likelihood_ratio.hpp"

namespace ballbar {

struct FakedEffect {
  BoundEffect bound;
  std::vector<std::vector<double>> points;  // all parameters of each shape to be faked
  Eigen::VectorXd added_um;                 // n: what the effect adds as it was fitted; of recordings
};

// The best of `count` fakes: what the effect adds with its phases scrambled, the same spectrum and no cause.
struct BestFake {
  double gain = 0.0;  // largest fall of chi^2
  double fall = 0.0;  // largest relative fall of the RMSE by least squares
};
BestFake best_fake(const FakedEffect& effect, const Series& data, const Leftover& leftover, const Noise& noise,
                   std::size_t count, std::uint64_t seed);

}  // namespace ballbar
