#include "diagnosis/next_test/test_plans.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ballbar/number_text.hpp"
#include "ballbar/series/speed_steps.hpp"
#include "series/standstill.hpp"

namespace ballbar {

const Column* first_speed(const Series& data) {
  for (const Column& column : data.columns) {
    if (column.role == Role::speed && largest_of(column.values) > 0.0) return &column;
  }
  return nullptr;
}

Speeds speeds_of(const Series& data) {
  const Column* column = first_speed(data);
  if (column == nullptr) return {};
  std::vector<double> kept{0.0};
  for (const SpeedStep& step : speed_steps(data.time_s, *column)) {
    const double length_s = data.time_s[step.end - 1] - data.time_s[step.begin];
    if (std::isfinite(step.speed_rpm) && length_s >= 600.0) kept.push_back(std::abs(step.speed_rpm));
  }
  std::sort(kept.begin(), kept.end());
  Speeds speeds{kept.back(), 0.0};
  double widest = 0.0;
  for (std::size_t i = 1; i < kept.size(); ++i) {
    if (kept[i] - kept[i - 1] <= widest) continue;
    widest = kept[i] - kept[i - 1];
    speeds.other_rpm = 0.5 * (kept[i] + kept[i - 1]);
  }
  if (widest < 0.25 * speeds.full_rpm) speeds.other_rpm = 0.0;  // all of the range was run
  const double rounded_rpm = 100.0 * std::round(speeds.other_rpm / 100.0);
  if (rounded_rpm > 0.0) speeds.other_rpm = rounded_rpm;
  return speeds;
}

std::vector<Plan> plans_of(const Speeds& speeds, const Logged& logged) {
  const double full = speeds.full_rpm;
  const std::string at_full = fmt::format("at {} rpm", grouped_text(full));
  std::vector<Plan> plans{{"at rest", "3 h at rest", {{3.0, 0.0}}}};
  const std::string warmer = fmt::format("the room made {:g} K warmer (door, air conditioning)", kStep_K);
  if (logged.room) plans.push_back({"room step at rest", "4 h at rest, after 1 h " + warmer, {{4.0, 0.0}}, 1.0});
  if (logged.coolant && full == 0.0) {
    plans.push_back({"coolant step",
                     fmt::format("3 h at rest, after 1 h the coolant set {:g} K warmer", kStep_K),
                     {{3.0, 0.0}},
                     -1.0,
                     1.0});
  }
  if (full == 0.0) return plans;
  plans.push_back({"standstill from warm", fmt::format("1 h {}, 2 h at rest", at_full), {{1.0, full}, {2.0, 0.0}}});
  plans.push_back(
      {"stop and go", fmt::format("1 h at rest, 1 h {}, 1 h at rest", at_full), {{1.0, 0.0}, {1.0, full}, {1.0, 0.0}}});
  if (speeds.other_rpm > 0.0) {
    plans.push_back({"another speed",
                     fmt::format("2 h at {} rpm, 1 h at rest", grouped_text(speeds.other_rpm)),
                     {{2.0, speeds.other_rpm}, {1.0, 0.0}}});
  }
  Plan folds{"several cycles", fmt::format("40 min {} and 40 min at rest, three times", at_full), {}};
  for (int k = 0; k < 3; ++k) folds.stretches.insert(folds.stretches.end(), {{2.0 / 3.0, full}, {2.0 / 3.0, 0.0}});
  plans.push_back(std::move(folds));
  Plan dwells{"two dwell lengths",
              fmt::format("10 min {0} and 10 min at rest, six times, then 1 h {0} and 1 h at rest", at_full),
              {}};
  for (int k = 0; k < 6; ++k) dwells.stretches.insert(dwells.stretches.end(), {{1.0 / 6.0, full}, {1.0 / 6.0, 0.0}});
  dwells.stretches.insert(dwells.stretches.end(), {{1.0, full}, {1.0, 0.0}});
  plans.push_back(std::move(dwells));
  if (logged.room) {
    plans.push_back({"room step at speed", fmt::format("4 h {}, after 2 h {}", at_full, warmer), {{4.0, full}}, 2.0});
  }
  if (logged.coolant) {
    plans.push_back({"coolant step",
                     fmt::format("4 h {}, after 2 h the coolant set {:g} K warmer", at_full, kStep_K),
                     {{4.0, full}},
                     -1.0,
                     2.0});
  }
  if (logged.load) {
    plans.push_back({"load step",
                     fmt::format("4 h {}, after 2 h {:g} times the load (cutting, brake)", at_full, kStepOfLoad),
                     {{4.0, full}},
                     -1.0,
                     -1.0,
                     2.0});
  }
  return plans;
}

}  // namespace ballbar
