#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include "ballbar/error.hpp"
#include "ballbar/internal/nearest_name.hpp"
#include "ballbar/internal/numerics/order_statistic.hpp"
#include "ballbar/predict/train.hpp"
#include "numerics/median.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kFewestBatches = 8, kFewestSensors = 6;  // to tell a broken one
constexpr double kFarOffset = 8.0;                             // times the robust spread of what is unlike the others
constexpr double kLeastOffset_K = 5.0;
constexpr double kFarStep = 10.0;  // times the robust spread of the changes from row to row
constexpr double kLeastStep_um = 1.0;
constexpr double kUsualSteps = 3.0;  // between two rows
constexpr double kLargest = 1e6;     // degC or um: beyond it no machine is
constexpr double kLargeStep = 0.3;   // of the batch's range
constexpr std::size_t kStepsListed = 5;
constexpr double kLastBits = 1e-12;

bool says_room(const std::string& name) {
  std::string lower = name;
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  constexpr std::array kWords{"room", "ambient", "air"};
  return std::any_of(kWords.begin(), kWords.end(),
                     [&](const char* word) { return lower.find(word) != std::string::npos; });
}

const std::vector<double>& without_gaps(const Series& series, const std::string& name) {
  const std::vector<double>& values = column_of(series, name).values;
  const auto gap =
      std::find_if(values.begin(), values.end(), [](double value) { return !(std::abs(value) <= kLargest); });
  if (gap == values.end()) return values;
  const double time_s = series.time_s[static_cast<std::size_t>(gap - values.begin())];
  if (std::isfinite(*gap)) {
    throw Error(fmt::format("expected values below 1e6 in {}, found {} at {} s.", name, *gap, time_s));
  }
  throw Error(fmt::format("expected a value in every row of {}, found a gap at {} s.", name, time_s));
}

std::string room_of(const Series& first, const std::vector<std::string>& sensors) {
  std::vector<std::string> rooms, by_name;
  for (const std::string& name : sensors) {
    if (find_column(first, name)->role == Role::ambient) rooms.push_back(name);
    if (says_room(name)) by_name.push_back(name);
  }
  if (rooms.empty()) rooms = std::move(by_name);
  if (rooms.size() == 1) return rooms.front();
  return {};
}

// Residuals of y by the columns of a (n by p), though nearly half of y may be wrong: of many fits through p rows the
// one with the least median of absolute residuals (Rousseeuw 1984), then least squares by the rows that are near it.
Eigen::VectorXd robust_residual(const Eigen::MatrixXd& a, const Eigen::VectorXd& y) {
  constexpr int kFits = 500;
  constexpr double kNear = 3.0;  // robust standard deviations
  const Eigen::Index n = a.rows(), p = a.cols();
  std::mt19937_64 random(1);
  std::vector<Eigen::Index> rows(static_cast<std::size_t>(n));
  std::iota(rows.begin(), rows.end(), Eigen::Index{0});
  Eigen::VectorXd best;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kFits; ++i) {
    for (std::size_t k = 0; k < static_cast<std::size_t>(p); ++k) {
      std::swap(rows[k], rows[k + random() % (rows.size() - k)]);
    }
    const std::vector<Eigen::Index> few(rows.begin(), rows.begin() + p);
    const Eigen::VectorXd residual = y - a * a(few, Eigen::all).colPivHouseholderQr().solve(Eigen::VectorXd(y(few)));
    const Eigen::VectorXd away = residual.cwiseAbs();
    const double middle = median<double>({away.begin(), away.end()});
    if (!(middle < least)) continue;
    least = middle;
    best = residual;
  }
  if (best.size() == 0) return Eigen::VectorXd::Zero(n);  // numbers too large to be told apart
  std::vector<Eigen::Index> near;
  for (Eigen::Index k = 0; k < n; ++k) {
    if (std::abs(best[k]) <= kNear * kSigmaOfDeviation * least) near.push_back(k);
  }
  return y - a * a(near, Eigen::all).colPivHouseholderQr().solve(Eigen::VectorXd(y(near)));
}

// Mean of each sensor in each batch (rows) beyond what the batch and its heat suggest.
struct SensorOffsets {
  Eigen::MatrixXd off_K;
  Eigen::VectorXd heat_K;  // of each batch: how far its sensors are apart
};
SensorOffsets sensor_offsets(const Eigen::MatrixXd& means_degC) {
  Eigen::MatrixXd offset(means_degC.rows(), means_degC.cols());
  Eigen::MatrixXd a = Eigen::MatrixXd::Ones(means_degC.rows(), 2);  // and the heat
  for (Eigen::Index k = 0; k < means_degC.rows(); ++k) {
    const Eigen::VectorXd row = means_degC.row(k).transpose();
    offset.row(k) = (row.array() - median<double>({row.begin(), row.end()})).matrix().transpose();
    const Eigen::VectorXd apart = offset.row(k).transpose().cwiseAbs();
    a(k, 1) = median<double>({apart.begin(), apart.end()});
  }
  for (Eigen::Index j = 0; j < offset.cols(); ++j) offset.col(j) = robust_residual(a, offset.col(j)).eval();
  return {std::move(offset), a.col(1)};
}

std::vector<TargetStep> steps_of(const Series& series, const std::vector<double>& target) {
  std::vector<double> change, size;
  for (std::size_t i = 1; i < target.size(); ++i) change.push_back(target[i] - target[i - 1]);
  const double usual = median(change);
  for (const double one : change) size.push_back(std::abs(one - usual));
  const auto [low, high] = std::minmax_element(target.begin(), target.end());
  const double least =
      std::max({kFarStep * kSigmaOfDeviation * median(size), kLargeStep * (*high - *low), kLeastStep_um});
  const double longest_s = kUsualSteps * median_step_s(series.time_s);
  std::vector<TargetStep> steps;
  for (std::size_t i = 0; i < change.size() && steps.size() < kStepsListed; ++i) {
    if (size[i] > least && series.time_s[i + 1] - series.time_s[i] <= longest_s) {
      steps.push_back({series.time_s[i + 1], change[i]});
    }
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

// Mean and spread of the sensors as a test begins.
BatchStart with_sensors(BatchStart start, const Eigen::VectorXd& first_degC) {
  start.sensors_mean_degC = first_degC.mean();
  start.sensors_spread_K = std::sqrt((first_degC.array() - start.sensors_mean_degC).square().mean());
  return start;
}

BatchStart start_of(const Series& series, const BatchColumns& columns, const Eigen::MatrixXd& temperatures) {
  BatchStart start;
  start.room_first_degC = start.room_mean_degC = start.speed_mean_rpm = std::numeric_limits<double>::quiet_NaN();
  if (!columns.room.empty()) {
    const std::vector<double>& room = without_gaps(series, columns.room);
    start.room_first_degC = room.front();
    start.room_mean_degC = Eigen::VectorXd::Map(room.data(), static_cast<Eigen::Index>(room.size())).mean();
  }
  if (columns.speed && find_column(series, *columns.speed) != nullptr) {
    const std::vector<double>& speed = without_gaps(series, *columns.speed);
    start.speed_mean_rpm = Eigen::VectorXd::Map(speed.data(), static_cast<Eigen::Index>(speed.size())).mean();
  }
  return with_sensors(start, temperatures.row(0).transpose());
}

}  // namespace

std::string_view name_of(InputKind kind) {
  constexpr std::array<std::string_view, 3> kNames{"temperature", "rise", "both"};
  return kNames.at(static_cast<std::size_t>(kind));
}

const Column& column_of(const Series& series, const std::string& name) {
  const Column* column = find_column(series, name);
  if (column != nullptr) return *column;
  std::vector<std::string_view> known;
  for (const Column& one : series.columns) known.emplace_back(one.name);
  throw Error(fmt::format("expected a column {}, found none{}.", name,
                          known.empty() ? "" : fmt::format("; the nearest is {}", nearest_name(name, known))));
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
    if (is_sensor(column) && column.name != target) columns.sensors.push_back(column.name);
    if (column.role == Role::speed) speeds.push_back(column.name);
  }
  if (speeds.size() == 1) columns.speed = speeds.front();
  column_of(first, target);
  if (columns.sensors.empty()) throw Error("expected columns of temperatures (_degC or _K), found none.");
  if (room && !is_sensor(column_of(first, *room))) {
    throw Error(fmt::format("expected a temperature of the room, found {}.", *room));
  }
  columns.room = room ? *room : room_of(first, columns.sensors);
  return columns;
}

void expect_room(const BatchColumns& columns) {
  if (!columns.room.empty()) return;
  throw Error(fmt::format(
      "expected one column of the room's temperature (role ambient, or room, ambient or air in its name), by "
      "which batches are ranked, found none or several; name it by --room, one of {}.",
      fmt::join(columns.sensors, ", ")));
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
  constexpr std::size_t kShortestBatch = 3;
  Batch batch;
  batch.name = name;
  batch.rows = series.time_s.size();
  if (batch.rows < kShortestBatch) {
    throw Error(fmt::format("expected a batch of at least {} rows, found {}.", kShortestBatch, batch.rows));
  }
  const std::vector<double>& target = without_gaps(series, columns.target);
  const Eigen::MatrixXd temperatures = temperatures_of(series, columns);
  batch.start = start_of(series, columns, temperatures);
  batch.sensor_first_degC = temperatures.row(0).transpose();
  batch.sensor_mean_degC = temperatures.colwise().mean().transpose();
  batch.steps = steps_of(series, target);
  const Eigen::MatrixXd inputs = inputs_from(temperatures, columns.kind);
  Eigen::MatrixXd rows(inputs.rows(), inputs.cols() + 1);
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
  const auto count = static_cast<Eigen::Index>(batches.size());
  Eigen::MatrixXd means(count, static_cast<Eigen::Index>(columns.sensors.size()));
  for (Eigen::Index k = 0; k < count; ++k) {
    means.row(k) = batches[static_cast<std::size_t>(k)].sensor_mean_degC.transpose();
  }
  std::vector<Eigen::Index> sensors(columns.sensors.size());
  std::iota(sensors.begin(), sensors.end(), Eigen::Index{0});
  std::vector<BrokenSensor> broken;
  // The worst alone: it moves what the others are compared with.
  while (batches.size() >= kFewestBatches && sensors.size() >= kFewestSensors) {
    const auto [off, heat] = sensor_offsets(means(Eigen::all, sensors));
    const Eigen::VectorXd away = off.reshaped().cwiseAbs();
    const double far_K =
        std::max(kLeastOffset_K, kFarOffset * kSigmaOfDeviation * median<double>({away.begin(), away.end()}));
    const double usual_heat_K = median<double>({heat.begin(), heat.end()});
    const Eigen::ArrayXd limit_K =
        far_K * heat.unaryExpr([&](double one) { return std::max(1.0, one / usual_heat_K); }).array();
    Eigen::Index batch = 0, worst = 0;
    if (!((off.cwiseAbs().array().colwise() / limit_K).maxCoeff(&batch, &worst) > 1.0)) break;
    BrokenSensor one{columns.sensors[static_cast<std::size_t>(sensors[static_cast<std::size_t>(worst)])], {}, 0.0};
    std::vector<double> by;
    for (Eigen::Index k = 0; k < count; ++k) {
      if (!(std::abs(off(k, worst)) > limit_K[k])) continue;
      one.batches.push_back(batches[static_cast<std::size_t>(k)].name);
      by.push_back(off(k, worst));
    }
    one.off_K = median(by);
    broken.push_back(std::move(one));
    sensors.erase(sensors.begin() + worst);
  }
  return broken;
}

std::vector<std::string> constant_sensors(std::span<const Batch> batches, const BatchColumns& columns) {
  std::vector<std::string> constant;
  for (std::size_t j = 0; j < columns.sensors.size(); ++j) {
    const auto at = static_cast<Eigen::Index>(j);
    const auto stands = [&](const Batch& batch) {
      const double size = std::abs(batch.sensor_mean_degC[at]);  // whose last bits are rounding
      return batch.moments.scatter(at, at) <= batch.moments.weight * std::pow(kLastBits * size, 2) &&
             std::abs(batch.sensor_mean_degC[at] - batches.front().sensor_mean_degC[at]) <= kLastBits * size;
    };
    if (std::all_of(batches.begin(), batches.end(), stands)) constant.push_back(columns.sensors[j]);
  }
  return constant;
}

void leave_out_sensors(std::vector<Batch>& batches, BatchColumns& columns, const std::vector<std::string>& sensors) {
  if (sensors.empty()) return;
  const auto count = static_cast<Eigen::Index>(columns.sensors.size());
  const auto is_out = [&](const std::string& name) {
    return std::find(sensors.begin(), sensors.end(), name) != sensors.end();
  };
  std::vector<Eigen::Index> kept;
  for (Eigen::Index j = 0; j < count; ++j) {
    if (!is_out(columns.sensors[static_cast<std::size_t>(j)])) kept.push_back(j);
  }
  std::vector<Eigen::Index> places = kept;  // of the inputs: then the rises, then the target
  if (columns.kind == InputKind::both) {
    for (const Eigen::Index j : kept) places.push_back(count + j);
  }
  places.push_back(columns.kind == InputKind::both ? 2 * count : count);
  if (kept.empty()) throw Error("expected sensors that are sound and not constant, found none.");
  std::erase_if(columns.sensors, is_out);
  for (Batch& batch : batches) {
    batch.moments.mean = batch.moments.mean(places).eval();
    batch.moments.scatter = batch.moments.scatter(places, places).eval();
    batch.sensor_first_degC = batch.sensor_first_degC(kept).eval();
    batch.sensor_mean_degC = batch.sensor_mean_degC(kept).eval();
    batch.start = with_sensors(batch.start, batch.sensor_first_degC);
  }
}

}  // namespace ballbar
