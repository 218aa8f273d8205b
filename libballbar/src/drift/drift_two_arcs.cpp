// Drift from two orthogonal arcs about C and A (He, Fu, Chen 2015).
#include "ballbar/units.hpp"
#include "drift/drift_methods.hpp"
#include "drift/two_arc_position.hpp"

namespace ballbar {

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
    Eigen::Matrix<double, 5, 5> covariance = Eigen::Matrix<double, 5, 5>::Zero();
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
  series.not_cancelled =
      "Set-up errors cancel in the difference to the reference test; drift of the table and of the axes A and C, "
      "and a ball moved between tests, do not.";
  return series;
}

}  // namespace ballbar
