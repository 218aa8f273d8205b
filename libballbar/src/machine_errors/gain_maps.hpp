// Gains of a fit in stages as one linear map of the readings, so that their covariance is that of sums of the readings.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "machine_errors/error_blocks.hpp"

namespace ballbar {

// Gains are T Z' y, y the rows' deviation; `open`: of their covariance, what a prior leaves open.
struct GainMap {
  Eigen::MatrixXd t;
  Eigen::MatrixXd open;
};

// What the stages are made of. p columns that are fitted together, c cyclic ones on what the first fit leaves, e extra.
struct GainStages {
  const ErrorRows* rows = nullptr;
  const Eigen::VectorXd* far = nullptr;  // weights without the reversals
  const Block* first = nullptr;          // of the columns together, by these weights
  const ErrorColumns* together = nullptr;
  const ErrorColumns* cyclic = nullptr;
  const Block* cyclic_block = nullptr;
  const ErrorColumns* extra = nullptr;
  const Eigen::MatrixXd* precision = nullptr;
  double slow_variance_um2 = 0.0;
};

class GainMaps {
 public:
  explicit GainMaps(const GainStages& stages);

  // Weighted columns: together and extra without the reversals, cyclic, together and extra with them.
  const Eigen::MatrixXd& z() const { return z_; }
  // X' X of together and extra, all rows.
  const Eigen::MatrixXd& normal() const { return all_rows_.normal; }
  Indices all() const { return range_of(0, p_ + e_); }

  // Some columns of together and extra, over the rows with or without reversals, freed of the cyclic errors.
  GainMap of(const Indices& chosen, bool with_reversals, bool with_prior = true) const;
  // All gains in the order together, cyclic, extra: those chosen by their own map, the other extra ones by that of all.
  GainMap joined(const GainMap& whole, const Indices& chosen, const GainMap& own) const;

 private:
  GainStages stages_;
  Eigen::Index p_ = 0, c_ = 0, e_ = 0;
  Eigen::MatrixXd z_;
  Eigen::MatrixXd t_cyclic_;
  struct Products {
    Eigen::MatrixXd normal;  // X' W X of together and extra
    Eigen::MatrixXd cyclic;  // X' W C
  };
  Products far_rows_, all_rows_;
};

}  // namespace ballbar
