#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "ballbar/internal/numerics/order_statistic.hpp"
#include "ballbar/internal/series/far_readings.hpp"
#include "ballbar/series/series.hpp"
#include "numerics/median.hpp"
#include "series/saturated_rows.hpp"

namespace ballbar {
namespace {

constexpr double kLongPause = 10.0;
// Jumps of a measured column.
constexpr std::size_t kAboutJump = 3;    // values on either side
constexpr std::size_t kDriftReach = 12;  // rows on either side whose median difference is its drift
constexpr std::size_t kFewestForJumps = 40, kFewestJumps = 3;
constexpr std::size_t kRowsForSigma = 5000;  // more take time and tell no more
constexpr double kFarJump = 7.0;             // sigma of the difference of their medians
constexpr double kInOneStep = 0.6;           // of the jump
constexpr double kOfItsNeighbours = 0.5;     // of the jump: the largest change beside it
constexpr double kStepOfInput = 0.2;         // of its range
constexpr std::size_t kRowsBeside = 2;       // of such a step

constexpr std::array<std::string_view, 8> kKinds{"pauses", "few_values", "gaps",    "constant",
                                                 "stuck",  "far_off",    "clipped", "jumps"};

// The rows that have a value.
struct KnownRows {
  std::vector<double> time_s, value;
  std::vector<char> beside_a_jump;  // of an input
};

struct LevelStep {
  std::size_t at = 0;
  double size = 0.0;
};

double middle_of(double a, double b, double c) { return std::max(std::min(a, b), std::min(std::max(a, b), c)); }

// Where the medians of three values before and after differ by far more than their drift about it, most of it in one
// step. Of a long column the usual difference is taken from some rows.
std::vector<LevelStep> level_steps(const std::vector<double>& values) {
  const std::size_t n = values.size(), last = n - std::min(n, kAboutJump);
  std::vector<LevelStep> steps;
  if (n < kFewestForJumps) return steps;
  const auto middle = [&](std::size_t at) { return middle_of(values[at], values[at + 1], values[at + 2]); };
  const auto difference = [&](std::size_t i) { return middle(i) - middle(i - kAboutJump); };
  const auto off = [&](std::size_t i) {
    std::vector<double> about;
    for (std::size_t at = std::max(kAboutJump, i - std::min(i, kDriftReach)); at < std::min(last + 1, i + kDriftReach);
         ++at)
      about.push_back(difference(at));
    return difference(i) - median(std::move(about));
  };
  std::vector<double> some;
  for (std::size_t i = kAboutJump; i <= last; i += std::max<std::size_t>(1, n / kRowsForSigma)) some.push_back(off(i));
  const double least = kFarJump * median_sigma(some);
  for (std::size_t i = kAboutJump; i <= last; ++i) {
    if (!(std::abs(values[i] - values[i - 1]) > kInOneStep * least)) continue;
    const double here = off(i), size = std::abs(here), step = (values[i] - values[i - 1]) * (here < 0.0 ? -1.0 : 1.0);
    if (!(size > least) || step < kInOneStep * size || step > size / kInOneStep) continue;
    const double before = std::abs(values[i - 1] - values[i - 2]), after = std::abs(values[i + 1] - values[i]);
    if (std::max(before, after) > kOfItsNeighbours * step) continue;  // a ramp
    if (steps.empty() || i - steps.back().at > kAboutJump) steps.push_back({i, size});
  }
  return steps;
}

// Rows within two of a step of an input by more than a fifth of its range, such as a speed: there a probe may jump.
std::vector<char> beside_jumps_of_inputs(const Series& series) {
  const std::size_t rows = series.time_s.size();
  std::vector<char> beside(rows, 0);
  for (const Column& column : series.columns) {
    if (column.role == Role::measured) continue;
    double least = std::numeric_limits<double>::infinity(), most = -least;
    for (const double value : column.values) {
      if (std::isfinite(value)) least = std::min(least, value), most = std::max(most, value);
    }
    double before = std::numeric_limits<double>::quiet_NaN();
    for (std::size_t row = 0; row < rows; ++row) {
      if (!std::isfinite(column.values[row])) continue;
      const bool jumps = std::abs(column.values[row] - before) > kStepOfInput * (most - least);
      before = column.values[row];
      if (!jumps) continue;
      const auto first = static_cast<std::ptrdiff_t>(row - std::min(row, kRowsBeside));
      const auto end = static_cast<std::ptrdiff_t>(std::min(rows, row + kRowsBeside + 1));
      std::fill(beside.begin() + first, beside.begin() + end, char{1});
    }
  }
  return beside;
}

// What the values of a smooth column show.
void add_faults_of_values(const Column& column, const KnownRows& known, std::vector<ColumnFault>& faults) {
  const std::vector<double>& values = known.value;
  const auto changed = std::find_if(values.rbegin(), values.rend(), [&](double v) { return v != values.back(); });
  const auto still = static_cast<std::size_t>(changed - values.rbegin());
  const auto steps_s = [&](std::size_t from, std::size_t to) { return known.time_s[to] - known.time_s[from]; };
  const std::vector<std::size_t> clipped = saturated_rows(values);
  if (clipped.empty() && still * 10 > values.size() && still > 20) {
    const std::size_t first = values.size() - still;
    faults.push_back({column.name, FaultKind::stuck, still, values.back(), known.time_s[first],
                      steps_s(first, values.size() - 1), false, false});
  }
  if (!clipped.empty()) {
    double long_s = 0.0;
    for (const std::size_t row : clipped) long_s += row + 1 < values.size() ? steps_s(row, row + 1) : 0.0;
    const double at = values[clipped.front()];
    faults.push_back({column.name, FaultKind::clipped, clipped.size(), at, known.time_s[clipped.front()], long_s,
                      at == *std::min_element(values.begin(), values.end()), false});
  }
  if (const std::vector<std::size_t> far = far_readings(values); !far.empty()) {
    std::vector<double> others = values;
    for (const std::size_t row : far) others[row] = values[far.front() - 1];  // the first value is none
    const auto [least, most] = std::minmax_element(others.begin(), others.end());
    const bool is_beyond = std::any_of(far.begin(), far.end(), [&, low = *least, high = *most](std::size_t row) {
      return values[row] < low || values[row] > high;
    });
    faults.push_back({column.name, FaultKind::far_off, far.size(), values[far.front()], known.time_s[far.front()], 0.0,
                      false, is_beyond});
  }
  if (column.role != Role::measured) return;
  std::vector<LevelStep> steps = level_steps(values);
  std::erase_if(steps, [&](const LevelStep& step) { return known.beside_a_jump[step.at] != 0; });
  if (steps.size() < kFewestJumps) return;
  std::vector<double> sizes;
  sizes.reserve(steps.size());
  for (const LevelStep& step : steps) sizes.push_back(step.size);
  faults.push_back({column.name, FaultKind::jumps, steps.size(), median(std::move(sizes)),
                    known.time_s[steps.front().at], 0.0, false, false});
}

}  // namespace

std::string_view name_of(FaultKind kind) { return kKinds[static_cast<std::size_t>(kind)]; }

std::vector<ColumnFault> column_faults(const Series& series) {
  std::vector<ColumnFault> faults;
  std::vector<double> steps_s;
  steps_s.reserve(series.time_s.size());
  for (std::size_t i = 1; i < series.time_s.size(); ++i) steps_s.push_back(series.time_s[i] - series.time_s[i - 1]);
  const double long_s = kLongPause * median_step_s(series.time_s);
  const auto pause = std::max_element(steps_s.begin(), steps_s.end());
  if (pause != steps_s.end() && *pause > long_s) {
    const auto count = std::count_if(steps_s.begin(), steps_s.end(), [&](double step) { return step > long_s; });
    faults.push_back({"", FaultKind::pauses, static_cast<std::size_t>(count), *pause,
                      series.time_s[static_cast<std::size_t>(pause - steps_s.begin())], long_s, false, false});
  }
  const std::vector<char> beside = beside_jumps_of_inputs(series);
  for (const Column& column : series.columns) {
    KnownRows known;
    for (std::size_t row = 0; row < column.values.size(); ++row) {
      if (!std::isfinite(column.values[row])) continue;
      known.time_s.push_back(series.time_s[row]);
      known.value.push_back(column.values[row]);
      known.beside_a_jump.push_back(beside[row]);
    }
    const std::vector<double>& values = known.value;
    const std::size_t rows = column.values.size(), gaps = rows - values.size();
    if (values.size() < 3) {
      faults.push_back({column.name, FaultKind::few_values, values.size(), 0.0, 0.0, 0.0, false, false});
      continue;
    }
    if (gaps * 20 > rows) {
      faults.push_back({column.name, FaultKind::gaps, gaps, static_cast<double>(gaps) / static_cast<double>(rows), 0.0,
                        0.0, false, false});
    }
    if (std::all_of(values.begin(), values.end(), [&](double value) { return value == values.front(); })) {
      faults.push_back({column.name, FaultKind::constant, values.size(), values.front(), 0.0, 0.0, false, false});
      continue;
    }
    // A speed rests, and so do events; a temperature or a probe never for long.
    if (column.role == Role::speed || column.role == Role::event || column.role == Role::load) continue;
    add_faults_of_values(column, known, faults);
  }
  return faults;
}

std::vector<ColumnFault> faults_bearing_on(const Series& series, std::string_view target) {
  std::vector<ColumnFault> faults = column_faults(series);
  std::erase_if(faults, [&](const ColumnFault& fault) {
    const Column* const column = find_column(series, fault.column);
    const bool is_of_values = fault.kind == FaultKind::stuck || fault.kind == FaultKind::far_off ||
                              fault.kind == FaultKind::clipped || fault.kind == FaultKind::jumps;
    if (!is_of_values || column == nullptr || (column->role == Role::measured && column->name != target)) return true;
    return fault.kind == FaultKind::far_off && !fault.is_beyond && column->name != target;
  });
  return faults;
}

}  // namespace ballbar
