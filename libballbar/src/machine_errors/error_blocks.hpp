// Least squares of some columns over some rows.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "machine_errors/error_model.hpp"

namespace ballbar {

using Indices = std::vector<Eigen::Index>;
Indices range_of(Eigen::Index first, Eigen::Index count);

// The remaining share of the square of a column that is still sufficient to determine it.
inline constexpr double kRidge = 1e-9;

// (X' W X + L)^-1 and W X, W the weights of the rows.
struct Block {
  Eigen::MatrixXd weighted;  // rows by columns
  Eigen::MatrixXd inverse;
  Eigen::MatrixXd normal = {};  // X' W X, the lower half

  Eigen::VectorXd solve(const Eigen::VectorXd& data) const { return inverse * (weighted.transpose() * data); }
};
Block block_of(const Eigen::MatrixXd& columns, const Eigen::VectorXd& weight, const Eigen::MatrixXd& precision);
Eigen::MatrixXd inverse_of(Eigen::MatrixXd normal, const Eigen::MatrixXd& precision);  // reads the lower half

// Whether the columns of one effect are relevant in the rows with these weights: not the far tail of a distant spike.
ErrorColumns present(const ErrorColumns& all, const Eigen::VectorXd& weight);

// The shape of `shapes` whose columns lower the residual of the data most, orthogonal to the columns of `base`
// (nullptr: none).
struct Base {
  const Eigen::MatrixXd* columns = nullptr;
  const Block* fit = nullptr;
};
double best_shape(const Effect& effect, const std::vector<double>& shapes, const ErrorRows& rows, const Base& base,
                  const Eigen::VectorXd& left, const Eigen::VectorXd& weight);

// Gains of a fit in stages as one linear map of the readings, so that their covariance is that of sums of the readings.

// Gains are T Z' y, y the rows' deviation; `open`: of their covariance, what a prior leaves open.
struct GainMap {
  Eigen::MatrixXd t;
  Eigen::MatrixXd open;
};

// The stages: p columns fitted jointly, c cyclic ones fitted to the residual of the first fit, e extra ones fitted
// jointly with the p, s spikes fitted to the residual of all these near their own reversals.
struct GainStages {
  const ErrorRows* rows = nullptr;
  const Eigen::VectorXd* far = nullptr;  // weights without the reversals
  const Block* first = nullptr;          // of the columns together, by these weights
  const ErrorColumns* together = nullptr;
  const ErrorColumns* cyclic = nullptr;
  const Block* cyclic_block = nullptr;
  const Eigen::MatrixXd* cyclic_of_together = nullptr;  // C' M by the weights of the cyclic errors
  const Eigen::MatrixXd* together_of_cyclic = nullptr;  // M' C by those of the first fit
  const ErrorColumns* extra = nullptr;
  const ErrorColumns* spikes = nullptr;
  const Eigen::MatrixXd* filters = nullptr;  // of the spikes
  double slow_variance_um2 = 0.0;
};

class GainMaps {
 public:
  explicit GainMaps(const GainStages& stages);

  // Weighted columns: together, extra, cyclic; the filters of the spikes.
  const Eigen::MatrixXd& z() const { return z_; }
  // X' X of together and extra.
  const Eigen::MatrixXd& normal() const { return normal_; }
  Indices all() const { return range_of(0, p_ + e_); }

  // Some columns of together and extra, freed of the cyclic errors; `precision` of those together.
  GainMap of(const Indices& chosen, const Eigen::MatrixXd& precision) const;
  // All gains in the order together, cyclic, extra, spikes: those chosen by their own map, the other extra ones by that
  // of all, and the spikes on what the cyclic errors and those chosen leave.
  GainMap joined(const GainMap& whole, const Indices& chosen, const GainMap& own) const;

 private:
  GainStages stages_;
  Eigen::Index p_ = 0, c_ = 0, e_ = 0, s_ = 0;
  Eigen::MatrixXd z_;
  Eigen::MatrixXd t_cyclic_;
  Eigen::MatrixXd normal_;            // X' W X of together and extra
  Eigen::MatrixXd with_cyclic_;       // X' W C
  Eigen::VectorXd spike_squares_;     // f' s of each spike
  Eigen::MatrixXd spikes_of_;         // F' X over them
  Eigen::MatrixXd spikes_of_cyclic_;  // F' C over them
};

}  // namespace ballbar
