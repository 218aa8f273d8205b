// The most likely parameters of a model, from parameters near them, at one covariance.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "diagnosis/evidence/base_columns.hpp"
#include "diagnosis/evidence/evidence.hpp"
#include "noise/whitening.hpp"

namespace ballbar {

struct Refined {
  std::vector<double> parameters;
  double log_evidence = 0.0;  // of the line about them
  double variance = 0.0;      // of the scatter, in units of C
  double square = 0.0;        // what is left of the white readings
};

// How long it goes on: at most so many steps, and while one lowers `square` by more than this share of the scatter.
struct Steps {
  int most = 12;
  double least_fall = 1e-3;  // of what a search tells apart
};
inline constexpr Steps kToTheEnd{60, 1e-9};  // of numbers that are printed

// Gauss-Newton, shapes within their bounds. times: columns of Kind::time. free: shapes that are free though held;
// fixed: as BaseModel::at.
Refined refined(const BaseModel& base, std::vector<double> parameters, const std::vector<std::size_t>& free,
                const Eigen::MatrixXd& times, const Whitening& filter, const KnownScatter& known, Steps steps,
                std::size_t fixed = 0);

// Line of these columns in a pool where they stand from `first` on: y, the columns, times.
Line line_of(const BaseColumns& columns, Eigen::Index times, Eigen::Index first);
RowMajorMatrix pool_of(const BaseColumns& columns, const Eigen::MatrixXd& times);

}  // namespace ballbar
