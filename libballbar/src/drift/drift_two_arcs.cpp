// Drift from two orthogonal arcs about C and A (He, Fu, Chen 2015): joint in one problem, or one after the other as the
// paper. drift.hpp has the equations.
#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "ballbar/message_catalogue.hpp"
#include "ballbar/units.hpp"
#include "circle/inlier_readings.hpp"
#include "drift/drift_methods.hpp"
#include "numerics/autocorrelation.hpp"
#include "numerics/least_squares.hpp"
#include "numerics/not_finite.hpp"

namespace ballbar {
namespace {

using Vector5d = Eigen::Vector<double, 5>;
using Matrix5d = Eigen::Matrix<double, 5, 5>;

// x, y, z of the spindle's ball from the point where the axes meet, R_C and R_A less the nominal length; um.
struct TwoArcs {
  Vector5d p;
  Matrix5d covariance_um2;
  Matrix5d inverse_information;  // of the arcs weighted by their noise
  Circle c_circle, a_circle;     // each arc's own fit: noise, discounted readings
  bool converged = false;

  Estimate coordinate(int i) const { return {p[i], std::sqrt(covariance_um2(i, i))}; }
};

// One arc: unknowns x, y, z, R_C, R_A in um, the radii about radius_um. The arc lies in the plane of the axes
// `along` and `across` (indices into x, y, z), its normal is `normal`, its radius unknown `radius`.
struct Arc {
  Eigen::ArrayXd cosine, sine, length_um;
  int along = 0, across = 1, normal = 2, radius = 3;
  double radius_um = 0.0;
  double height_um = 0.0;
  double weight = 1.0;  // 1 / sigma of a reading, 1/um

  Eigen::Index size() const { return length_um.size(); }

  // Residual: (L - m) weight, m^2 = (R cos - o_along)^2 + (R sin - o_across)^2 + (o_normal - h)^2.
  template <class Vector, class Part>
  void fill(Eigen::Index first, const Vector& p, Part& rows) const {
    rows.setZero();
    const double r = radius_um + p[radius];
    const double lift = p[normal] - height_um;
    for (Eigen::Index i = 0; i < rows.rows(); ++i) {
      const double c = cosine[first + i];
      const double s = sine[first + i];
      const double u = r * c - p[along];
      const double v = r * s - p[across];
      const double model = std::sqrt(u * u + v * v + lift * lift);
      const double scale = weight / model;
      rows(i, along) = u * scale;
      rows(i, across) = v * scale;
      rows(i, normal) = -lift * scale;
      rows(i, radius) = -(u * c + v * s) * scale;
      rows(i, 5) = (length_um[first + i] - model) * weight;
    }
  }
};

Arc arc_of(const Recording& recording, const Circle& circle, bool about_c) {
  Arc arc;
  const auto n = static_cast<Eigen::Index>(recording.length_mm.size());
  const Eigen::Map<const Eigen::ArrayXd> angle_rad(recording.angle_rad.data(), n);
  arc.cosine = angle_rad.cos();
  arc.sine = angle_rad.sin();
  arc.length_um = Eigen::Map<const Eigen::ArrayXd>(recording.length_mm.data(), n) * 1e3;
  if (!about_c) arc.along = 1, arc.across = 2, arc.normal = 0, arc.radius = 4;
  arc.radius_um = um_from_mm(recording.nominal_length_mm);
  arc.height_um = um_from_mm(recording.height_offset_mm);
  arc.weight = 1.0 / std::max(circle.sigma_reading_um, 1e-9);
  return arc;
}

// The arcs, one after the other, as the rows of one problem in the unknowns q, p = origin + map q.
struct JointRows {
  std::vector<const Arc*> arcs;
  Vector5d origin;
  Eigen::Matrix<double, 5, Eigen::Dynamic> map;

  Eigen::Index size() const {
    Eigen::Index size = 0;
    for (const Arc* arc : arcs) size += arc->size();
    return size;
  }
  Vector5d at(const Eigen::VectorXd& q) const { return origin + map * q; }

  template <class Part>
  void fill(Eigen::Index first, const Eigen::VectorXd& q, Part& part) const {
    least_squares::RowBlock<5> full(part.rows(), 6);
    const Vector5d p = at(q);
    Eigen::Index of_arc = first, row = 0;  // of_arc: the reading of the arc from which `row` comes
    for (const Arc* arc : arcs) {
      const Eigen::Index count = std::clamp<Eigen::Index>(arc->size() - of_arc, 0, part.rows() - row);
      auto rows = full.middleRows(row, count);
      if (count > 0) arc->fill(of_arc, p, rows);
      row += count;
      of_arc += count - arc->size();
    }
    part.leftCols(map.cols()) = full.leftCols<5>().lazyProduct(map);
    part.col(map.cols()) = full.col(5);
  }
};

Eigen::ArrayXd weighted_residual(const Arc& arc, const Vector5d& p) {
  Eigen::ArrayXd residual(arc.size());
  least_squares::for_each_block<5>(arc, p, [&](Eigen::Index first, const auto& part) {
    residual.segment(first, part.rows()) = part.col(5).array();
  });
  return residual;
}

// The contribution of one arc to sum s^2 J'J and sum s^2 J' rho J, in units of the arc's weight. s^2 is the variance of
// `residual`, corrected for the number of fitted unknowns.
least_squares::Information<5> noise_of(const Arc& arc, const Vector5d& p, const Eigen::ArrayXd& residual,
                                       const Matrix5d& inverse) {
  least_squares::Information<5> noise =
      least_squares::information_of<5>(arc, p, least_squares::autocorrelation_of(residual));
  const double left = static_cast<double>(arc.size()) - (inverse * noise.correlated).trace();
  noise.correlated *= residual.square().sum() / left;
  return noise;
}

struct Residuals {
  Eigen::ArrayXd c, a;
};

Matrix5d joint_covariance(const Arc& c, const Arc& a, const Vector5d& p, const Matrix5d& inverse,
                          const Residuals& residuals) {
  return inverse * (noise_of(c, p, residuals.c, inverse).correlated + noise_of(a, p, residuals.a, inverse).correlated) *
         inverse;
}

// x, y and R_C come from path 1 with `path1`, their covariance; z and R_A from path 2 with x and y held. An error of x,
// y moves z, R_A by -(J'J)^-1 J' J_xy.
Matrix5d sequential_covariance(const Arc& a, const Vector5d& p, const Matrix5d& inverse, const Eigen::ArrayXd& residual,
                               const Eigen::Matrix3d& path1) {
  const auto noise = noise_of(a, p, residual, inverse);
  const Matrix5d response = -inverse * noise.white;
  Eigen::Matrix<double, 5, 3> response_to_path1 = Eigen::Matrix<double, 5, 3>::Zero();
  response_to_path1(0, 0) = response_to_path1(1, 1) = response_to_path1(3, 2) = 1.0;
  response_to_path1.block<1, 2>(2, 0) = response.block<1, 2>(2, 0);
  response_to_path1.block<1, 2>(4, 0) = response.block<1, 2>(4, 0);
  return response_to_path1 * path1 * response_to_path1.transpose() + inverse * noise.correlated * inverse;
}

// Covariance of (x, y, R_C), um^2, from that of path 1's circle, whose centre is (-x, -y).
Eigen::Matrix3d of_spindle_ball(const Eigen::Matrix3d& circle_covariance_um2) {
  const Eigen::Vector3d sign(-1.0, -1.0, 1.0);
  return sign.asDiagonal() * circle_covariance_um2 * sign.asDiagonal();
}

void solve(const JointRows& rows, TwoArcs& fit, bool& determined) {
  const Eigen::VectorXd start = Eigen::VectorXd::Zero(rows.map.cols());
  const auto solution = least_squares::minimise<Eigen::Dynamic>(rows, start, least_squares::Start::near);
  fit.p = rows.at(solution.p);
  fit.converged = fit.converged && solution.converged;
  determined = solution.determined;
  fit.inverse_information = rows.map * solution.inverse_information * rows.map.transpose();
}

struct Arcs {
  Arc c, a;
};

// The arcs without the readings named; both weighted by the noise of `fit`.
Arcs arcs_of(const Recording& c_arc, const Recording& a_arc, const TwoArcs& fit,
             const std::vector<std::size_t>& c_discounted, const std::vector<std::size_t>& a_discounted) {
  const auto kept = [](const Recording& recording, const Circle& circle, bool about_c,
                       const std::vector<std::size_t>& discounted) {
    return discounted.empty() ? arc_of(recording, circle, about_c)
                              : arc_of(without(recording, discounted), circle, about_c);
  };
  return {kept(c_arc, fit.c_circle, true, c_discounted), kept(a_arc, fit.a_circle, false, a_discounted)};
}

TwoArcs fit_two_arcs(const Recording& c_arc, const Recording& a_arc, const DriftOptions& options) {
  CircleOptions each = options.circle;
  each.model = CircleModel::length_equation;
  each.oval = false;  // the same in all tests
  TwoArcs fit;
  fit.c_circle = fit_circle(c_arc, each);
  fit.a_circle = fit_circle(a_arc, each);
  fit.converged = fit.c_circle.converged;
  const auto [c, a] = arcs_of(c_arc, a_arc, fit, fit.c_circle.discounted, fit.a_circle.discounted);

  Vector5d start;
  start << -fit.c_circle.centre_a_um, -fit.c_circle.centre_b_um, -fit.a_circle.centre_b_um,
      um_from_mm(fit.c_circle.radius_mm) - c.radius_um, um_from_mm(fit.a_circle.radius_mm) - a.radius_um;
  JointRows rows{{&c, &a}, start, Matrix5d::Identity()};
  if (options.sequential) {
    rows.arcs = {&a};
    rows.map.setZero(5, 2);
    rows.map(2, 0) = rows.map(4, 1) = 1.0;
  } else if (options.equal_radii) {
    rows.map.setIdentity(5, 4);
    rows.map(4, 3) = 1.0;
    rows.origin[4] = start[3] + c.radius_um - a.radius_um;
  }
  bool determined = false;
  solve(rows, fit, determined);
  fit.covariance_um2.setConstant(kInfinite);
  if (!determined) return fit;
  const Residuals residuals{weighted_residual(c, fit.p), weighted_residual(a, fit.p)};
  fit.covariance_um2 = options.sequential ? sequential_covariance(a, fit.p, fit.inverse_information, residuals.a,
                                                                  of_spindle_ball(fit.c_circle.covariance_um2))
                                          : joint_covariance(c, a, fit.p, fit.inverse_information, residuals);
  return fit;
}

// Covariance of now.p - reference.p, from the difference of the residuals where the angles are the same, as
// covariance_of_change_um2 of circle.hpp; else the sum of the two covariances.
Matrix5d covariance_of_change_um2(const SessionTest& now, const TwoArcs& now_fit, const SessionTest& reference,
                                  const TwoArcs& reference_fit, const DriftOptions& options) {
  Matrix5d independent = now_fit.covariance_um2 + reference_fit.covariance_um2;
  if (!independent.allFinite() || !same_angles(*now.c_arc, *reference.c_arc) ||
      !same_angles(*now.a_arc, *reference.a_arc)) {
    return independent;
  }
  // Readings discounted in either test are left out of both. Both arcs have the weights of `now`, hence one unit.
  const auto c_out = in_either(now_fit.c_circle.discounted, reference_fit.c_circle.discounted);
  const auto a_out = in_either(now_fit.a_circle.discounted, reference_fit.a_circle.discounted);
  const auto [c, a] = arcs_of(*now.c_arc, *now.a_arc, now_fit, c_out, a_out);
  const auto [c0, a0] = arcs_of(*reference.c_arc, *reference.a_arc, now_fit, c_out, a_out);
  const Residuals residuals{weighted_residual(c, now_fit.p) - weighted_residual(c0, reference_fit.p),
                            weighted_residual(a, now_fit.p) - weighted_residual(a0, reference_fit.p)};
  if (!options.sequential) return joint_covariance(c, a, now_fit.p, now_fit.inverse_information, residuals);
  const Eigen::Matrix3d path1 =
      covariance_of_change_um2(*now.c_arc, now_fit.c_circle, *reference.c_arc, reference_fit.c_circle);
  return sequential_covariance(a, now_fit.p, now_fit.inverse_information, residuals.a, of_spindle_ball(path1));
}

}  // namespace

DriftSeries drift_by_two_arcs(const Session& session, const DriftOptions& options, std::size_t reference) {
  std::vector<TwoArcs> fits;
  for (const SessionTest& test : session.tests) {
    fits.push_back(in_test(test, [&] {
      if (!test.c_arc || !test.a_arc) throw Error("two_arcs needs a c_arc and an a_arc recording in every test");
      return fit_two_arcs(*test.c_arc, *test.a_arc, options);
    }));
  }
  DriftSeries series;
  for (std::size_t i = 0; i < fits.size(); ++i) {
    const TwoArcs& now = fits[i];
    const SessionTest& test = session.tests[i];
    Matrix5d covariance = Matrix5d::Zero();
    if (i != reference) {
      covariance = covariance_of_change_um2(test, now, session.tests[reference], fits[reference], options);
    }
    const auto change = [&](int k) { return Estimate{now.p[k] - fits[reference].p[k], std::sqrt(covariance(k, k))}; };
    DriftPoint point;
    point.time_s = test.elapsed_s;
    point.x = change(0);
    point.y = change(1);
    point.z = change(2);
    point.radius_change = change(3);
    point.radius_change_a = change(4);
    point.correlation_y_z = now.covariance_um2(1, 2) / std::sqrt(now.covariance_um2(1, 1) * now.covariance_um2(2, 2));
    series.points.push_back(point);

    Position position;
    position.time_s = test.elapsed_s;
    position.x = now.coordinate(0);
    position.y = now.coordinate(1);
    position.z = now.coordinate(2);
    position.radius_mm = test.c_arc->nominal_length_mm + mm_from_um(now.p[3]);
    position.discounted = now.c_circle.discounted.size() + now.a_circle.discounted.size();
    position.converged = now.converged;
    series.positions.push_back(position);
  }
  series.not_cancelled = messages::drift_remains_arcs();
  return series;
}

}  // namespace ballbar
