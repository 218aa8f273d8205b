// The best surrogate of an effect on a drift series: what a curve without any cause would buy.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "ballbar/model/bound_effect.hpp"
#include "ballbar/series/series.hpp"
#include "fit/model_columns.hpp"

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
// What they are added to.
struct Background {
  std::vector<std::size_t> row;                                        // n, of the data
  std::function<Eigen::MatrixXd(const Eigen::MatrixXd&)> whiten = {};  // n by k
  Freed white, plain;                                                  // columns that are there, and what they leave
};

BestSurrogate best_surrogate(const SurrogateSource& effect, const Series& data, const Background& background,
                             std::size_t count, std::uint64_t seed);

}  // namespace ballbar
