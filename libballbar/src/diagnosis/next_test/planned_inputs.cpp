#include "diagnosis/next_test/planned_inputs.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "ballbar/diagnosis/thresholds.hpp"
#include "ballbar/model/measured_input.hpp"
#include "ballbar/series/runs.hpp"
#include "numerics/interpolation.hpp"
#include "numerics/random_streams.hpp"
#include "series/resolution.hpp"
#include "series/standstill.hpp"

namespace ballbar {
namespace {

constexpr double kBelieved = 0.5;  // smallest R2 to use the prediction of a column

double mean_of(const std::vector<double>& values) {
  const double sum = std::accumulate(values.begin(), values.end(), 0.0);
  return values.empty() ? 0.0 : sum / static_cast<double>(values.size());
}

// A gap takes the value before it, at the beginning the first there is.
std::vector<double> without_gaps(std::vector<double> values) {
  const auto first = std::find_if(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
  double last = first == values.end() ? 0.0 : *first;
  for (double& value : values) last = value = std::isfinite(value) ? value : last;
  return values;
}

// Mean of the columns of a role, row by row; empty: there is none.
std::vector<double> mean_of_role(const Series& data, Role role, const std::string& target) {
  std::vector<double> sum;
  double count = 0.0;
  for (const Column& column : data.columns) {
    if (column.role != role || column.name == target) continue;
    const std::vector<double> values = without_gaps(column.values);
    sum.resize(values.size(), 0.0);
    for (std::size_t row = 0; row < values.size(); ++row) sum[row] += values[row];
    count += 1.0;
  }
  for (double& value : sum) value /= count;
  return sum;
}

Drives drives_in(const Series& data, const std::string& target, bool with_coolant) {
  Drives drives;
  drives.time_s = data.time_s;
  if (const Column* speed = first_speed(data)) drives.speed = without_gaps(speed->values);
  drives.room = mean_of_role(data, Role::ambient, target);
  if (with_coolant) drives.coolant = mean_of_role(data, Role::coolant, target);
  return drives;
}

}  // namespace

const Column* first_speed(const Series& data) {
  for (const Column& column : data.columns) {
    if (column.role == Role::speed && largest_of(column.values) > 0.0) return &column;
  }
  return nullptr;
}

PlannedInputs::PlannedInputs(const Series& data, std::string target) : data_(data), target_(std::move(target)) {
  std::vector<std::vector<double>> all;
  for (const Column& column : data.columns) all.push_back(input_values(data, column));
  const Drives with = drives_in(data, target_, true), without = drives_in(data, target_, false);
  has_speed_ = !with.speed.empty();
  has_room_ = !with.room.empty();
  has_coolant_ = !with.coolant.empty();
  forecasts_ = forecasts_of(with, all);
  if (has_coolant_) {
    const std::vector<Forecast> of_coolant = forecasts_of(without, all);
    for (std::size_t k = 0; k < all.size(); ++k) {
      if (data.columns[k].role == Role::coolant) forecasts_[k] = of_coolant[k];
    }
  }
  double turning = 0.0;
  for (const double rpm : with.speed) {
    if (!(std::abs(rpm) > 0.0)) continue;
    turning_rpm_ += std::abs(rpm);
    turning += 1.0;
  }
  if (turning > 0.0) turning_rpm_ /= turning;

  const std::vector<RowRange> runs = runs_of(data.time_s);
  const RowRange longest = *std::max_element(
      runs.begin(), runs.end(), [](const RowRange& a, const RowRange& b) { return a.end - a.begin < b.end - b.begin; });
  for (std::size_t row = longest.begin; row < longest.end; ++row) {
    time_s_.push_back(data.time_s[row] - data.time_s[longest.begin]);
  }
  for (std::size_t k = 0; k < all.size(); ++k) {
    const Column& column = data.columns[k];
    const std::vector<double> values = without_gaps(all[k]);
    Wandering one;
    one.resolution = resolution_of(column.values);
    one.mean = mean_of(values);
    std::vector<double> at_rest, spinning;
    for (std::size_t row = 0; row < values.size() && has_speed_; ++row) {
      (std::abs(with.speed[row]) > 0.0 ? spinning : at_rest).push_back(values[row]);
    }
    one.at_rest = at_rest.empty() ? 0.0 : mean_of(at_rest);
    one.turning = spinning.empty() ? one.mean : mean_of(spinning);
    std::vector<double> expected(values.size(), 0.0);
    if (forecasts_[k].r2 >= kBelieved && column.role != Role::ambient) {
      expected = predicted(forecasts_[k], column.role == Role::coolant ? without : with);
    }
    for (std::size_t row = longest.begin; row < longest.end; ++row) one.values.push_back(values[row] - expected[row]);
    columns_.push_back(std::move(one));
  }
}

// The values of the data from a moment on, forwards and backwards for as long as is wanted.
std::vector<double> PlannedInputs::wandered(std::size_t column, const std::vector<double>& time_s,
                                            double from_s) const {
  const double span_s = time_s_.back();
  std::vector<double> result;
  result.reserve(time_s.size());
  for (const double t_s : time_s) {
    double at_s = span_s > 0.0 ? std::fmod(from_s + t_s, 2.0 * span_s) : 0.0;
    if (at_s > span_s) at_s = 2.0 * span_s - at_s;
    const std::optional<Place> place = place_of(time_s_, std::clamp(at_s, 0.0, span_s));
    result.push_back(place ? value_at(columns_[column].values, *place) : columns_[column].values.front());
  }
  return result;
}

std::vector<double> PlannedInputs::loaded(std::size_t column, const Schedule& schedule, const Drives& drives) const {
  const Wandering& load = columns_[column];
  std::vector<double> result;
  result.reserve(drives.time_s.size());
  for (std::size_t i = 0; i < drives.time_s.size(); ++i) {
    const double rpm = drives.speed.empty() ? 0.0 : std::abs(drives.speed[i]);
    const double share = turning_rpm_ > 0.0 ? rpm / turning_rpm_ : 0.0;
    const double now = load.at_rest + share * (load.turning - load.at_rest);
    result.push_back(rpm > 0.0 ? now * dwell_at(schedule, drives.time_s[i]).load : load.at_rest);
  }
  return result;
}

Series PlannedInputs::under(const Schedule& schedule, std::mt19937_64& random) const {
  Drives drives;
  const auto rows = static_cast<std::size_t>(std::floor(duration_s(schedule) / schedule.reading_s + 1e-9)) + 1;
  for (std::size_t i = 0; i < rows; ++i) {
    drives.time_s.push_back(static_cast<double>(i) * schedule.reading_s);
    const double rpm = dwell_at(schedule, drives.time_s.back()).speed_rpm;
    if (has_speed_) drives.speed.push_back(i == 0 && !schedule.starts_warm ? 0.0 : rpm);
  }
  const double from_s = time_s_.back() * 2.0 * simulation::uniform(random);
  Series result;
  result.time_s = drives.time_s;
  result.five_probe = data_.five_probe;
  result.has_clock = data_.has_clock;
  const auto write = [&](std::size_t k, std::vector<double> values) {
    const double step = columns_[k].resolution;
    if (step > 0.0) {
      for (double& value : values) value = step * std::round(value / step);
    }
    result.columns.push_back({data_.columns[k].name, data_.columns[k].role, std::move(values)});
  };
  const auto with_steps = [&](std::vector<double> values, double Dwell::*step) {
    for (std::size_t i = 0; i < values.size(); ++i) values[i] += dwell_at(schedule, drives.time_s[i]).*step;
    return values;
  };
  // In the order in which they follow one another: room, coolant, the rest.
  std::vector<std::vector<double>> value(data_.columns.size());
  const auto mean_of_planned = [&](Role role) {
    std::vector<double> sum(rows, 0.0);
    double count = 0.0;
    for (std::size_t k = 0; k < value.size(); ++k) {
      if (data_.columns[k].role != role || data_.columns[k].name == target_) continue;
      for (std::size_t i = 0; i < rows; ++i) sum[i] += value[k][i];
      count += 1.0;
    }
    for (double& one : sum) one /= std::max(1.0, count);
    return sum;
  };
  for (std::size_t k = 0; k < value.size(); ++k) {
    if (data_.columns[k].role == Role::ambient)
      value[k] = with_steps(wandered(k, drives.time_s, from_s), &Dwell::room_K);
  }
  if (has_room_) drives.room = mean_of_planned(Role::ambient);
  const auto follow = [&](std::size_t k) {
    value[k] = wandered(k, drives.time_s, from_s);
    if (forecasts_[k].r2 < kBelieved) return;
    const std::vector<double> expected = predicted(forecasts_[k], drives);
    for (std::size_t i = 0; i < rows; ++i) value[k][i] += expected[i];
  };
  for (std::size_t k = 0; k < value.size(); ++k) {
    if (data_.columns[k].role != Role::coolant) continue;
    follow(k);
    value[k] = with_steps(std::move(value[k]), &Dwell::coolant_K);
  }
  if (has_coolant_) drives.coolant = mean_of_planned(Role::coolant);
  for (std::size_t k = 0; k < value.size(); ++k) {
    const Column& column = data_.columns[k];
    if (column.name == target_) continue;
    if (column.role == Role::speed) {
      value[k] = has_speed_ ? drives.speed : std::vector<double>(rows, 0.0);
    } else if (column.role == Role::load) {
      value[k] = loaded(k, schedule, drives);
    } else if (column.role == Role::event) {
      value[k].assign(rows, columns_[k].mean);
    } else if (column.role != Role::ambient && column.role != Role::coolant) {
      follow(k);
    }
  }
  for (std::size_t k = 0; k < value.size(); ++k) {
    if (data_.columns[k].name != target_) write(k, std::move(value[k]));
  }
  return result;
}

}  // namespace ballbar
