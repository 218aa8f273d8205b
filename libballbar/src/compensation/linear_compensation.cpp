#include <fmt/format.h>

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "ballbar/compensation/compensation.hpp"
#include "ballbar/error.hpp"
#include "ballbar/fit/fit.hpp"
#include "ballbar/internal/fit/held_model.hpp"
#include "ballbar/internal/nearest_name.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kFifths = 5, kFirstTestedFifth = 3;
constexpr double kIndependent = 1e-6;  // share of a sensor's square that the others of its set do not draw

// A record relative to the zeros of its runs.
struct LineData {
  std::vector<std::size_t> row, zero;  // of the series: each row, and the zero of its run
  std::vector<std::size_t> part;       // each row: run, or fifth of the only one
  std::size_t parts = 0, runs = 0;
  std::vector<double> predicted_um, measured_um;  // of the series
  std::vector<const Column*> sensors;
};

// Sums over rows that least squares needs: A = sum dT dT', b = sum dT dp, c = sum dp^2.
struct Sums {
  explicit Sums(Eigen::Index m) : A(Eigen::MatrixXd::Zero(m, m)), b(Eigen::VectorXd::Zero(m)) {}
  Eigen::MatrixXd A;
  Eigen::VectorXd b;
  double c = 0.0;

  void add(const Sums& other, double sign = 1.0) {
    A += sign * other.A;
    b += sign * other.b;
    c += sign * other.c;
  }
};

struct ChosenLine {
  std::vector<Eigen::Index> sensors;  // none: no set whose sensors move independently
  Eigen::VectorXd slope_um_per_K;
};

// Nothing where the sensors do not move, or not independently.
std::optional<Eigen::VectorXd> slopes(const Sums& sums, const std::vector<Eigen::Index>& set) {
  const Eigen::MatrixXd A = sums.A(set, set);
  const Eigen::VectorXd scale = A.diagonal().cwiseSqrt();
  if (!(scale.minCoeff() > 0.0)) return std::nullopt;
  const Eigen::FullPivLU<Eigen::MatrixXd> scaled(scale.cwiseInverse().asDiagonal() * A *
                                                 scale.cwiseInverse().asDiagonal());
  if (std::abs(scaled.determinant()) < kIndependent) return std::nullopt;
  const Eigen::VectorXd b = scale.cwiseInverse().asDiagonal() * sums.b(set);
  return scale.cwiseInverse().asDiagonal() * Eigen::VectorXd(scaled.solve(b));
}

ChosenLine best_line(const Sums& sums, std::size_t count) {
  ChosenLine best;
  double least = std::numeric_limits<double>::infinity();
  std::vector<Eigen::Index> set;
  const auto extend = [&](const auto& self, Eigen::Index from) -> void {
    if (set.size() == count) {
      const std::optional<Eigen::VectorXd> slope = slopes(sums, set);
      if (!slope) return;
      const double left = sums.c - slope->dot(sums.b(set));
      if (left < least) {
        least = left;
        best = {set, *slope};
      }
      return;
    }
    for (Eigen::Index s = from; s < sums.b.size(); ++s) {
      set.push_back(s);
      self(self, s + 1);
      set.pop_back();
    }
  };
  extend(extend, 0);
  return best;
}

const Column& column_in(const Series& data, const std::string& name) {
  if (const Column* column = find_column(data, name)) return *column;
  std::vector<std::string_view> known;
  for (const Column& column : data.columns) known.push_back(column.name);
  throw Error(fmt::format("expected the column {}, found none; the nearest is {}.", name, nearest_name(name, known)));
}

LineData line_data(const Model& model, const Series& data, std::span<const std::string> candidates) {
  if (model.targets.size() != 1) {
    throw Error(fmt::format("expected a model of one target, found {}: each axis has a line of its own.",
                            model.targets.size()));
  }
  const std::string& target = model.targets.front();
  if (unit_of(target) != "um") {
    throw Error(fmt::format("expected a target in um, which moves an axis, found {}.", target));
  }
  LineData all;
  all.measured_um = column_in(data, target).values;
  for (const std::string& name : candidates) all.sensors.push_back(&column_in(data, name));
  std::size_t most = 0;
  const std::vector<RowRange> ranges = runs_of(data.time_s);
  for (const RowRange& range : ranges) {
    const std::vector<double> predicted_um =
        predict(model, held_parameters(model), ranges.size() == 1 ? data : rows_of(data, range)).predicted_um;
    all.predicted_um.insert(all.predicted_um.end(), predicted_um.begin(), predicted_um.end());
    std::size_t zero = range.end, values = 0;
    for (std::size_t row = range.begin; row < range.end; ++row) {
      if (!std::isfinite(all.measured_um[row])) continue;
      zero = std::min(zero, row);
      ++values;
    }
    most = std::max(most, values);
    if (values < 2) continue;
    for (std::size_t row = zero; row < range.end; ++row) {
      all.row.push_back(row);
      all.zero.push_back(zero);
      all.part.push_back(all.runs);
    }
    ++all.runs;
  }
  if (all.runs == 0) throw Error(fmt::format("expected at least two values of {} in a run, found {}.", target, most));
  for (const Column* sensor : all.sensors) {
    for (const std::size_t row : all.row) {
      if (std::isfinite(sensor->values[row])) continue;
      throw Error(
          fmt::format("expected a value of {} at every time, found a gap at {:g} s.", sensor->name, data.time_s[row]));
    }
  }
  all.parts = all.runs;
  if (all.runs == 1) {
    all.parts = kFifths;
    const double begin_s = data.time_s[all.row.front()], span_s = data.time_s[all.row.back()] - begin_s;
    for (std::size_t i = 0; i < all.row.size(); ++i) {
      const double place = (data.time_s[all.row[i]] - begin_s) / span_s;
      all.part[i] = std::min(kFifths - 1, static_cast<std::size_t>(place * kFifths));
    }
  }
  return all;
}

std::vector<Sums> sums_of(const LineData& all) {
  const auto m = static_cast<Eigen::Index>(all.sensors.size());
  std::vector<Sums> sums(all.parts, Sums(m));
  Eigen::VectorXd rise(m);
  for (std::size_t i = 0; i < all.row.size(); ++i) {
    const std::size_t row = all.row[i], zero = all.zero[i];
    for (Eigen::Index s = 0; s < m; ++s) {
      const std::vector<double>& values = all.sensors[static_cast<std::size_t>(s)]->values;
      rise(s) = values[row] - values[zero];
    }
    const double predicted_um = all.predicted_um[row] - all.predicted_um[zero];
    Sums& part = sums[all.part[i]];
    part.A += rise * rise.transpose();
    part.b += predicted_um * rise;
    part.c += predicted_um * predicted_um;
  }
  return sums;
}

double rounded(double value, double per_unit) { return std::round(value * per_unit) / per_unit; }

// As it is written, of the rows of some parts.
template <class Uses>
LinearCompensation written(const LineData& all, const ChosenLine& chosen, double range_margin,
                           const Increment& increment, Uses uses) {
  LinearCompensation line{{}, increment};
  for (std::size_t k = 0; k < chosen.sensors.size(); ++k) {
    const Column& sensor = *all.sensors[static_cast<std::size_t>(chosen.sensors[k])];
    double low = std::numeric_limits<double>::infinity(), high = -low, zeros = 0.0, count = 0.0;
    for (std::size_t i = 0; i < all.row.size(); ++i) {
      if (!uses(all.part[i])) continue;
      const double value = sensor.values[all.row[i]];
      low = std::min(low, value);
      high = std::max(high, value);
      if (all.row[i] != all.zero[i]) continue;
      zeros += value;
      ++count;
    }
    const double margin = range_margin * (high - low);
    line.sensors.push_back({sensor.name, rounded(chosen.slope_um_per_K(static_cast<Eigen::Index>(k)), 1e4), 0.0,
                            rounded(zeros / count, 10.0), std::floor(10.0 * (low - margin)) / 10.0,
                            std::ceil(10.0 * (high + margin)) / 10.0});
  }
  return line;
}

struct LineResiduals {
  std::vector<double> before_um, model_um, line_um;
  std::size_t beyond = 0;
};

// Of the values of one part, without those at zeros; appended.
void append_left(LineResiduals& left, const LineData& all, const LinearCompensation& line,
                 const std::vector<Eigen::Index>& sensors, std::size_t part) {
  std::vector<double> readings(sensors.size());
  const auto at = [&](std::size_t row) {
    for (std::size_t k = 0; k < sensors.size(); ++k) {
      readings[k] = all.sensors[static_cast<std::size_t>(sensors[k])]->values[row];
    }
    return error_um(line, readings);
  };
  for (std::size_t i = 0; i < all.row.size(); ++i) {
    const std::size_t row = all.row[i], zero = all.zero[i];
    if (all.part[i] != part || row == zero || !std::isfinite(all.measured_um[row])) continue;
    const double before_um = all.measured_um[row] - all.measured_um[zero];
    left.before_um.push_back(before_um);
    left.model_um.push_back(before_um - (all.predicted_um[row] - all.predicted_um[zero]));
    left.line_um.push_back(before_um - (at(row) - at(zero)));
    bool beyond = false;
    for (std::size_t k = 0; k < sensors.size(); ++k) {
      const double reading = all.sensors[static_cast<std::size_t>(sensors[k])]->values[row];
      beyond |= reading < line.sensors[k].low || reading > line.sensors[k].high;
    }
    left.beyond += beyond ? 1 : 0;
  }
}

double largest(const std::vector<double>& values) {
  double most = 0.0;
  for (const double value : values) most = std::max(most, std::abs(value));
  return most;
}

LineErrors errors_of(const LineResiduals& left) {
  constexpr ErrorSize kSize = ErrorSize::root_mean_square;
  return {reduction_of(left.before_um, left.model_um, kSize),
          reduction_of(left.before_um, left.line_um, kSize),
          largest(left.before_um),
          largest(left.model_um),
          largest(left.line_um),
          left.before_um.size(),
          left.beyond};
}

// Each run from the others, or each late fifth from the time before it.
std::optional<LineErrors> left_out_errors(const LineData& all, const std::vector<Sums>& sums, std::size_t count,
                                          double range_margin, const Increment& increment) {
  LineResiduals left;
  const bool by_run = all.runs > 1;
  for (std::size_t part = by_run ? 0 : kFirstTestedFifth; part < all.parts; ++part) {
    const auto uses = [&](std::size_t other) { return by_run ? other != part : other < part; };
    Sums others(sums.front().b.size());
    for (std::size_t other = 0; other < all.parts; ++other) {
      if (uses(other)) others.add(sums[other]);
    }
    const ChosenLine chosen = best_line(others, count);
    if (chosen.sensors.empty()) return std::nullopt;
    const std::size_t before = left.before_um.size();
    append_left(left, all, written(all, chosen, range_margin, increment, uses), chosen.sensors, part);
    if (left.before_um.size() == before) return std::nullopt;
  }
  return errors_of(left);
}

// sigma^2 = (g - 1) / g sum (b without part j - their mean)^2; NaN where a part holds all that is known.
Eigen::VectorXd slope_sigmas(const Sums& total, const std::vector<Sums>& sums, const std::vector<Eigen::Index>& set) {
  const auto k = static_cast<Eigen::Index>(set.size()), g = static_cast<Eigen::Index>(sums.size());
  Eigen::MatrixXd without(k, g);
  for (Eigen::Index part = 0; part < g; ++part) {
    Sums rest = total;
    rest.add(sums[static_cast<std::size_t>(part)], -1.0);
    const std::optional<Eigen::VectorXd> slope = slopes(rest, set);
    if (!slope) return Eigen::VectorXd::Constant(k, std::numeric_limits<double>::quiet_NaN());
    without.col(part) = *slope;
  }
  const Eigen::MatrixXd off = without.colwise() - without.rowwise().mean();
  return (off.rowwise().squaredNorm() * (static_cast<double>(g - 1) / static_cast<double>(g))).cwiseSqrt();
}

}  // namespace

double error_um(const LinearCompensation& line, std::span<const double> readings) {
  assert(readings.size() == line.sensors.size());
  double K_um = 0.0;
  for (std::size_t j = 0; j < readings.size(); ++j) {
    const SensorSlope& sensor = line.sensors[j];
    K_um += sensor.slope_um_per_K * (std::clamp(readings[j], sensor.low, sensor.high) - sensor.zero);
  }
  const double increments = K_um / line.increment.um;
  return line.increment.um * (line.increment.toward_zero ? std::trunc(increments) : std::round(increments));
}

Simplification simplified(const Model& model, const Series& data, std::span<const std::string> candidates,
                          std::size_t count, double range_margin, const Increment& increment) {
  if (count < 1 || count > kMostLineSensors) {
    throw Error(fmt::format("expected 1 to {} sensors, found {}.", kMostLineSensors, count));
  }
  const LineData all = line_data(model, data, candidates);
  const std::vector<Sums> sums = sums_of(all);
  Sums total(static_cast<Eigen::Index>(candidates.size()));
  for (const Sums& part : sums) total.add(part);
  const ChosenLine chosen = best_line(total, count);
  if (chosen.sensors.empty()) {
    throw Error(fmt::format("expected {} temperature{} that move{} while {} was measured, found {}.", count,
                            count == 1 ? "" : "s, each in its own way,", count == 1 ? "s" : "", model.targets.front(),
                            candidates.empty() ? "no temperature" : "none"));
  }
  const auto all_parts = [](std::size_t) { return true; };
  Simplification result;
  result.line = written(all, chosen, range_margin, increment, all_parts);
  const Eigen::VectorXd sigma = slope_sigmas(total, sums, chosen.sensors);
  for (std::size_t k = 0; k < count; ++k) {
    result.line.sensors[k].sigma_um_per_K = sigma(static_cast<Eigen::Index>(k));
  }
  result.rows = all.row.size();
  result.runs = all.runs;
  const double left = total.c - chosen.slope_um_per_K.dot(total.b(chosen.sensors));
  result.from_model_um = std::sqrt(std::max(0.0, left) / static_cast<double>(all.row.size()));
  LineResiduals fitted;
  for (std::size_t part = 0; part < all.parts; ++part) append_left(fitted, all, result.line, chosen.sensors, part);
  result.fitted = errors_of(fitted);
  result.left_out = left_out_errors(all, sums, count, range_margin, increment);
  return result;
}

}  // namespace ballbar
