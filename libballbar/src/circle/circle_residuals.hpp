// Rows of the circle problems for least_squares.hpp. Unknowns a, b, R in um about `radius_um`.
#pragma once

#include <Eigen/Core>
#include <cmath>

namespace ballbar {

// Residual: reading minus sqrt((a + R cos)^2 + (b + R sin)^2 + h^2), um. The lengths are the recording's own.
struct LengthRows {
  Eigen::ArrayXd cosine, sine;
  const double* length_mm = nullptr;
  double length_correction_um = 0.0;  // subtracted
  double height_um = 0.0;
  double radius_um = 0.0;  // R = radius_um + p[2]

  Eigen::Index size() const { return cosine.size(); }

  template <class Part>
  void fill(Eigen::Index first, const Eigen::Vector3d& p, Part& rows) const {
    const double r = radius_um + p[2];
    for (Eigen::Index i = 0; i < rows.rows(); ++i) {
      const double c = cosine[first + i];
      const double s = sine[first + i];
      const double along_a = p[0] + r * c;
      const double along_b = p[1] + r * s;
      const double model = std::sqrt(along_a * along_a + along_b * along_b + height_um * height_um);
      const double per_model = -1.0 / model;
      rows(i, 0) = along_a * per_model;
      rows(i, 1) = along_b * per_model;
      rows(i, 2) = (along_a * c + along_b * s) * per_model;
      rows(i, 3) = length_mm[first + i] * 1e3 - length_correction_um - model;
    }
  }
};

// Residual: distance of the point from the centre minus R. In the units of the points.
struct PointRows {
  Eigen::ArrayXd x, y;
  double radius = 0.0;  // R = radius + p[2]

  Eigen::Index size() const { return x.size(); }

  template <class Part>
  void fill(Eigen::Index first, const Eigen::Vector3d& p, Part& rows) const {
    const Eigen::Index n = rows.rows();
    auto along_x = rows.col(0).array();
    auto along_y = rows.col(1).array();
    auto distance = rows.col(3).array();
    along_x = p[0] - x.segment(first, n);
    along_y = p[1] - y.segment(first, n);
    distance = (along_x.square() + along_y.square()).sqrt().max(1e-300);
    along_x /= distance;
    along_y /= distance;
    rows.col(2).setConstant(-1.0);
    distance -= radius + p[2];
  }
};

}  // namespace ballbar
