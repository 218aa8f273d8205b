#include "ballbar/drift.hpp"

#include <fmt/core.h>

#include <array>
#include <cmath>
#include <limits>

#include "ballbar/axial_length.hpp"
#include "ballbar/error.hpp"
#include "ballbar/units.hpp"
#include "two_arcs.hpp"

namespace ballbar {
namespace {

// Runs `work`; an Error in it is told with the test it came from.
template <class Work>
auto in_test(const SessionTest& test, Work work) {
  try {
    return work();
  } catch (const Error& error) {
    throw Error(fmt::format("test at {} s ({}): {}", test.elapsed_s, test.name, error.what()));
  }
}

std::size_t reference_index(const std::vector<double>& times_s, const std::optional<double>& wanted_s) {
  std::size_t best = 0;
  if (!wanted_s) return best;
  for (std::size_t i = 1; i < times_s.size(); ++i) {
    if (std::abs(times_s[i] - *wanted_s) < std::abs(times_s[best] - *wanted_s)) best = i;
  }
  return best;
}

// a - b of two independent estimates.
Estimate difference(const Estimate& a, const Estimate& b) {
  return {a.value_um - b.value_um, std::hypot(a.sigma_um, b.sigma_um)};
}

Estimate change(const Estimate& now, const Estimate& reference, bool is_reference) {
  return is_reference ? Estimate{} : difference(now, reference);
}

// ---- two arcs

DriftSeries two_arcs(const Session& session, const DriftOptions& options, std::size_t reference) {
  std::vector<TwoArcs> fits;
  for (const SessionTest& test : session.tests) {
    fits.push_back(in_test(test, [&] {
      if (!test.c_arc || !test.a_arc) throw Error("two_arcs needs a c_arc and an a_arc recording in every test");
      return fit_two_arcs(*test.c_arc, *test.a_arc, options);
    }));
  }
  DriftSeries series;
  const auto coordinate = [](const TwoArcs& fit, int i) {
    return Estimate{fit.position_um[i], std::sqrt(fit.covariance_um2(i, i))};
  };
  for (std::size_t i = 0; i < fits.size(); ++i) {
    const TwoArcs& now = fits[i];
    const TwoArcs& start = fits[reference];
    const bool is_reference = i == reference;
    DriftPoint point;
    point.time_s = session.tests[i].elapsed_s;
    point.x = change(coordinate(now, 0), coordinate(start, 0), is_reference);
    point.y = change(coordinate(now, 1), coordinate(start, 1), is_reference);
    point.z = change(coordinate(now, 2), coordinate(start, 2), is_reference);
    point.radius_change = change(now.radius_c, start.radius_c, is_reference);
    point.radius_change_a = change(now.radius_a, start.radius_a, is_reference);
    point.correlation_y_z = now.covariance_um2(1, 2) / std::sqrt(now.covariance_um2(1, 1) * now.covariance_um2(2, 2));
    series.points.push_back(point);
    Position position;
    position.time_s = point.time_s;
    position.x = coordinate(now, 0);
    position.y = coordinate(now, 1);
    position.z = coordinate(now, 2);
    position.radius_mm = mm_from_um(now.radius_c.value_um);
    position.discounted = now.discounted;
    position.converged = now.converged;
    series.positions.push_back(position);
  }
  series.not_cancelled =
      "Set-up errors cancel in the difference to the reference test; drift of the table and of the axes A and C, "
      "and a ball moved between tests, do not.";
  return series;
}

// ---- spindle rotation

// Axial length of a test, um; a length read off a display has no sigma.
Estimate axial_length_of(const SessionTest& test) {
  if (test.axial_length_mm) return {um_from_mm(*test.axial_length_mm), std::numeric_limits<double>::quiet_NaN()};
  if (!test.axial) throw Error("spindle_rotation needs axial or axial_length_mm in every test");
  const AxialLength axial = axial_length(*test.axial);
  return {um_from_mm(axial.length_mm), axial.sigma_um};
}

// |d| and its sigma from the covariance of d; at d = 0 the mean of the components'.
Estimate size_of(const Eigen::Vector2d& d, const Eigen::Matrix2d& covariance) {
  const double size = d.norm();
  if (size == 0.0) return {0.0, std::sqrt(0.5 * covariance.trace())};
  const Eigen::Vector2d along = d / size;
  return {size, std::sqrt(along.dot(covariance * along))};
}

DriftSeries spindle_rotation(const Session& session, const DriftOptions& options, std::size_t reference) {
  std::vector<Estimate> lengths;
  for (const SessionTest& test : session.tests) lengths.push_back(in_test(test, [&] { return axial_length_of(test); }));
  const double sign = session.spindle_above ? 1.0 : -1.0;
  std::vector<Circle> circles;
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    const SessionTest& test = session.tests[i];
    CircleOptions circle_options = options.circle;
    circle_options.elongation_um = sign * (lengths[reference].value_um - lengths[i].value_um);
    circles.push_back(in_test(test, [&] {
      if (!test.rotation) throw Error("spindle_rotation needs a rotation recording in every test");
      return fit_circle(*test.rotation, circle_options);
    }));
  }
  DriftSeries series;
  const Circle& start = circles[reference];
  for (std::size_t i = 0; i < circles.size(); ++i) {
    const Circle& now = circles[i];
    const bool is_reference = i == reference;
    DriftPoint point;
    point.time_s = session.tests[i].elapsed_s;
    const Eigen::Vector2d shift(now.centre_a_um - start.centre_a_um, now.centre_b_um - start.centre_b_um);
    const Eigen::Matrix2d covariance =
        (now.covariance_um2 + start.covariance_um2).topLeftCorner<2, 2>() * (is_reference ? 0.0 : 1.0);
    point.radial = size_of(shift, covariance);
    point.shift_a = Estimate{shift.x(), std::sqrt(covariance(0, 0))};
    point.shift_b = Estimate{shift.y(), std::sqrt(covariance(1, 1))};
    point.axial = change(lengths[reference], lengths[i], is_reference);
    point.axial->value_um *= sign;
    point.radius_change = change({um_from_mm(now.radius_mm), now.sigma_radius_um()},
                                 {um_from_mm(start.radius_mm), start.sigma_radius_um()}, is_reference);
    point.elongation_correction_um = now.elongation_correction_um;
    series.points.push_back(point);
    Position position;
    position.time_s = point.time_s;
    position.centre_a = Estimate{now.centre_a_um, now.sigma_centre_a_um()};
    position.centre_b = Estimate{now.centre_b_um, now.sigma_centre_b_um()};
    position.length_mm = mm_from_um(lengths[i].value_um);
    position.radius_mm = now.radius_mm;
    position.discounted = now.discounted.size();
    position.converged = now.converged;
    series.positions.push_back(position);
  }
  series.not_cancelled =
      "Constant set-up errors and the run-out of the spindle's ball cancel in the difference to the reference test; "
      "the bar's own thermal growth stands in axial and in the radius change, and a ball moved between tests in all.";
  return series;
}

// ---- circles

// Mean centre of the recordings of one plane in one test, signed as drift.
struct PlaneCentre {
  bool present = false;
  Estimate a, b, radius;
};

PlaneCentre mean_centre(const std::vector<Circle>& circles, const SessionTest& test, Plane plane) {
  PlaneCentre mean;
  double n = 0.0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Vector3d variance = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < circles.size(); ++i) {
    if (test.circles[i].plane != plane) continue;
    const double sign = test.circles[i].moving_ball == MovingBall::spindle ? 1.0 : -1.0;
    sum +=
        Eigen::Vector3d(sign * circles[i].centre_a_um, sign * circles[i].centre_b_um, um_from_mm(circles[i].radius_mm));
    variance += circles[i].covariance_um2.diagonal();
    n += 1.0;
  }
  if (n == 0.0) return mean;
  sum /= n;
  const Eigen::Vector3d sigma = variance.cwiseSqrt() / n;
  return {true, {sum[0], sigma[0]}, {sum[1], sigma[1]}, {sum[2], sigma[2]}};
}

// The mean of what is there already and one more estimate of the same quantity.
void average_in(std::optional<Estimate>& have, const Estimate& more) {
  have =
      have ? Estimate{0.5 * (have->value_um + more.value_um), 0.5 * std::hypot(have->sigma_um, more.sigma_um)} : more;
}

DriftSeries circles(const Session& session, const DriftOptions& options) {
  constexpr std::array kPlanes{Plane::XY, Plane::YZ, Plane::ZX};
  DriftSeries series;
  std::vector<std::array<PlaneCentre, 3>> centres;
  for (const SessionTest& test : session.tests) {
    const auto fits = in_test(test, [&] {
      if (test.circles.empty()) throw Error("circles needs at least one circle recording in every test");
      std::vector<Circle> fitted;
      for (const Recording& recording : test.circles) fitted.push_back(fit_circle(recording, options.circle));
      return fitted;
    });
    std::array<PlaneCentre, 3> planes;
    for (std::size_t k = 0; k < 3; ++k) planes[k] = mean_centre(fits, test, kPlanes[k]);
    centres.push_back(planes);
    Position position;
    position.time_s = test.elapsed_s;
    const double sign = test.circles.front().moving_ball == MovingBall::spindle ? 1.0 : -1.0;
    const PlaneCentre& first = planes[static_cast<std::size_t>(test.circles.front().plane)];
    position.centre_a = Estimate{sign * first.a.value_um, first.a.sigma_um};
    position.centre_b = Estimate{sign * first.b.value_um, first.b.sigma_um};
    position.radius_mm = mm_from_um(first.radius.value_um);
    position.converged = true;
    for (const Circle& fit : fits) {
      position.discounted += fit.discounted.size();
      position.converged = position.converged && fit.converged;
    }
    series.positions.push_back(position);
    DriftPoint point;
    point.time_s = test.elapsed_s;
    series.points.push_back(point);
  }
  for (std::size_t k = 0; k < 3; ++k) {
    std::vector<std::size_t> tests;
    std::vector<double> times_s;
    for (std::size_t i = 0; i < centres.size(); ++i) {
      if (!centres[i][k].present) continue;
      tests.push_back(i);
      times_s.push_back(session.tests[i].elapsed_s);
    }
    if (tests.empty()) continue;
    const std::size_t reference = tests[reference_index(times_s, options.reference_s)];
    const auto [a, b] = axes_of(kPlanes[k]);
    for (const std::size_t i : tests) {
      DriftPoint& point = series.points[i];
      const std::array axes{&point.x, &point.y, &point.z};
      const PlaneCentre& now = centres[i][k];
      const PlaneCentre& start = centres[reference][k];
      average_in(*axes[static_cast<std::size_t>(a)], change(now.a, start.a, i == reference));
      average_in(*axes[static_cast<std::size_t>(b)], change(now.b, start.b, i == reference));
      average_in(point.radius_change, change(now.radius, start.radius, i == reference));
    }
  }
  series.not_cancelled =
      "Set-up errors cancel in the difference to the reference test; drift of the table, thermal growth of the linear "
      "axes' scales and of the bar (both stand in the radius change), and a ball moved between tests, do not.";
  return series;
}

}  // namespace

DriftSeries drift_of(const Session& session, const DriftOptions& options) {
  if (session.tests.empty()) throw Error("the session has no test; drift needs at least one");
  std::vector<double> times_s;
  for (const SessionTest& test : session.tests) times_s.push_back(test.elapsed_s);
  const std::size_t reference = reference_index(times_s, options.reference_s);
  DriftSeries series = session.method == Method::two_arcs           ? two_arcs(session, options, reference)
                       : session.method == Method::spindle_rotation ? spindle_rotation(session, options, reference)
                                                                    : circles(session, options);
  series.method = session.method;
  series.reference_s = times_s[reference];
  return series;
}

std::string_view name_of(Method method) {
  switch (method) {
    case Method::two_arcs:
      return "two_arcs";
    case Method::spindle_rotation:
      return "spindle_rotation";
    case Method::circles:
      return "circles";
  }
  return "";
}

std::optional<Method> method_from_name(std::string_view name) {
  for (const Method method : {Method::two_arcs, Method::spindle_rotation, Method::circles}) {
    if (name == name_of(method)) return method;
  }
  return std::nullopt;
}

}  // namespace ballbar
