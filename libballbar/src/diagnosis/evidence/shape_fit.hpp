// The most likely parameters of a model, from parameters near them, at one covariance (Ceres, as in `fit`).
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "diagnosis/evidence/base_model.hpp"
#include "diagnosis/evidence/linear_model.hpp"
#include "fit/series_cost.hpp"
#include "noise/whitening.hpp"

namespace ballbar {

inline constexpr Stop kSearched{12, 1e-5};  // accuracy within a search

struct ShapeFit {
  std::vector<double> parameters;
  double variance = 0.0;  // of the scatter, in units of C
  double square = 0.0;    // residual sum of squares of the white readings
};

// open: columns with prior N(0, 1) um. free: held shapes to set free; fixed: as in BaseModel::at(). With 0 iterations
// only the gains move.
ShapeFit shape_fit(const BaseModel& base, std::vector<double> parameters, const std::vector<std::size_t>& free,
                   const Eigen::MatrixXd& open, const Whitening& filter, const KnownScatter& known, Stop stop = {},
                   std::size_t fixed = 0);

// y, its columns, and the open ones.
LinearModel linear_model_of(const BaseColumns& columns, const Eigen::MatrixXd& open);

}  // namespace ballbar
