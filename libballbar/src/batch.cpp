#include "ballbar/batch.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>

#include "ballbar/error.hpp"
#include "ballbar/nearest_name.hpp"

namespace ballbar {
namespace {

constexpr double kFarOffset = 8.0;  // times the robust spread of the sensors' offsets
constexpr double kLeastOffset_K = 5.0;
constexpr double kFarStep = 10.0;   // times the robust spread of the changes from row to row
constexpr double kLargeStep = 0.3;  // of the batch's range
constexpr double kRobust = 1.4826;  // a normal distribution's sigma over its median absolute deviation
constexpr std::size_t kStepsTold = 5;

bool says_room(const std::string& name) {
  std::string lower = name;
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  constexpr std::array kWords{"room", "ambient", "air"};
  return std::any_of(kWords.begin(), kWords.end(),
                     [&](const char* word) { return lower.find(word) != std::string::npos; });
}

const Column& column_of(const Series& series, const std::string& name) {
  const Column* column = find_column(series, name);
  if (column != nullptr) return *column;
  std::vector<std::string_view> known;
  for (const Column& one : series.columns) known.emplace_back(one.name);
  throw Error(fmt::format("expected a column {}, found none{}.", name,
                          known.empty() ? "" : fmt::format("; the nearest is {}", nearest_name(name, known))));
}

const std::vector<double>& without_gaps(const Series& series, const std::string& name) {
  const std::vector<double>& values = column_of(series, name).values;
  const auto gap = std::find_if(values.begin(), values.end(), [](double value) { return !std::isfinite(value); });
  if (gap == values.end()) return values;
  throw Error(fmt::format("expected a value in every row of {}, found a gap at {:g} s.", name,
                          series.time_s[static_cast<std::size_t>(gap - values.begin())]));
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::string room_of(const Series& first, const std::vector<std::string>& sensors) {
  std::vector<std::string> rooms, by_name;
  for (const std::string& name : sensors) {
    if (find_column(first, name)->role == Role::ambient) rooms.push_back(name);
    if (says_room(name)) by_name.push_back(name);
  }
  if (rooms.empty()) rooms = std::move(by_name);
  if (rooms.size() == 1) return rooms.front();
  throw Error(
      fmt::format("expected one column of the room's temperature (role ambient, or room, ambient or air in its name), "
                  "found {}; name it by --room, one of {}.",
                  rooms.empty() ? "none" : fmt::format("{}", fmt::join(rooms, " and ")), fmt::join(sensors, ", ")));
}

// Each sensor's mean, less that of the median sensor.
Eigen::VectorXd offsets(const Eigen::MatrixXd& temperatures) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(temperatures.cols());
  std::vector<double> row(static_cast<std::size_t>(temperatures.cols()));
  for (Eigen::Index i = 0; i < temperatures.rows(); ++i) {
    Eigen::VectorXd::Map(row.data(), temperatures.cols()) = temperatures.row(i).transpose();
    sum += (temperatures.row(i).array() - median(row)).matrix().transpose();
  }
  return sum / static_cast<double>(temperatures.rows());
}

std::vector<std::pair<double, double>> steps_of(const Series& series, const std::vector<double>& target) {
  std::vector<double> change, size;
  for (std::size_t i = 1; i < target.size(); ++i) change.push_back(target[i] - target[i - 1]);
  const double usual = median(change);
  size.reserve(change.size());
  for (const double one : change) size.push_back(std::abs(one - usual));
  const auto [low, high] = std::minmax_element(target.begin(), target.end());
  const double least = std::max(kFarStep * kRobust * median(size), kLargeStep * (*high - *low));
  std::vector<std::pair<double, double>> steps;
  for (std::size_t i = 0; i < change.size() && steps.size() < kStepsTold; ++i) {
    if (size[i] > least) steps.emplace_back(series.time_s[i + 1], change[i]);
  }
  return steps;
}

Eigen::MatrixXd temperatures_of(const Series& series, const BatchColumns& columns) {
  Eigen::MatrixXd result(static_cast<Eigen::Index>(series.time_s.size()),
                         static_cast<Eigen::Index>(columns.sensors.size()));
  for (std::size_t j = 0; j < columns.sensors.size(); ++j) {
    const std::vector<double>& values = without_gaps(series, columns.sensors[j]);
    result.col(static_cast<Eigen::Index>(j)) = Eigen::VectorXd::Map(values.data(), result.rows());
  }
  return result;
}

Eigen::MatrixXd inputs_from(const Eigen::MatrixXd& temperatures, InputKind kind) {
  if (kind == InputKind::temperature) return temperatures;
  const Eigen::MatrixXd rises = temperatures.rowwise() - temperatures.row(0).eval();
  if (kind == InputKind::rise) return rises;
  Eigen::MatrixXd both(temperatures.rows(), 2 * temperatures.cols());
  both << temperatures, rises;
  return both;
}

BatchStart start_from(const Series& series, const BatchColumns& columns, const Eigen::MatrixXd& temperatures) {
  BatchStart start;
  const std::vector<double>& room = without_gaps(series, columns.room);
  start.room_first_degC = room.front();
  start.room_mean_degC = Eigen::VectorXd::Map(room.data(), static_cast<Eigen::Index>(room.size())).mean();
  start.sensors_mean_degC = temperatures.row(0).mean();
  start.sensors_spread_K = std::sqrt((temperatures.row(0).array() - start.sensors_mean_degC).square().mean());
  start.speed_mean_rpm = std::numeric_limits<double>::quiet_NaN();
  if (columns.speed) {
    const std::vector<double>& speed = without_gaps(series, *columns.speed);
    start.speed_mean_rpm = Eigen::VectorXd::Map(speed.data(), static_cast<Eigen::Index>(speed.size())).mean();
  }
  return start;
}

// Places of what stays of a list when `left_out` goes; of inputs in kind `both` each twice.
std::vector<Eigen::Index> kept_inputs(const BatchColumns& columns, const std::vector<std::string>& left_out) {
  std::vector<Eigen::Index> kept;
  const std::size_t times = columns.kind == InputKind::both ? 2 : 1;
  for (std::size_t t = 0; t < times; ++t) {
    for (std::size_t j = 0; j < columns.sensors.size(); ++j) {
      if (std::find(left_out.begin(), left_out.end(), columns.sensors[j]) != left_out.end()) continue;
      kept.push_back(static_cast<Eigen::Index>(t * columns.sensors.size() + j));
    }
  }
  return kept;
}

}  // namespace

std::string_view name_of(InputKind kind) {
  constexpr std::array<std::string_view, 3> kNames{"temperature", "rise", "both"};
  return kNames.at(static_cast<std::size_t>(kind));
}

bool is_sensor(const Column& column) {
  const std::string_view unit = unit_of(column.name);
  return column.role != Role::measured && (unit == "degC" || unit == "K");
}

BatchColumns batch_columns(const Series& first, InputKind kind, const std::string& target,
                           const std::optional<std::string>& room) {
  BatchColumns columns;
  columns.kind = kind;
  columns.target = target;
  std::vector<std::string> speeds;
  for (const Column& column : first.columns) {
    if (is_sensor(column)) columns.sensors.push_back(column.name);
    if (column.role == Role::speed) speeds.push_back(column.name);
  }
  if (speeds.size() == 1) columns.speed = speeds.front();
  column_of(first, target);
  if (unit_of(target) != "um") {
    throw Error(fmt::format("expected a target in um, found {}.", target));
  }
  if (columns.sensors.empty()) throw Error("expected columns of temperatures (_degC or _K), found none.");
  if (room) column_of(first, *room);
  columns.room = room ? *room : room_of(first, columns.sensors);
  return columns;
}

Eigen::MatrixXd inputs_of(const Series& series, const BatchColumns& columns) {
  return inputs_from(temperatures_of(series, columns), columns.kind);
}

std::vector<std::string> input_names(const BatchColumns& columns) {
  std::vector<std::string> names;
  if (columns.kind != InputKind::rise) names = columns.sensors;
  if (columns.kind == InputKind::temperature) return names;
  for (const std::string& sensor : columns.sensors) names.push_back(sensor + " rise");
  return names;
}

BatchStart start_of(const Series& series, const BatchColumns& columns) {
  return start_from(series, columns, temperatures_of(series, columns));
}

Moments merged(const Moments& a, const Moments& b) {
  if (a.weight == 0.0) return b;
  if (b.weight == 0.0) return a;
  Moments both;
  both.weight = a.weight + b.weight;
  const Eigen::VectorXd apart = b.mean - a.mean;
  both.mean = a.mean + b.weight / both.weight * apart;
  both.scatter = a.scatter + b.scatter + a.weight * b.weight / both.weight * apart * apart.transpose();
  return both;
}

Batch batch_of(const std::string& name, const Series& series, const BatchColumns& columns) {
  constexpr std::size_t kFewest = 3;
  Batch batch;
  batch.name = name;
  batch.rows = series.time_s.size();
  if (batch.rows < kFewest) {
    throw Error(fmt::format("expected a batch of at least {} rows, found {}.", kFewest, batch.rows));
  }
  const std::vector<double>& target = without_gaps(series, columns.target);
  const Eigen::MatrixXd temperatures = temperatures_of(series, columns);
  batch.start = start_from(series, columns, temperatures);
  batch.sensor_offset_K = offsets(temperatures);
  batch.step_um = steps_of(series, target);
  Eigen::MatrixXd rows(temperatures.rows(), 0);
  const Eigen::MatrixXd inputs = inputs_from(temperatures, columns.kind);
  rows.resize(inputs.rows(), inputs.cols() + 1);
  rows << inputs, Eigen::VectorXd::Map(target.data(), inputs.rows());
  batch.moments.weight = static_cast<double>(batch.rows);
  batch.moments.mean = rows.colwise().mean();
  rows.rowwise() -= batch.moments.mean.transpose();
  batch.moments.scatter = rows.transpose() * rows;
  return batch;
}

Moments merged(std::span<const Batch> batches, std::span<const double> weights) {
  Moments all;
  for (std::size_t k = 0; k < batches.size(); ++k) {
    Moments one = batches[k].moments;
    if (!weights.empty()) {
      one.weight *= weights[k];
      one.scatter *= weights[k];
    }
    all = merged(all, one);
  }
  return all;
}

std::vector<BrokenSensor> broken_sensors(std::span<const Batch> batches, const BatchColumns& columns) {
  std::vector<double> away;  // of every sensor in every batch
  std::vector<double> usual;
  for (std::size_t j = 0; j < columns.sensors.size(); ++j) {
    std::vector<double> offset;
    for (const Batch& batch : batches) offset.push_back(batch.sensor_offset_K[static_cast<Eigen::Index>(j)]);
    usual.push_back(median(offset));
    for (const double one : offset) away.push_back(std::abs(one - usual.back()));
  }
  if (away.empty()) return {};
  const double far_K = std::max(kLeastOffset_K, kFarOffset * kRobust * median(away));
  std::vector<BrokenSensor> broken;
  for (std::size_t j = 0; j < columns.sensors.size(); ++j) {
    BrokenSensor one{columns.sensors[j], {}, 0.0};
    std::vector<double> off;
    for (const Batch& batch : batches) {
      const double apart = batch.sensor_offset_K[static_cast<Eigen::Index>(j)] - usual[j];
      if (std::abs(apart) <= far_K) continue;
      one.batches.push_back(batch.name);
      off.push_back(apart);
    }
    if (off.empty()) continue;
    one.off_K = median(off);
    broken.push_back(std::move(one));
  }
  return broken;
}

std::vector<std::string> constant_sensors(std::span<const Batch> batches, const BatchColumns& columns) {
  std::vector<std::string> constant;
  for (std::size_t j = 0; j < columns.sensors.size(); ++j) {
    const auto at = static_cast<Eigen::Index>(j);
    const auto stands = [&](const Batch& batch) {
      return batch.moments.scatter(at, at) == 0.0 && batch.moments.mean[at] == batches.front().moments.mean[at];
    };
    if (std::all_of(batches.begin(), batches.end(), stands)) constant.push_back(columns.sensors[j]);
  }
  return constant;
}

FewerSensors without_sensors(std::vector<Batch> batches, const BatchColumns& columns,
                             const std::vector<std::string>& sensors) {
  if (sensors.empty()) return {columns, std::move(batches)};
  std::vector<Eigen::Index> kept = kept_inputs(columns, sensors);
  BatchColumns one_each = columns;
  one_each.kind = InputKind::temperature;
  const std::vector<Eigen::Index> kept_sensors = kept_inputs(one_each, sensors);
  FewerSensors result{columns, std::move(batches)};
  std::erase_if(result.columns.sensors, [&](const std::string& name) {
    return std::find(sensors.begin(), sensors.end(), name) != sensors.end();
  });
  if (result.columns.sensors.empty()) throw Error("expected sensors to be left, found none.");
  for (Batch& batch : result.batches) {
    std::vector<Eigen::Index> places = kept;
    places.push_back(batch.moments.mean.size() - 1);
    batch.moments.mean = batch.moments.mean(places).eval();
    batch.moments.scatter = batch.moments.scatter(places, places).eval();
    batch.sensor_offset_K = batch.sensor_offset_K(kept_sensors).eval();
  }
  return result;
}

}  // namespace ballbar
