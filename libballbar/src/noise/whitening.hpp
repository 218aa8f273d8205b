// Whitens columns by the filter of the noise: innovations over their standard deviation. W is linear, and W' W is the
// inverse of the covariance.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "ballbar/noise/noise.hpp"
#include "noise/linear_filter.hpp"

namespace ballbar {

using RowMajorMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using RowMajorBlock = Eigen::Ref<RowMajorMatrix>;

// The filter's gains for these times, to be applied to any column.
class Whitening {
 public:
  Whitening() = default;  // of no rows
  explicit Whitening(const Covariance& covariance, std::span<const double> time_s, const RowScatter& rows = {});
  // left_out: rising rows that the filter ignores (outliers). Each still has an innovation, predicted from other rows.
  Whitening(const Noise& noise, std::span<const double> time_s, std::span<const double> sigma_um,
            std::span<const std::size_t> left_out = {});

  std::size_t size() const { return gain_of_row_.size(); }
  std::size_t readings() const { return size() - unknown_; }   // rows whose variance is known
  double log_determinant() const { return log_determinant_; }  // of the covariance of the readings

  // n innovations over their standard deviation. `stride`: distance of the column's values in memory. `out` may be the
  // column itself.
  void apply(const double* column, std::size_t stride, double* out, std::size_t out_stride) const;

  // Several columns at once, block of rows after block: rows first, first + 1, ... become white. state: 3 by the
  // columns, 0 before the first block.
  void apply(std::size_t first, RowMajorBlock block, RowMajorMatrix& state) const;

  // W' w of white columns w: their products with the columns before the filter.
  RowMajorMatrix transposed(RowMajorMatrix white) const;

  // |W s|^2 of each column that is 0 before a row and 1 from it on, n of them.
  Eigen::VectorXd squares_of_steps() const;

 private:
  // Rows of one step have one gain once it has settled: a few gains, and which of them is each row's.
  struct RowGain {
    FilterGain gain;
    double scale = 0.0;  // 1 over the innovation's standard deviation
  };
  const RowGain& of_row(std::size_t row) const { return gains_[gain_of_row_[row]]; }

  std::vector<RowGain> gains_;
  std::vector<std::uint32_t> gain_of_row_;
  bool has_slow_ = false, has_memory_ = false;
  std::size_t unknown_ = 0;
  double log_determinant_ = 0.0;
};

// All rows at once, and columns in groups whose block of rows stays in the cache.
RowMajorMatrix whitened_rows(const Whitening& whitening, RowMajorMatrix columns);
Eigen::MatrixXd whitened(const Whitening& whitening, const Eigen::Ref<const Eigen::MatrixXd>& columns);

// Student's t with 4 degrees of freedom is more likely than the normal distribution, each of its own most likely width.
bool has_heavy_tails(const Eigen::VectorXd& white);

}  // namespace ballbar
