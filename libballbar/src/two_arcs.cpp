// Two orthogonal arcs, He, Fu, Chen 2015: joint in one problem, or one after the other as the paper.
#include "two_arcs.hpp"

#include <cmath>
#include <limits>

#include "ballbar/units.hpp"
#include "least_squares.hpp"

namespace ballbar {
namespace {

using Vector5d = Eigen::Vector<double, 5>;
using Matrix5d = Eigen::Matrix<double, 5, 5>;

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
  arc.radius_um = um_from_mm(circle.radius_mm);
  arc.height_um = um_from_mm(recording.height_offset_mm);
  arc.weight = 1.0 / std::max(circle.sigma_reading_um, 1e-9);
  return arc;
}

Recording without(const Recording& recording, const std::vector<std::size_t>& discounted) {
  Recording kept = recording;
  kept.angle_rad.clear();
  kept.length_mm.clear();
  kept.time_s.clear();
  auto next = discounted.begin();
  for (std::size_t i = 0; i < recording.length_mm.size(); ++i) {
    if (next != discounted.end() && *next == i) {
      ++next;
      continue;
    }
    kept.angle_rad.push_back(recording.angle_rad[i]);
    kept.length_mm.push_back(recording.length_mm[i]);
  }
  return kept;
}

// Both arcs, one after the other, as the rows of one problem.
struct BothArcs {
  const Arc& c;
  const Arc& a;

  Eigen::Index size() const { return c.size() + a.size(); }

  template <class Vector, class Part>
  void fill(Eigen::Index first, const Vector& p, Part& rows) const {
    const Eigen::Index from_c = std::clamp<Eigen::Index>(c.size() - first, 0, rows.rows());
    auto top = rows.topRows(from_c);
    auto bottom = rows.bottomRows(rows.rows() - from_c);
    if (from_c > 0) c.fill(first, p, top);
    if (from_c < rows.rows()) a.fill(first + from_c - c.size(), p, bottom);
  }
};

// The same problem in fewer unknowns, p = origin + map q.
template <int Q, class Rows>
struct Fewer {
  const Rows& rows;
  Vector5d origin;
  Eigen::Matrix<double, 5, Q> map;

  Eigen::Index size() const { return rows.size(); }
  Vector5d at(const Eigen::Vector<double, Q>& q) const { return origin + map * q; }

  template <class Part>
  void fill(Eigen::Index first, const Eigen::Vector<double, Q>& q, Part& part) const {
    least_squares::RowBlock<5> full(part.rows(), 6);
    rows.fill(first, at(q), full);
    part.template leftCols<Q>() = full.leftCols<5>() * map;
    part.col(Q) = full.col(5);
  }
};

// S of one arc with its residual's autocorrelation, and its variance in units of the weights, at p.
struct ArcNoise {
  least_squares::Information<5> information;
  double sum_squares = 0.0;
  double readings = 0.0;
};

ArcNoise noise_of(const Arc& arc, const Vector5d& p) {
  Eigen::ArrayXd residual(arc.size());
  least_squares::for_each_block<5>(arc, p, [&](Eigen::Index first, const auto& part) {
    residual.segment(first, part.rows()) = part.col(5).array();
  });
  ArcNoise noise;
  noise.information = least_squares::information_of<5>(arc, p, least_squares::autocorrelation_of(residual));
  noise.sum_squares = residual.square().sum();
  noise.readings = static_cast<double>(arc.size());
  return noise;
}

// Variance of the arc's readings in units of the weights, with the share of unknowns the fit took from it.
double variance_of(const ArcNoise& noise, const Matrix5d& inverse) {
  return noise.sum_squares / (noise.readings - (inverse * noise.information.correlated).trace());
}

template <int Q>
TwoArcs joint(const Arc& c, const Arc& a, const Vector5d& start, const Eigen::Matrix<double, 5, Q>& map) {
  const BothArcs both{c, a};
  const Fewer<Q, BothArcs> rows{both, start, map};
  const auto solution = least_squares::minimise<Q>(rows, Eigen::Vector<double, Q>::Zero());
  const Vector5d p = rows.at(solution.p);
  TwoArcs result;
  result.converged = solution.converged;
  result.position_um = p.head<3>();
  Matrix5d covariance = Matrix5d::Constant(std::numeric_limits<double>::infinity());
  if (solution.determined) {
    const Matrix5d inverse = map * solution.inverse_information * map.transpose();
    const ArcNoise noise_c = noise_of(c, p);
    const ArcNoise noise_a = noise_of(a, p);
    covariance = inverse *
                 (variance_of(noise_c, inverse) * noise_c.information.correlated +
                  variance_of(noise_a, inverse) * noise_a.information.correlated) *
                 inverse;
  }
  result.covariance_um2 = covariance.topLeftCorner<3, 3>();
  result.radius_c = {c.radius_um + p[3], std::sqrt(covariance(3, 3))};
  result.radius_a = {a.radius_um + p[4], std::sqrt(covariance(4, 4))};
  return result;
}

// Path 2 with x and y held at what path 1 gave: unknowns z and R_A.
TwoArcs sequential(const Circle& first, const Arc& a, double z_um) {
  Vector5d origin;
  origin << -first.centre_a_um, -first.centre_b_um, z_um, 0.0, 0.0;
  Eigen::Matrix<double, 5, 2> map = Eigen::Matrix<double, 5, 2>::Zero();
  map(2, 0) = map(4, 1) = 1.0;
  const Fewer<2, Arc> rows{a, origin, map};
  const auto solution = least_squares::minimise<2>(rows, Eigen::Vector2d::Zero());
  const Vector5d p = rows.at(solution.p);
  TwoArcs result;
  result.converged = first.converged && solution.converged;
  result.position_um = p.head<3>();
  result.radius_c = {um_from_mm(first.radius_mm), first.sigma_radius_um()};
  result.covariance_um2.setConstant(std::numeric_limits<double>::infinity());
  result.radius_a = {a.radius_um + p[4], std::numeric_limits<double>::infinity()};
  if (!solution.determined) return result;
  const ArcNoise noise = noise_of(a, p);
  const Matrix5d inverse = map * solution.inverse_information * map.transpose();
  const Matrix5d own = variance_of(noise, inverse) * inverse * noise.information.correlated * inverse;
  // What an error of x, y from path 1 does to z, R_A: d(z, R) = -(J'J)^-1 J' J_xy d(x, y).
  Eigen::Matrix<double, 3, 2> carried = Eigen::Matrix<double, 3, 2>::Identity();
  const Matrix5d response = -inverse * noise.information.white;
  carried.row(2) = response.block<1, 2>(2, 0);
  const Eigen::Matrix2d c_xy = first.covariance_um2.topLeftCorner<2, 2>();
  result.covariance_um2 = carried * c_xy * carried.transpose();
  result.covariance_um2(2, 2) += own(2, 2);
  const Eigen::RowVector2d onto_radius = response.block<1, 2>(4, 0);
  result.radius_a.sigma_um = std::sqrt(own(4, 4) + onto_radius.dot(onto_radius * c_xy));
  return result;
}

}  // namespace

TwoArcs fit_two_arcs(const Recording& c_arc, const Recording& a_arc, const DriftOptions& options) {
  CircleOptions each = options.circle;
  each.model = CircleModel::length_equation;
  const Circle c_circle = fit_circle(c_arc, each);
  const Circle a_circle = fit_circle(a_arc, each);
  const bool drop_c = !c_circle.discounted.empty();
  const bool drop_a = !a_circle.discounted.empty();
  const Arc c = arc_of(drop_c ? without(c_arc, c_circle.discounted) : c_arc, c_circle, true);
  const Arc a = arc_of(drop_a ? without(a_arc, a_circle.discounted) : a_arc, a_circle, false);

  Vector5d start;
  start << -c_circle.centre_a_um, -c_circle.centre_b_um, -a_circle.centre_b_um, 0.0, 0.0;
  TwoArcs result;
  if (options.sequential) {
    result = sequential(c_circle, a, start[2]);
  } else if (options.equal_radii) {
    Eigen::Matrix<double, 5, 4> map = Eigen::Matrix<double, 5, 4>::Zero();
    map.topLeftCorner<4, 4>().setIdentity();
    map(4, 3) = 1.0;
    Vector5d origin = start;
    origin[4] = c.radius_um - a.radius_um;  // R_A starts at R_C and moves with it
    result = joint<4>(c, a, origin, map);
  } else {
    result = joint<5>(c, a, start, Matrix5d::Identity());
  }
  result.discounted = c_circle.discounted.size() + a_circle.discounted.size();
  return result;
}

}  // namespace ballbar
