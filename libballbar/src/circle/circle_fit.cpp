#include <ceres/loss_function.h>
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "ballbar/circle/circle.hpp"
#include "ballbar/error.hpp"
#include "ballbar/internal/numerics/interruption.hpp"
#include "ballbar/units.hpp"
#include "circle/arc_estimate.hpp"
#include "circle/circle_residuals.hpp"
#include "circle/inlier_readings.hpp"
#include "numerics/autocorrelation.hpp"
#include "numerics/least_squares.hpp"
#include "numerics/median.hpp"
#include "numerics/tukey.hpp"

namespace ballbar {
namespace {

using least_squares::Solution;

constexpr double kSmallestArc_deg = 5.0;
constexpr Eigen::Index kStartReadings = 512;  // the algebraic start needs no more
constexpr Eigen::Index kMostArcRows = 2048;   // of an arc's estimate: more readings enter as means of neighbours
constexpr double kExact_um = 1e-6;            // below, the residual is the rounding of double precision
constexpr double kFullArc_deg = 359.0;        // from here on a turn: its oval is orthogonal to the centre
constexpr double kHuber = 1.345;              // 95 % efficient at normal noise

Eigen::Map<const Eigen::ArrayXd> array_of(const std::vector<double>& values) {
  return {values.data(), static_cast<Eigen::Index>(values.size())};
}

double root_of(double variance) { return std::sqrt(std::max(0.0, variance)); }

double correlation(const Eigen::Matrix3d& c, int i, int j) { return c(i, j) / std::sqrt(c(i, i) * c(j, j)); }

// Arc of a recording that a circle can be fitted to, deg.
double required_arc_deg(const Recording& recording, double height_mm) {
  if (recording.kind != Kind::circle)
    throw Error("an axial recording has no circle to fit; expected a circle recording");
  const std::size_t n = recording.length_mm.size();
  if (recording.angle_rad.size() != n) {
    throw Error(fmt::format("a circle recording needs an angle for each length, found {} angles and {} lengths",
                            recording.angle_rad.size(), n));
  }
  if (n < 4) throw Error(fmt::format("a circle fit needs at least 4 readings, found {}", n));
  const double arc_deg = deg_from_rad(arc_rad(recording));
  if (arc_deg < kSmallestArc_deg) {
    throw Error(fmt::format("the readings cover {:.3g} deg of arc; below {} deg centre and radius cannot be told apart",
                            arc_deg, kSmallestArc_deg));
  }
  const double shortest_mm = *std::min_element(recording.length_mm.begin(), recording.length_mm.end());
  if (!(shortest_mm > std::abs(height_mm))) {
    throw Error(fmt::format("a reading of {:.7g} mm is not longer than the height difference of the balls, {} mm",
                            shortest_mm, height_mm));
  }
  return arc_deg;
}

struct Directions {
  Eigen::ArrayXd cosine, sine;
};

Directions directions_of(const Recording& recording) {
  const auto n = static_cast<Eigen::Index>(recording.angle_rad.size());
  Directions directions{Eigen::ArrayXd(n), Eigen::ArrayXd(n)};
  for (Eigen::Index i = 0; i < n; ++i) {
    const double angle_rad = recording.angle_rad[static_cast<std::size_t>(i)];
    directions.cosine[i] = std::cos(angle_rad);
    directions.sine[i] = std::sin(angle_rad);
  }
  return directions;
}

// Hyper circle through the polar points of evenly spaced readings.
PlaneCircle algebraic_start(const Recording& recording, const Directions& directions, const Circle& circle) {
  const auto length_mm = array_of(recording.length_mm);
  const double height_um = um_from_mm(circle.height_mm);
  const Eigen::Index step = (length_mm.size() + kStartReadings - 1) / kStartReadings;
  const Eigen::Index count = (length_mm.size() + step - 1) / step;
  Eigen::ArrayXd x(count);
  Eigen::ArrayXd y(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const double l = length_mm[i * step] * 1e3 - circle.length_correction_um;
    const double rho = std::sqrt(l * l - height_um * height_um);
    x[i] = rho * directions.cosine[i * step];
    y[i] = rho * directions.sine[i * step];
  }
  return algebraic_circle(x, y);
}

template <class Rows>
Eigen::ArrayXd residual_of(const Rows& rows, const Eigen::Vector3d& p) {
  Eigen::ArrayXd residual(rows.size());
  least_squares::for_each_block<3>(rows, p, [&](Eigen::Index first, const auto& part) {
    residual.segment(first, part.rows()) = part.col(3).array();
  });
  return residual;
}

// Huber from the least-squares answer, then Tukey from Huber's: the second forgets gross readings altogether. Each is
// repeated while the scale, which the outliers had widened, still falls by a twentieth.
template <class Rows>
Solution<3> minimise_robustly(const Rows& rows, Solution<3> solution, double& scale_um) {
  const ceres::HuberLoss huber(kHuber);
  const ceres::TukeyLoss tukey(kTukey);
  scale_um = median_sigma(residual_of(rows, solution.p));
  for (const ceres::LossFunction* loss :
       {static_cast<const ceres::LossFunction*>(&huber), static_cast<const ceres::LossFunction*>(&tukey)}) {
    for (int round = 0; round < 20 && scale_um > 0.0; ++round) {  // 0: more than half of the readings fit exactly
      expect_no_interruption();
      solution = least_squares::minimise<3>(rows, solution.p, least_squares::Start::near, loss, scale_um);
      const double narrower_um = median_sigma(residual_of(rows, solution.p));
      if (narrower_um > 0.95 * scale_um) break;
      scale_um = narrower_um;
    }
  }
  return solution;
}

// Fills what follows from the solution: numbers, covariance, autocorrelation. The rows' unit is um.
template <class Rows>
void finish(const Rows& rows, const Solution<3>& solution, double radius_um, double scale_um, Circle& circle) {
  circle.centre_a_um = solution.p[0];
  circle.centre_b_um = solution.p[1];
  circle.radius_mm = mm_from_um(radius_um + solution.p[2]);
  circle.converged = solution.converged;
  circle.outcome = solution.outcome;
  const Eigen::ArrayXd residual = residual_of(rows, solution.p);
  const double n = static_cast<double>(residual.size());
  circle.rms_um = std::sqrt(residual.square().mean());

  const bool robust = scale_um > 0.0;
  const double bound = kTukey * scale_um;
  const bool exact = circle.rms_um < kExact_um;  // its pattern says nothing
  const least_squares::Autocorrelation rho =
      exact    ? least_squares::Autocorrelation{}
      : robust ? least_squares::autocorrelation_of((residual.abs() < bound).select(residual, 0.0))
               : least_squares::autocorrelation_of(residual);
  if (!solution.determined) {
    circle.covariance_um2.setConstant(std::numeric_limits<double>::infinity());
    circle.sigma_reading_um = circle.rms_um;
    return;
  }
  // For a robust fit the inverse information Ceres gives is that of the discounted readings; the formula wants all.
  Eigen::Matrix3d inverse = solution.inverse_information;
  Eigen::Matrix3d widening = Eigen::Matrix3d::Identity();  // S H^-1
  if (robust || rho.share > 0.0) {
    const auto information = least_squares::information_of<3>(rows, solution.p, rho);
    inverse = information.white.inverse();
    widening = information.correlated * inverse;
  }
  const double used = widening.trace();
  const double variance_um2 = robust ? robust_variance(residual, scale_um, used) : residual.square().sum() / (n - used);
  if (robust) circle.discounted = discounted_by(tukey(residual, scale_um));
  circle.covariance_um2 = variance_um2 * inverse * widening;
  circle.sigma_reading_um = std::sqrt(variance_um2);
  circle.autocorrelation = rho.phi;
  circle.effective_readings =
      n * (variance_um2 * inverse.diagonal().array() / circle.covariance_um2.diagonal().array()).minCoeff();
  if (variance_um2 == 0.0) circle.effective_readings = n;
}

// Whether the oval of the path moves the circle: linear axes, not a full turn.
bool has_oval(const Recording& recording, const CircleOptions& options, double arc_deg) {
  return options.oval && recording.motion == Motion::linear_axes && arc_deg < kFullArc_deg;
}

using ArcRow = Eigen::RowVector<double, ArcRows::kColumns>;

// Rows of the linear model about `p`. Calls use(reading, row) for each reading.
template <class Rows, class Use>
void for_each_arc_row(const Rows& rows, const Eigen::Vector3d& p, const std::vector<double>& angle_rad, Use use) {
  least_squares::for_each_block<3>(rows, p, [&](Eigen::Index first, const auto& part) {
    for (Eigen::Index i = 0; i < part.rows(); ++i) {
      const double twice_rad = 2.0 * angle_rad[static_cast<std::size_t>(first + i)];
      ArcRow row;
      row << -part.row(i).template head<3>(), std::cos(twice_rad), std::sin(twice_rad), std::cos(1.5 * twice_rad),
          std::sin(1.5 * twice_rad), part(i, 3);
      use(first + i, row);
    }
  });
}

// Means of neighbours without the discounted readings.
template <class Rows>
ArcRows arc_rows(const Rows& rows, const Eigen::Vector3d& p, const std::vector<double>& angle_rad,
                 const std::vector<std::size_t>& discounted) {
  const Eigen::Index kept = rows.size() - static_cast<Eigen::Index>(discounted.size());
  const Eigen::Index together = (kept + kMostArcRows - 1) / kMostArcRows;
  ArcRows means;
  means.columns.setZero(kept / together, ArcRows::kColumns);  // fewer than `together` at the end are left out
  auto next = discounted.begin();
  Eigen::Index taken = 0;
  for_each_arc_row(rows, p, angle_rad, [&](Eigen::Index reading, const ArcRow& row) {
    if (next != discounted.end() && static_cast<Eigen::Index>(*next) == reading) {
      ++next;
      return;
    }
    const Eigen::Index mean = taken++ / together;
    if (mean < means.columns.rows()) means.columns.row(mean) += row / static_cast<double>(together);
  });
  return means;
}

// The circle of an arc with an oval. A polar circle keeps its values, which are the instrument's: its covariance is
// the second moment about them.
template <class Rows>
void take_up_oval(const Rows& rows, const Eigen::Vector3d& p, const std::vector<double>& angle_rad, Circle& circle) {
  const ArcRows means = arc_rows(rows, p, angle_rad, circle.discounted);
  circle.oval_um = usual_oval_um(circle.radius_mm);
  const ArcEstimate estimate = arc_estimate(means, circle.oval_um);
  circle.covariance_um2 = estimate.covariance_um2;
  circle.autocorrelation = estimate.autocorrelation;
  const auto kept = static_cast<double>(rows.size() - static_cast<Eigen::Index>(circle.discounted.size()));
  circle.effective_readings = estimate.effective_share * kept;
  if (circle.model == CircleModel::polar) {
    circle.covariance_um2 += estimate.b * estimate.b.transpose();
    return;
  }
  circle.centre_a_um += estimate.b[0];
  circle.centre_b_um += estimate.b[1];
  circle.radius_mm += mm_from_um(estimate.b[2]);
  Eigen::Vector<double, ArcRows::kColumns> left;
  left << -estimate.b, -estimate.u, 1.0;
  double sum = 0.0, sum_kept = 0.0;
  auto next = circle.discounted.begin();
  for_each_arc_row(rows, p, angle_rad, [&](Eigen::Index reading, const ArcRow& row) {
    const double square = std::pow(row.dot(left), 2);
    const bool is_discounted = next != circle.discounted.end() && static_cast<Eigen::Index>(*next) == reading;
    sum += square;
    if (is_discounted) ++next;
    if (!is_discounted) sum_kept += square;
  });
  circle.rms_um = std::sqrt(sum / static_cast<double>(rows.size()));
  circle.sigma_reading_um = std::sqrt(sum_kept / std::max(1.0, kept - (ArcRows::kColumns - 1)));
}

template <class Rows>
void solve(const Rows& rows, const Eigen::Vector3d& start, double radius_um, const Recording& recording,
           const CircleOptions& options, Circle& circle) {
  Solution<3> solution = least_squares::minimise<3>(rows, start, least_squares::Start::near);
  double scale_um = 0.0;
  if (options.robust) solution = minimise_robustly(rows, std::move(solution), scale_um);
  finish(rows, solution, radius_um, scale_um, circle);
  const bool is_enough = rows.size() - static_cast<Eigen::Index>(circle.discounted.size()) >= 4;
  if (solution.determined && is_enough && circle.rms_um >= kExact_um && has_oval(recording, options, circle.arc_deg)) {
    take_up_oval(rows, solution.p, recording.angle_rad, circle);
  }
}

}  // namespace

double Circle::sigma_centre_a_um() const { return root_of(covariance_um2(0, 0)); }
double Circle::sigma_centre_b_um() const { return root_of(covariance_um2(1, 1)); }
double Circle::sigma_radius_um() const { return root_of(covariance_um2(2, 2)); }
double Circle::correlation_a_b() const { return correlation(covariance_um2, 0, 1); }
double Circle::correlation_a_radius() const { return correlation(covariance_um2, 0, 2); }
double Circle::correlation_b_radius() const { return correlation(covariance_um2, 1, 2); }

Circle fit_circle(const Recording& recording, const CircleOptions& options) {
  Circle circle;
  circle.model = options.model;
  circle.readings = recording.length_mm.size();
  const bool exact = options.elongation_form == ElongationForm::exact;
  circle.height_mm = recording.height_offset_mm + (exact ? mm_from_um(options.elongation_um) : 0.0);
  circle.arc_deg = required_arc_deg(recording, circle.height_mm);
  if (!exact) {
    circle.length_correction_um =
        elongation_correction_um(ElongationForm::eq34, recording.nominal_length_mm, 0.0, options.elongation_um);
  }

  const double height_um = um_from_mm(circle.height_mm);
  Directions directions = directions_of(recording);
  const PlaneCircle start = algebraic_start(recording, directions, circle);
  const Eigen::Vector3d p0(start.centre_x, start.centre_y, 0.0);
  if (options.model == CircleModel::polar) {
    Eigen::ArrayXd rho_um = array_of(recording.length_mm) * 1e3 - circle.length_correction_um;
    if (height_um != 0.0) rho_um = (rho_um.square() - height_um * height_um).sqrt();
    directions.cosine *= rho_um;
    directions.sine *= rho_um;
    const PointRows rows{std::move(directions.cosine), std::move(directions.sine), start.radius};
    solve(rows, p0, start.radius, recording, options, circle);
  } else {
    const LengthRows rows{std::move(directions.cosine),
                          std::move(directions.sine),
                          recording.length_mm.data(),
                          circle.length_correction_um,
                          height_um,
                          start.radius};
    solve(rows, p0, start.radius, recording, options, circle);
  }
  circle.elongation_correction_um = exact ? elongation_correction_um(ElongationForm::exact, circle.radius_mm,
                                                                     recording.height_offset_mm, options.elongation_um)
                                          : circle.length_correction_um;
  return circle;
}

Eigen::ArrayXd radii_mm(const Recording& recording, const Circle& circle) {
  const double height_um = um_from_mm(circle.height_mm);
  const Eigen::ArrayXd length_um = array_of(recording.length_mm) * 1e3 - circle.length_correction_um;
  const Eigen::ArrayXd rho2 = length_um.square() - height_um * height_um;
  const auto [cosine, sine] = directions_of(recording);
  const double a = circle.centre_a_um;
  const double b = circle.centre_b_um;
  if (circle.model == CircleModel::polar) {
    return ((rho2.sqrt() * cosine - a).square() + (rho2.sqrt() * sine - b).square()).sqrt() / 1e3;
  }
  // |c + r u| = rho:  r = -c.u + sqrt(rho^2 - (c x u)^2)
  return ((rho2 - (a * sine - b * cosine).square()).sqrt() - (a * cosine + b * sine)) / 1e3;
}

Eigen::ArrayXd residual_um(const Recording& recording, const Circle& circle) {
  if (circle.model == CircleModel::polar) return (radii_mm(recording, circle) - circle.radius_mm) * 1e3;
  const auto [cosine, sine] = directions_of(recording);
  const double radius_um = um_from_mm(circle.radius_mm);
  const double height_um = um_from_mm(circle.height_mm);
  return array_of(recording.length_mm) * 1e3 - circle.length_correction_um -
         ((circle.centre_a_um + radius_um * cosine).square() + (circle.centre_b_um + radius_um * sine).square() +
          height_um * height_um)
             .sqrt();
}

Eigen::Matrix3d covariance_of_change_um2(const Recording& now, const Circle& now_circle, const Recording& reference,
                                         const Circle& reference_circle) {
  Eigen::Matrix3d independent = now_circle.covariance_um2 + reference_circle.covariance_um2;
  if (!same_angles(now, reference) || !independent.allFinite()) return independent;
  const std::vector<std::size_t> out = in_either(now_circle.discounted, reference_circle.discounted);
  const Recording kept_now = out.empty() ? Recording{} : without(now, out);
  const Recording kept_reference = out.empty() ? Recording{} : without(reference, out);
  const Recording& n = out.empty() ? now : kept_now;
  const Recording& r = out.empty() ? reference : kept_reference;
  const Eigen::ArrayXd difference_um = residual_um(n, now_circle) - residual_um(r, reference_circle);
  auto [cosine, sine] = directions_of(n);
  const LengthRows rows{std::move(cosine),
                        std::move(sine),
                        n.length_mm.data(),
                        now_circle.length_correction_um,
                        um_from_mm(now_circle.height_mm),
                        0.0};
  const Eigen::Vector3d p(now_circle.centre_a_um, now_circle.centre_b_um, um_from_mm(now_circle.radius_mm));
  const auto [white, correlated] =
      least_squares::information_of<3>(rows, p, least_squares::autocorrelation_of(difference_um));
  const Eigen::Matrix3d inverse = white.inverse();
  const double left = static_cast<double>(difference_um.size()) - (inverse * correlated).trace();
  return difference_um.square().sum() / left * inverse * correlated * inverse;
}

}  // namespace ballbar
