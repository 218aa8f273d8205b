#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "ballbar/diagnosis/thresholds.hpp"
#include "ballbar/model/measured_input.hpp"
#include "ballbar/number_text.hpp"
#include "diagnosis/next_test/planned_test.hpp"
#include "diagnosis/next_test/test_plans.hpp"
#include "diagnosis/next_test/thermal_forecast.hpp"
#include "numerics/median.hpp"

namespace ballbar {
namespace {

constexpr double kSignals_s = 60.0;
constexpr double kMostReadings = 1500.0;
constexpr double kRepeated_s = 4.0 * 3600.0;

double mean_of(const std::vector<double>& values) {
  double sum = 0.0, count = 0.0;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    sum += value;
    count += 1.0;
  }
  return count > 0.0 ? sum / count : 0.0;
}

// Row by row over the columns of a role that have a value; a row without any takes the one before. Empty: none.
std::vector<double> mean_of_role(const Series& data, Role role) {
  std::vector<const Column*> columns;
  for (const Column& column : data.columns) {
    const bool any = std::any_of(column.values.begin(), column.values.end(), [](double v) { return std::isfinite(v); });
    if (column.role == role && any) columns.push_back(&column);
  }
  std::vector<double> result;
  for (std::size_t row = 0; !columns.empty() && row < data.time_s.size(); ++row) {
    double sum = 0.0, count = 0.0;
    for (const Column* column : columns) {
      if (!std::isfinite(column->values[row])) continue;
      sum += column->values[row];
      count += 1.0;
    }
    const double before = result.empty() ? mean_of(columns.front()->values) : result.back();
    result.push_back(count > 0.0 ? sum / count : before);
  }
  return result;
}

// What the columns of the data have followed.
struct Learned {
  std::vector<std::vector<double>> values;
  std::vector<Forecast> forecasts;    // coolant: of speed and room, the others of coolant too
  std::vector<double> room, coolant;  // in the data; empty: none
  bool speed = false;
};

Learned learned_from(const Series& data) {
  Learned result;
  for (const Column& column : data.columns) result.values.push_back(input_values(data, column));
  Drives drives;
  drives.time_s = data.time_s;
  if (const Column* speed = first_speed(data)) {
    drives.speed = speed->values;
    for (std::size_t i = 0; i < drives.speed.size(); ++i) {
      if (!std::isfinite(drives.speed[i])) drives.speed[i] = i > 0 ? drives.speed[i - 1] : 0.0;
    }
  }
  result.speed = !drives.speed.empty();
  result.room = drives.room = mean_of_role(data, Role::ambient);
  result.coolant = mean_of_role(data, Role::coolant);
  const std::vector<Forecast> without = forecasts_of(drives, result.values);
  drives.coolant = result.coolant;
  result.forecasts = result.coolant.empty() ? without : forecasts_of(drives, result.values);
  for (std::size_t k = 0; k < data.columns.size(); ++k) {
    if (data.columns[k].role == Role::coolant) result.forecasts[k] = without[k];
  }
  return result;
}

bool is_held(const Column& column) { return column.role == Role::load || column.role == Role::event; }

// Means at rest and turning; what the data have not is nothing.
struct Load {
  double at_rest = 0.0, turning = 0.0;
};

Load load_of(const std::vector<double>& values, const Series& data) {
  const Column* speed = first_speed(data);
  std::vector<double> at_rest, turning;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const bool turns = speed != nullptr && std::abs(speed->values[i]) > 0.0;
    (turns ? turning : at_rest).push_back(values[i]);
  }
  return {mean_of(at_rest), mean_of(turning)};
}

PlannedTest planned(const Plan& plan, const Series& data, const std::string& target, const Learned& learned,
                    double reading_s) {
  PlannedTest result;
  result.name = plan.name;
  result.doing = plan.doing;
  double hours = 0.0;
  for (const Stretch& stretch : plan.stretches) hours += stretch.hours;
  result.duration_s = 3600.0 * hours;
  reading_s = std::max(reading_s, result.duration_s / kMostReadings);
  const auto each = static_cast<std::size_t>(std::max(1.0, std::ceil(reading_s / kSignals_s - 1e-9)));
  const auto readings = static_cast<std::size_t>(std::floor(result.duration_s / reading_s + 1e-9));
  Drives drives;
  for (std::size_t i = 0; i <= readings * each; ++i) {
    const double time_s = static_cast<double>(i) * reading_s / static_cast<double>(each);
    drives.time_s.push_back(time_s);
    if (i % each == 0) result.rows.push_back(i);
    double left_h = i == 0 ? -1.0 : time_s / 3600.0;  // before the first row: at rest
    double rpm = 0.0;
    for (const Stretch& stretch : plan.stretches) {
      if (left_h <= 0.0) break;
      rpm = stretch.speed_rpm;
      left_h -= stretch.hours + 1e-9;
    }
    if (learned.speed) drives.speed.push_back(rpm);
    const auto stepped = [&](double at_h) { return at_h >= 0.0 && time_s > 3600.0 * at_h ? kStep_K : 0.0; };
    if (!learned.room.empty()) drives.room.push_back(mean_of(learned.room) + stepped(plan.room_step_h));
    if (!learned.coolant.empty()) drives.coolant.push_back(stepped(plan.coolant_step_h));
  }
  result.inputs.time_s = drives.time_s;
  result.inputs.five_probe = data.five_probe;
  const std::vector<double> coolant_step = std::move(drives.coolant);
  drives.coolant.clear();
  const auto follow = [&](std::size_t k, bool coolant) {
    const Column& column = data.columns[k];
    Column next{column.name, column.role, {}};
    const double mean = mean_of(learned.values[k]);
    if (column.role == Role::speed) {
      next.values = drives.speed.empty() ? std::vector<double>(drives.time_s.size(), 0.0) : drives.speed;
    } else if (column.role == Role::ambient && !drives.room.empty()) {
      for (const double room : drives.room) next.values.push_back(room - mean_of(learned.room) + mean);
    } else if (learned.forecasts[k].r2 >= kBelieved && !is_held(column)) {
      next.values = predicted(learned.forecasts[k], drives);
      result.forecast_columns.push_back(column.name);
      result.forecast.push_back(fmt::format("{} (R2 = {:.2f})", column.name, learned.forecasts[k].r2));
    } else if (column.role == Role::load && !drives.speed.empty()) {
      const Load load = load_of(learned.values[k], data);
      for (std::size_t i = 0; i < drives.time_s.size(); ++i) {
        const bool more = plan.load_step_h >= 0.0 && drives.time_s[i] > 3600.0 * plan.load_step_h;
        next.values.push_back(std::abs(drives.speed[i]) > 0.0 ? (more ? kStepOfLoad : 1.0) * load.turning
                                                              : load.at_rest);
      }
    } else {
      next.values.assign(drives.time_s.size(), mean);
      const bool stepped = coolant && plan.coolant_step_h >= 0.0;
      if (!is_held(column) && !stepped) result.unknown.push_back(column.name);
    }
    if (coolant) {
      for (std::size_t i = 0; i < next.values.size(); ++i) next.values[i] += coolant_step[i];
    }
    result.inputs.columns[k] = std::move(next);
  };
  result.inputs.columns.resize(data.columns.size());
  for (std::size_t k = 0; k < data.columns.size(); ++k) {
    if (data.columns[k].role == Role::coolant && !learned.coolant.empty()) follow(k, true);
  }
  std::vector<double> coolant;
  if (!learned.coolant.empty()) {
    Series so_far = result.inputs;
    std::erase_if(so_far.columns, [](const Column& column) { return column.values.empty(); });
    coolant = mean_of_role(so_far, Role::coolant);
  }
  drives.coolant = std::move(coolant);
  for (std::size_t k = 0; k < data.columns.size(); ++k) {
    if (result.inputs.columns[k].values.empty()) follow(k, false);
  }
  std::erase_if(result.inputs.columns, [&](const Column& column) { return column.name == target; });
  return result;
}

// The first hours of the data once more.
PlannedTest repeated(const Series& data, const std::string& target, const std::vector<std::size_t>& rows) {
  constexpr std::size_t kFewest = 8;
  PlannedTest result;
  for (const std::size_t row : rows) {
    if (result.rows.size() >= kFewest && data.time_s[row] - data.time_s.front() > kRepeated_s) break;
    result.rows.push_back(row);
  }
  const auto end = static_cast<std::ptrdiff_t>(result.rows.back() + 1);
  for (std::ptrdiff_t i = 0; i < end; ++i) {
    result.inputs.time_s.push_back(data.time_s[static_cast<std::size_t>(i)] - data.time_s.front());
  }
  result.inputs.five_probe = data.five_probe;
  for (const Column& column : data.columns) {
    if (column.name == target) continue;
    const std::vector<double> values = input_values(data, column);
    result.inputs.columns.push_back({column.name, column.role, {values.begin(), values.begin() + end}});
  }
  result.duration_s = result.inputs.time_s.back();
  return result;
}

}  // namespace

std::vector<PlannedTest> drift_tests(const Series& data, const std::string& target,
                                     const std::vector<std::size_t>& rows) {
  std::vector<PlannedTest> tests;
  if (rows.size() < 2 || rows.back() >= data.time_s.size()) return tests;
  const double whole_s = data.time_s[rows.back()] - data.time_s.front();
  PlannedTest again = repeated(data, target, rows);
  const bool is_part = again.duration_s < whole_s - 4e-6;
  const std::string what =
      fmt::format("the {}{} of these data", is_part ? "first " : "", duration_text(again.duration_s));
  again.name = "the same again";
  again.doing = what + " once more, the set-up untouched and the machine cold as then";
  tests.push_back(again);
  again.name = "new set-up";
  again.doing = "mount and zero everything anew, then " + what + " once more";
  again.new_set_up = true;
  tests.push_back(std::move(again));

  std::vector<double> gaps_s;
  for (std::size_t i = 1; i < rows.size(); ++i) gaps_s.push_back(data.time_s[rows[i]] - data.time_s[rows[i - 1]]);
  const double reading_s = gaps_s.empty() ? 0.0 : median(gaps_s);
  if (!(reading_s > 0.0)) return tests;
  const Learned learned = learned_from(data);
  const bool load = std::any_of(data.columns.begin(), data.columns.end(),
                                [](const Column& column) { return column.role == Role::load; });
  for (const Plan& plan : plans_of(speeds_of(data), {!learned.room.empty(), !learned.coolant.empty(), load})) {
    tests.push_back(planned(plan, data, target, learned, reading_s));
  }
  return tests;
}

}  // namespace ballbar
