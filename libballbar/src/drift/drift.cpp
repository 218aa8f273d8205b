#include "ballbar/drift/drift.hpp"

#include <array>
#include <cmath>

#include "ballbar/error.hpp"
#include "drift/drift_methods.hpp"

namespace ballbar {

std::size_t reference_index(const std::vector<double>& times_s, const std::optional<double>& wanted_s) {
  std::size_t best = 0;
  if (!wanted_s) return best;
  for (std::size_t i = 1; i < times_s.size(); ++i) {
    if (std::abs(times_s[i] - *wanted_s) < std::abs(times_s[best] - *wanted_s)) best = i;
  }
  return best;
}

DriftSeries drift_of(const Session& session, const DriftOptions& options) {
  if (session.tests.empty()) throw Error("the session has no test; drift needs at least one");
  std::vector<double> times_s;
  for (const SessionTest& test : session.tests) times_s.push_back(test.elapsed_s);
  const std::size_t reference = reference_index(times_s, options.reference_s);
  DriftSeries series = session.method == Method::two_arcs ? drift_by_two_arcs(session, options, reference)
                       : session.method == Method::spindle_rotation
                           ? drift_by_spindle_rotation(session, options, reference)
                           : drift_by_circles(session, options);
  series.method = session.method;
  series.reference_s = times_s[reference];
  return series;
}

std::string_view name_of(Method method) {
  constexpr std::array<std::string_view, 3> kMethods{"two_arcs", "spindle_rotation", "circles"};
  return kMethods[static_cast<std::size_t>(method)];
}

std::optional<Estimate> combined_drift(const DriftPoint& point) {
  double square = 0.0, along = 0.0;
  int known = 0;
  for (const std::optional<Estimate>* axis : {&point.x, &point.y, &point.z}) {
    if (!*axis) continue;
    ++known;
    square += (*axis)->value_um * (*axis)->value_um;
    along += (*axis)->value_um * (*axis)->value_um * (*axis)->sigma_um * (*axis)->sigma_um;
  }
  if (known < 2) return std::nullopt;
  return Estimate{std::sqrt(square), square > 0.0 ? std::sqrt(along / square) : 0.0};
}

}  // namespace ballbar
