#include "next_test/adapter.hpp"

#include <cmath>
#include <limits>

#include "next_test/plans.hpp"

namespace ballbar::next_test {
namespace {

constexpr double kNight_s = 36.0 * 3600.0;  // of many time constants
constexpr double kNightRow_s = 1800.0;
constexpr double kCooling_s = 3600.0;

// Rows of the night before a run: at rest, temperatures on their way to those that the run begins with; nothing is
// measured.
void add_night(Series& data, const Series& next) {
  const std::size_t last = data.time_s.size() - 1;
  const double end_s = data.time_s.back();
  for (double since_s = kNightRow_s; since_s < kNight_s; since_s += kNightRow_s) {
    data.time_s.push_back(end_s + since_s);
    for (std::size_t k = 0; k < data.columns.size(); ++k) {
      Column& column = data.columns[k];
      const double goal = next.columns[k].values.front(), from = column.values[last];
      const bool cools = unit_of(column.name) == "degC";
      double value = cools ? goal + (from - goal) * std::exp(-since_s / kCooling_s) : goal;
      if (column.role == Role::measured || unit_of(column.name) == "um") {
        value = std::numeric_limits<double>::quiet_NaN();
      }
      column.values.push_back(value);
    }
  }
}

}  // namespace

// On one axis of time with nights at rest between the runs, and a step of the target in each night.
Joined joined(const Model& model, const std::vector<Series>& runs) {
  Joined result{runs.front(), model};
  for (std::size_t r = 1; r < runs.size(); ++r) {
    const Series& next = runs[r];
    add_night(result.data, next);
    const double begins_s = result.data.time_s.back() + kNightRow_s;
    for (const double time_s : next.time_s) result.data.time_s.push_back(begins_s + time_s);
    for (std::size_t k = 0; k < result.data.columns.size(); ++k) {
      std::vector<double>& values = result.data.columns[k].values;
      values.insert(values.end(), next.columns[k].values.begin(), next.columns[k].values.end());
    }
    Term set_up = term_of("step", {});
    for (std::size_t k = 0; k < set_up.settings.size(); ++k) {
      if (set_up.effect->parameters[k].shape_of != ShapeOf::onset) continue;
      set_up.settings[k].held = set_up.settings[k].stated = true;
      set_up.settings[k].start = begins_s - 0.5 * kNight_s;
    }
    result.model.terms.push_back(std::move(set_up));
  }
  return result;
}

std::optional<Design> plan_of(const Joined&, const Diagnosis&, double hours, double max_rpm, std::uint64_t seed) {
  return Design{staircase(hours, max_rpm, seed), std::numeric_limits<double>::quiet_NaN()};
}

}  // namespace ballbar::next_test
