// Drift from circle recordings, one or more planes and directions a test.
#include <fmt/format.h>

#include <array>
#include <string>

#include "ballbar/message_catalogue.hpp"
#include "ballbar/units.hpp"
#include "drift/drift_methods.hpp"

namespace ballbar {
namespace {

double sign_of(const Recording& recording) { return recording.moving_ball == MovingBall::spindle ? 1.0 : -1.0; }

// The recordings of one plane in one test, each with its circle.
struct Sweep {
  const Recording* recording;
  const Circle* circle;
};
using Sweeps = std::vector<Sweep>;

Sweeps in_plane(const SessionTest& test, const std::vector<Circle>& circles, Plane plane) {
  Sweeps sweeps;
  for (std::size_t i = 0; i < circles.size(); ++i) {
    if (test.circles[i].plane == plane) sweeps.push_back({&test.circles[i], &circles[i]});
  }
  for (const Sweep& sweep : sweeps) {
    if (sweep.recording->moving_ball != sweeps.front().recording->moving_ball) {
      throw Error("the moving ball is in the spindle in one recording of a plane and on the table in another");
    }
  }
  return sweeps;
}

// Mean of (a, b) signed as drift, and of R; um.
Eigen::Vector3d mean_of(const Sweeps& sweeps) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto& [recording, circle] : sweeps) {
    const double sign = sign_of(*recording);
    sum += Eigen::Vector3d(sign * circle->centre_a_um, sign * circle->centre_b_um, um_from_mm(circle->radius_mm));
  }
  return sum / static_cast<double>(sweeps.size());
}

Eigen::Vector3d mean_variance_of(const Sweeps& sweeps) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Sweep& sweep : sweeps) sum += sweep.circle->covariance_um2.diagonal();
  const double n = static_cast<double>(sweeps.size());
  return sum / (n * n);
}

// Variance of the change of the means: sweep by sweep where each has its partner of the same direction.
Eigen::Vector3d variance_of_change(const Sweeps& now, const Sweeps& reference) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  std::vector<bool> taken(reference.size(), false);
  for (const Sweep& sweep : now) {
    std::size_t k = 0;
    while (k < reference.size() && (taken[k] || reference[k].recording->direction != sweep.recording->direction)) ++k;
    if (k == reference.size() || now.size() != reference.size()) {
      return mean_variance_of(now) + mean_variance_of(reference);
    }
    taken[k] = true;
    sum += covariance_of_change_um2(*sweep.recording, *sweep.circle, *reference[k].recording, *reference[k].circle)
               .diagonal();
  }
  const double n = static_cast<double>(now.size());
  return sum / (n * n);
}

// The mean of what is there already and one more estimate of the same quantity.
void average_in(std::optional<Estimate>& have, const Estimate& more) {
  have =
      have ? Estimate{0.5 * (have->value_um + more.value_um), 0.5 * std::hypot(have->sigma_um, more.sigma_um)} : more;
}

Position position_of(const SessionTest& test, const std::vector<Circle>& circles) {
  const Sweeps first = in_plane(test, circles, test.circles.front().plane);
  const Eigen::Vector3d mean = mean_of(first) * sign_of(test.circles.front());
  const Eigen::Vector3d sigma = mean_variance_of(first).cwiseSqrt();
  Position position;
  position.time_s = test.elapsed_s;
  position.centre_a = Estimate{mean[0], sigma[0]};
  position.centre_b = Estimate{mean[1], sigma[1]};
  position.radius_mm = mm_from_um(std::abs(mean[2]));
  position.converged = true;
  for (const Circle& circle : circles) {
    position.discounted += circle.discounted.size();
    position.converged = position.converged && circle.converged;
  }
  return position;
}

}  // namespace

DriftSeries drift_by_circles(const Session& session, const DriftOptions& options) {
  DriftSeries series;
  std::vector<std::vector<Circle>> fits;
  // On an arc the position allows for an oval of the path. The same oval is in all tests, and their difference is that
  // of the circles without it.
  CircleOptions alone = options.circle;
  alone.oval = false;
  for (const SessionTest& test : session.tests) {
    std::vector<Circle> placed;
    fits.push_back(in_test(test, [&] {
      if (test.circles.empty()) throw Error("circles needs at least one circle recording in every test");
      placed = test.stored;
      if (placed.empty()) {
        for (const Recording& recording : test.circles) placed.push_back(fit_circle(recording, options.circle));
      }
      std::vector<Circle> circles = placed;
      for (std::size_t i = 0; i < circles.size(); ++i) {
        if (circles[i].oval_um > 0.0) circles[i] = fit_circle(test.circles[i], alone);
      }
      return circles;
    }));
    series.positions.push_back(position_of(test, placed));
    series.points.emplace_back().time_s = test.elapsed_s;
  }
  std::string references;
  std::optional<std::size_t> first_reference;
  bool differ = false;
  std::string once;  // planes of one test
  for (const Plane plane : kPlanes) {
    std::vector<std::size_t> tests;
    std::vector<double> times_s;
    for (std::size_t i = 0; i < fits.size(); ++i) {
      if (in_plane(session.tests[i], fits[i], plane).empty()) continue;
      tests.push_back(i);
      times_s.push_back(session.tests[i].elapsed_s);
    }
    if (tests.empty()) continue;
    // The only test of a plane has nothing to differ from: no drift, which is not a drift of 0.
    if (tests.size() == 1 && session.tests.size() > 1) {
      once += fmt::format("{}{}", once.empty() ? "" : ", ", name_of(plane));
      continue;
    }
    const std::size_t reference = tests[reference_index(times_s, options.reference_s)];
    const Sweeps start = in_plane(session.tests[reference], fits[reference], plane);
    references += fmt::format("{}{} to the test at {:g} min", references.empty() ? "" : ", ", name_of(plane),
                              min_from_s(session.tests[reference].elapsed_s));
    if (!first_reference) first_reference = reference;
    differ = differ || reference != *first_reference;
    const auto [a, b] = axes_of(plane);
    for (const std::size_t i : tests) {
      const Sweeps now = in_plane(session.tests[i], fits[i], plane);
      const Eigen::Vector3d change = mean_of(now) - mean_of(start);
      const Eigen::Vector3d sigma =
          i == reference ? Eigen::Vector3d::Zero() : Eigen::Vector3d(variance_of_change(now, start).cwiseSqrt());
      DriftPoint& point = series.points[i];
      const std::array axes{&point.x, &point.y, &point.z};
      average_in(*axes[static_cast<std::size_t>(a)], {change[0], sigma[0]});
      average_in(*axes[static_cast<std::size_t>(b)], {change[1], sigma[1]});
      average_in(point.radius_change, {change[2], sigma[2]});
    }
  }
  if (!first_reference) {
    throw Error(fmt::format("a drift needs at least two tests of the same plane, and there is one of {}", once));
  }
  series.not_cancelled = messages::drift_remains_table();
  if (differ) series.not_cancelled += messages::drift_references(references);
  if (!once.empty()) series.not_cancelled += messages::drift_once(once);
  return series;
}

}  // namespace ballbar
