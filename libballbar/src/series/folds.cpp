#include "series/folds.hpp"

#include <algorithm>

#include "ballbar/internal/series/speed_steps.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kMostFolds = 12;
constexpr std::size_t kParts = 5;  // of a record: no cycle is longer
constexpr std::size_t kPartsOfASweep = 4;
constexpr double kNowhere = 1e-12;  // share of a column's square that is none

std::vector<std::size_t> parts_of(const std::vector<double>& time_s, const std::vector<std::size_t>& rows,
                                  std::size_t parts) {
  std::vector<std::size_t> fold;
  const double begin = time_s[rows.front()], span = time_s[rows.back()] - begin;
  for (const std::size_t row : rows) {
    const double place = span > 0.0 ? (time_s[row] - begin) / span : 0.0;
    fold.push_back(std::min(parts - 1, static_cast<std::size_t>(place * static_cast<double>(parts))));
  }
  return fold;
}

// Whole numbers: 0, 1, 2 ... in the order they come in, those of the same recording the same; at most kMostFolds, of
// more recordings neighbours together.
std::vector<std::size_t> recordings_of(const Column& recording, const std::vector<std::size_t>& rows) {
  std::vector<std::size_t> fold;
  std::size_t now = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (i > 0 && recording.values[rows[i]] != recording.values[rows[i - 1]]) ++now;
    fold.push_back(now);
  }
  const std::size_t count = now + 1;
  if (count > kMostFolds) {
    for (std::size_t& one : fold) one = one * kMostFolds / count;
  }
  return fold;
}

// The same part of every sweep.
std::vector<std::size_t> parts_of_sweeps(const Column& recording, const std::vector<double>& time_s,
                                         const std::vector<std::size_t>& rows) {
  std::vector<std::size_t> fold;
  for (std::size_t first = 0; first < rows.size();) {
    std::size_t last = first;
    while (last < rows.size() && recording.values[rows[last]] == recording.values[rows[first]]) ++last;
    const std::vector<std::size_t> sweep(rows.begin() + static_cast<std::ptrdiff_t>(first),
                                         rows.begin() + static_cast<std::ptrdiff_t>(last));
    const std::vector<std::size_t> parts = parts_of(time_s, sweep, kPartsOfASweep);
    fold.insert(fold.end(), parts.begin(), parts.end());
    first = last;
  }
  return fold;
}

// Between changes of speed: a stretch ends with a step once it holds its share of the rows.
std::vector<std::size_t> stretches_of(const Series& data, const Column& speed, const std::vector<std::size_t>& rows) {
  const std::vector<SpeedStep> steps = speed_steps(data.time_s, speed);
  std::vector<std::size_t> step_of(data.time_s.size(), 0);
  for (std::size_t s = 0; s < steps.size(); ++s) {
    for (std::size_t row = steps[s].begin; row < steps[s].end; ++row) step_of[row] = s;
  }
  const std::size_t fewest = std::max<std::size_t>(2, rows.size() / kMostFolds);
  std::vector<std::size_t> stretch;
  std::size_t now = 0, held = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const bool ends = i > 0 && step_of[rows[i]] != step_of[rows[i - 1]];
    const bool other_run = i > 0 && data.time_s[rows[i]] < data.time_s[rows[i - 1]];
    if ((ends && held >= fewest && rows.size() - i >= fewest / 2) || (other_run && held > 1)) {
      ++now;
      held = 0;
    }
    stretch.push_back(now);
    ++held;
  }
  return stretch;
}

// Cuts long stretches into equal pieces, because half of a record cannot predict the other half.
std::vector<std::size_t> none_too_long(const std::vector<std::size_t>& stretch) {
  const std::size_t most = (stretch.size() + kParts - 1) / kParts;
  std::vector<std::size_t> fold;
  std::size_t now = 0;
  for (std::size_t first = 0; first < stretch.size();) {
    std::size_t last = first;
    while (last < stretch.size() && stretch[last] == stretch[first]) ++last;
    const std::size_t count = last - first, pieces = (count + most - 1) / most;
    for (std::size_t i = 0; i < count; ++i) fold.push_back(now + i * pieces / count);
    now += pieces;
    first = last;
  }
  return fold;
}

}  // namespace

const Column* recording_numbers(const Series& data) {
  return find_column(data, "angle_rad") == nullptr ? nullptr : find_column(data, "recording");
}

std::vector<std::size_t> folds_of(const Series& data, const std::vector<std::size_t>& rows) {
  if (const Column* recording = recording_numbers(data)) {
    const bool several = recording->values[rows.front()] != recording->values[rows.back()];
    return several ? recordings_of(*recording, rows) : parts_of_sweeps(*recording, data.time_s, rows);
  }
  const auto speed = std::find_if(data.columns.begin(), data.columns.end(),
                                  [](const Column& column) { return column.role == Role::speed; });
  if (speed == data.columns.end()) return parts_of(one_after_another(data.time_s), rows, kParts);
  return none_too_long(stretches_of(data, *speed, rows));
}

Eigen::MatrixXd squares_by_fold(const Eigen::MatrixXd& columns, const std::vector<std::size_t>& fold) {
  const std::size_t folds = *std::max_element(fold.begin(), fold.end()) + 1;
  Eigen::MatrixXd square = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(folds), columns.cols());
  for (std::size_t i = 0; i < fold.size(); ++i) {
    square.row(static_cast<Eigen::Index>(fold[i])) += columns.row(static_cast<Eigen::Index>(i)).cwiseAbs2();
  }
  return square;
}

std::vector<std::size_t> folds_that_tell(const Series& data, const std::vector<std::size_t>& rows,
                                         const std::vector<std::size_t>& fold, const Eigen::MatrixXd& columns) {
  const Column* recording = recording_numbers(data);
  if (recording == nullptr) return fold;
  const Eigen::MatrixXd square = squares_by_fold(columns, fold);
  const Eigen::RowVectorXd all = square.colwise().sum();
  for (Eigen::Index out = 0; out < square.rows(); ++out) {
    if (((all - square.row(out)).array() <= kNowhere * all.array()).any()) {
      return parts_of_sweeps(*recording, data.time_s, rows);
    }
  }
  return fold;
}

}  // namespace ballbar
