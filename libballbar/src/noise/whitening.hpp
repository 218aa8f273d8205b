// Columns by the filter of the noise.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "ballbar/noise/noise.hpp"
#include "noise/kalman.hpp"

namespace ballbar {

Eigen::MatrixXd whitened(const Whitening& whitening, const Eigen::Ref<const Eigen::MatrixXd>& columns);

// Paths of a noise from white numbers, one a row: the filter run the other way.
class Colouring {
 public:
  Colouring(const Noise& noise, std::span<const double> time_s, std::span<const double> sigma_um);
  void apply(Eigen::VectorXd& white) const;

 private:
  std::vector<Kalman::Gain> gains_;  // of all rows, as they come
};

// White noise with no reading beyond 4 sigma (by the median absolute deviation): what counts on many readings stays,
// what a few make alone does not.
Eigen::VectorXd clipped(Eigen::VectorXd white);

// Student's t with 4 degrees of freedom is more likely than the normal distribution, each of its own most likely width.
bool has_heavy_tails(const Eigen::VectorXd& white);

}  // namespace ballbar
