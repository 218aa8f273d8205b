#include "diagnosis/next_test/planned_inputs.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "ballbar/series/series.hpp"
#include "model/measured_input.hpp"
#include "numerics/interpolation.hpp"
#include "numerics/random_streams.hpp"
#include "series/resolution.hpp"
#include "series/standstill.hpp"

namespace ballbar {
namespace {

constexpr double kBelieved = 0.5;  // smallest R2 to use the prediction of a column

// Of the rows that are used; `none` without them.
template <class IsUsed>
double mean_of(const std::vector<double>& values, double none, const IsUsed& is_used) {
  double sum = 0.0, count = 0.0;
  for (std::size_t row = 0; row < values.size(); ++row) {
    if (!is_used(row)) continue;
    sum += values[row];
    count += 1.0;
  }
  return count > 0.0 ? sum / count : none;
}

// A gap takes the value before it, at the beginning the first there is.
std::vector<double> without_gaps(std::vector<double> values) {
  const auto first = std::find_if(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
  double last = first == values.end() ? 0.0 : *first;
  for (double& value : values) last = value = std::isfinite(value) ? value : last;
  return values;
}

// Mean of the columns of a role, row by row; empty: there is none.
std::vector<double> mean_of_role(const Series& data, Role role) {
  std::vector<double> sum;
  double count = 0.0;
  for (const Column& column : data.columns) {
    if (column.role != role) continue;
    sum.resize(column.values.size(), 0.0);
    for (std::size_t row = 0; row < sum.size(); ++row) sum[row] += column.values[row];
    count += 1.0;
  }
  for (double& value : sum) value /= count;
  return sum;
}

void add(std::vector<double>& values, const std::vector<double>& other, double factor = 1.0) {
  for (std::size_t row = 0; row < values.size(); ++row) values[row] += factor * other[row];
}

// The residual from a moment on, forwards and backwards for as long as is wanted.
std::vector<double> continued(const std::vector<double>& residual, const std::vector<double>& known_s, double from_s,
                              const std::vector<double>& time_s) {
  const double span_s = known_s.back();
  std::vector<double> result;
  result.reserve(time_s.size());
  for (const double t_s : time_s) {
    double at_s = span_s > 0.0 ? std::fmod(from_s + t_s, 2.0 * span_s) : 0.0;
    if (at_s > span_s) at_s = 2.0 * span_s - at_s;
    const std::optional<Place> place = place_of(known_s, std::clamp(at_s, 0.0, span_s));
    result.push_back(place ? value_at(residual, *place) : residual.front());
  }
  return result;
}

}  // namespace

const Column* first_speed(const Series& data) {
  for (const Column& column : data.columns) {
    if (column.role == Role::speed && largest_of(column.values) > 0.0) return &column;
  }
  return nullptr;
}

PlannedInputs planned_inputs(const Series& data, std::string_view target) {
  Series filled = data;
  std::erase_if(filled.columns, [&](const Column& column) { return column.name == target; });
  std::vector<std::vector<double>> logged;
  PlannedInputs planned;
  for (Column& column : filled.columns) {
    logged.push_back(input_values(data, column));
    planned.columns.emplace_back().resolution = resolution_of(column.values);
    column.values = without_gaps(logged.back());
  }
  planned.none = rows_of(filled, {0, 0});
  Drives drives{data.time_s, {}, mean_of_role(filled, Role::ambient), mean_of_role(filled, Role::coolant)};
  if (const Column* speed = first_speed(filled)) drives.speed = speed->values;
  planned.has_speed = !drives.speed.empty();
  Drives of_coolant = drives;  // which does not follow itself
  of_coolant.coolant.clear();
  const std::vector<Forecast> forecasts = forecasts_of(drives, logged);
  const std::vector<Forecast> coolants = drives.coolant.empty() ? forecasts : forecasts_of(of_coolant, logged);
  const auto is_turning = [&](std::size_t row) { return planned.has_speed && std::abs(drives.speed[row]) > 0.0; };
  const auto is_at_rest = [&](std::size_t row) { return planned.has_speed && !is_turning(row); };
  std::vector<double> rpm = drives.speed;
  for (double& one : rpm) one = std::abs(one);
  planned.turning_rpm = mean_of(rpm, 0.0, is_turning);

  for (std::size_t k = 0; k < planned.columns.size(); ++k) {
    Column& column = filled.columns[k];
    ContinuedColumn& one = planned.columns[k];
    one.mean = mean_of(column.values, 0.0, [](std::size_t) { return true; });
    one.at_rest = mean_of(column.values, 0.0, is_at_rest);
    one.turning = mean_of(column.values, one.mean, is_turning);
    const bool is_coolant = column.role == Role::coolant;
    if (column.role != Role::ambient) one.forecast = is_coolant ? coolants[k] : forecasts[k];
    if (one.forecast.r2 >= kBelieved)
      add(column.values, predicted(one.forecast, is_coolant ? of_coolant : drives), -1.0);
  }
  const std::vector<RowRange> runs = runs_of(data.time_s);
  const Series longest = rows_of(filled, *std::max_element(runs.begin(), runs.end(), [](RowRange a, RowRange b) {
                                   return a.end - a.begin < b.end - b.begin;
                                 }));
  for (const double time_s : longest.time_s) planned.time_s.push_back(time_s - longest.time_s.front());
  for (std::size_t k = 0; k < planned.columns.size(); ++k) planned.columns[k].residual = longest.columns[k].values;
  return planned;
}

Series inputs_under(const Schedule& schedule, const PlannedInputs& planned, std::mt19937_64& random) {
  Drives drives;
  std::vector<const Dwell*> dwells;
  const auto rows = static_cast<std::size_t>(std::floor(duration_s(schedule) / schedule.reading_s + 1e-9)) + 1;
  for (std::size_t i = 0; i < rows; ++i) {
    drives.time_s.push_back(static_cast<double>(i) * schedule.reading_s);
    dwells.push_back(&dwell_at(schedule, drives.time_s.back()));
    if (planned.has_speed) drives.speed.push_back(i == 0 && !schedule.starts_warm ? 0.0 : dwells.back()->speed_rpm);
  }
  const double from_s = planned.time_s.back() * 2.0 * simulation::uniform(random);
  Series result = planned.none;
  result.time_s = drives.time_s;
  const auto values_of = [&](Role role, const ContinuedColumn& column) {
    std::vector<double> values(rows, column.mean);
    if (role == Role::event) return values;
    if (role == Role::speed) return planned.has_speed ? drives.speed : std::vector<double>(rows, 0.0);
    if (role == Role::load) {
      for (std::size_t i = 0; i < rows; ++i) {
        const double rpm = planned.has_speed ? std::abs(drives.speed[i]) : 0.0;
        const double share = planned.turning_rpm > 0.0 ? rpm / planned.turning_rpm : 0.0;
        const double now = column.at_rest + share * (column.turning - column.at_rest);
        values[i] = rpm > 0.0 ? now * dwells[i]->load : column.at_rest;
      }
      return values;
    }
    values = continued(column.residual, planned.time_s, from_s, drives.time_s);
    if (column.forecast.r2 >= kBelieved) add(values, predicted(column.forecast, drives));
    for (std::size_t i = 0; i < rows; ++i) {
      if (role == Role::ambient) values[i] += dwells[i]->room_K;
      if (role == Role::coolant) values[i] += dwells[i]->coolant_K;
    }
    return values;
  };
  const auto simulate = [&](const auto& is_now) {
    for (std::size_t k = 0; k < planned.columns.size(); ++k) {
      Column& column = result.columns[k];
      if (is_now(column.role)) column.values = values_of(column.role, planned.columns[k]);
    }
  };
  // In the order in which they follow one another: room, coolant, the rest.
  simulate([](Role role) { return role == Role::ambient; });
  drives.room = mean_of_role(result, Role::ambient);
  simulate([](Role role) { return role == Role::coolant; });
  drives.coolant = mean_of_role(result, Role::coolant);
  simulate([](Role role) { return role != Role::ambient && role != Role::coolant; });
  for (std::size_t k = 0; k < planned.columns.size(); ++k) {
    for (double& value : result.columns[k].values) value = simulation::rounded(value, planned.columns[k].resolution);
  }
  return result;
}

Series with_run(Series data, const Series& run) {
  std::erase_if(data.columns, [&](const Column& column) { return find_column(run, column.name) == nullptr; });
  if (runs_of(data.time_s).size() < 2) {
    const double begin_s = data.time_s.front();
    for (double& time_s : data.time_s) time_s -= begin_s;
    data.runs = {{"data", RunStart::rest}};
  }
  data.time_s.insert(data.time_s.end(), run.time_s.begin(), run.time_s.end());
  for (Column& column : data.columns) {
    const std::vector<double>& values = find_column(run, column.name)->values;
    column.values.insert(column.values.end(), values.begin(), values.end());
  }
  data.runs.push_back({"test", RunStart::rest});
  return data;
}

}  // namespace ballbar
