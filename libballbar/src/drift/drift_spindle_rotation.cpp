// Drift from the spindle-rotation test and the axial gauge (Huang, Li, Zhao 2022).

#include "ballbar/circle/circle.hpp"
#include "ballbar/message_catalogue.hpp"
#include "ballbar/units.hpp"
#include "drift/drift_methods.hpp"
#include "numerics/not_finite.hpp"

namespace ballbar {
namespace {

// Axial length of a test, um; a length read off a display has no sigma.
Estimate axial_length_of(const SessionTest& test) {
  if (test.axial_length_mm) return {um_from_mm(*test.axial_length_mm), kUnknown};
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

}  // namespace

DriftSeries drift_by_spindle_rotation(const Session& session, const DriftOptions& options, std::size_t reference) {
  std::vector<Estimate> lengths;
  for (const SessionTest& test : session.tests) {
    lengths.push_back(in_test(test, [&] { return axial_length_of(test); }));
  }
  const double sign = session.spindle_above ? 1.0 : -1.0;
  const auto elongation_um = [&](std::size_t i) { return sign * (lengths[reference].value_um - lengths[i].value_um); };
  std::vector<Circle> circles;
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    const SessionTest& test = session.tests[i];
    CircleOptions circle_options = options.circle;
    circle_options.elongation_um = elongation_um(i);
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
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
    if (!is_reference) {
      covariance = covariance_of_change_um2(*session.tests[i].rotation, now, *session.tests[reference].rotation, start);
    }
    // The correction took dL out of the radius: dR / d(dL) = -(h + dL) / R (exact), about -dL / R (eq34).
    const Estimate axial{elongation_um(i),
                         is_reference ? 0.0 : std::hypot(lengths[i].sigma_um, lengths[reference].sigma_um)};
    const bool exact = options.circle.elongation_form == ElongationForm::exact;
    const double lever_mm = (exact ? session.tests[i].rotation->height_offset_mm : 0.0) + mm_from_um(axial.value_um);
    const double by_elongation_um = lever_mm == 0.0 ? 0.0 : lever_mm / now.radius_mm * axial.sigma_um;
    const Eigen::Vector2d shift(now.centre_a_um - start.centre_a_um, now.centre_b_um - start.centre_b_um);
    DriftPoint point;
    point.time_s = session.tests[i].elapsed_s;
    point.radial = size_of(shift, covariance.topLeftCorner<2, 2>());
    point.shift_a = Estimate{shift.x(), std::sqrt(covariance(0, 0))};
    point.shift_b = Estimate{shift.y(), std::sqrt(covariance(1, 1))};
    point.axial = axial;
    point.radius_change = Estimate{um_from_mm(now.radius_mm - start.radius_mm),
                                   std::hypot(std::sqrt(covariance(2, 2)), by_elongation_um)};
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
  series.not_cancelled = messages::drift_remains_rotation();
  return series;
}

}  // namespace ballbar
