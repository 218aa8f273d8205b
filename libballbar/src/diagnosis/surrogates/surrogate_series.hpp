// The best surrogate of an effect on a drift series: the improvement by a curve without any cause.
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
  Eigen::VectorXd added_um;                 // n: fitted curve of the effect; for recordings
};

// The best of `count` surrogates: the curve of the effect with random phases.
struct BestSurrogate {
  double gain = 0.0;  // largest fall of chi^2
  double fall = 0.0;  // largest relative fall of the RMSE by least squares
};
// The fit to which the surrogates are added.
struct Background {
  std::vector<std::size_t> row;                                        // n, of the data
  std::function<Eigen::MatrixXd(const Eigen::MatrixXd&)> whiten = {};  // n by k
  ModelProjection white, plain;                                        // existing columns and their residual
};

BestSurrogate best_surrogate(const SurrogateSource& effect, const Series& data, const Background& background,
                             std::size_t count, std::uint64_t seed);

}  // namespace ballbar
