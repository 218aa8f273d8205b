// What varies without a cause: noise, and a slow discrepancy that may be on or off.
//
//   C = white + correlated exp(-|dt| / time) + slow (1 + s) exp(-s),   s = sqrt(3) |dt| / slow_time
//
// in units of the noise's variance (white + correlated = 1), which is integrated out (gram.hpp). The filter gives the
// innovations of columns over their standard deviation, O(n) a column, and the determinant of C.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "noise/kalman.hpp"

namespace ballbar {

struct Covariance {
  double white = 1.0, correlated = 0.0, time_s = 0.0;
  double slow = 0.0, slow_time_s = 0.0;  // discrepancy; slow = 0: off
  double log_prior = 0.0;
  // Alike but for the prior.
  bool operator==(const Covariance& other) const {
    return white == other.white && correlated == other.correlated && time_s == other.time_s && slow == other.slow &&
           slow_time_s == other.slow_time_s;
  }
};

// Noise alone: white, and with memories from a step to a sixth of the time, from mostly white to hardly white. Few
// rows: white alone.
std::vector<Covariance> noise_grid(std::span<const double> time_s);

// About this noise, between it and its neighbours of the grid.
std::vector<Covariance> noises_about(const Covariance& noise, std::span<const double> time_s);

// This noise beside a discrepancy of several lengths and sizes.
std::vector<Covariance> with_discrepancy(const Covariance& noise, std::span<const double> time_s);

class CovarianceFilter {
 public:
  // relative_variance: of the white part of each row, 1 where the reading is as good as the others; shock: of what is
  // new in the memory there. Empty: all 1.
  CovarianceFilter(const Covariance& covariance, std::span<const double> time_s,
                   std::span<const double> relative_variance, std::span<const double> shock = {});

  double log_determinant() const { return log_determinant_; }

  // Rows first, first + 1, ... of several columns become white. state: 3 by the columns, 0 before the first block.
  void apply(std::size_t first, RowMajorBlock block, RowMajorMatrix& state) const;

  // The transpose of apply on all rows: W' w of white columns w.
  void apply_transposed(RowMajorMatrix& white) const;

  // |W s|^2 of each column that is 0 before a row and 1 from it on, n of them.
  Eigen::VectorXd squares_of_steps() const;

 private:
  struct Row {
    double decay, f00, f01, f10, f11;  // of the memory; of the discrepancy
    double k0, k1, k2, scale;
  };
  std::vector<Row> rows_;
  bool has_slow_ = false, has_memory_ = false;
  double log_determinant_ = 0.0;
};

}  // namespace ballbar
