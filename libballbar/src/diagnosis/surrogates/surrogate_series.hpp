// The best surrogate of an effect on a drift series: what a curve without any cause would buy.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "ballbar/model/bound_effect.hpp"
#include "ballbar/series/series.hpp"
#include "diagnosis/statistics/likelihood_ratio.hpp"

namespace ballbar {

struct SurrogateSource {
  BoundEffect bound;
  std::vector<std::vector<double>> points;  // all parameters of each shape that has surrogates
  Eigen::VectorXd added_um;                 // n: what the effect adds as it was fitted; of recordings
};

// The best of `count` surrogates: what the effect adds with random phases, the same spectrum and no cause.
struct BestSurrogate {
  double gain = 0.0;  // largest fall of chi^2
  double fall = 0.0;  // largest relative fall of the RMSE by least squares
};
BestSurrogate best_surrogate(const SurrogateSource& effect, const Series& data, const LinearisedFit& linearised,
                             const Noise& noise, std::size_t count, std::uint64_t seed);

}  // namespace ballbar
