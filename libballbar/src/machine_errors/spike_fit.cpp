#include "machine_errors/spike_fit.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "ballbar/units.hpp"
#include "machine_errors/cyclic_fit.hpp"
#include "machine_errors/error_blocks.hpp"
#include "numerics/log_sum.hpp"

namespace ballbar {
namespace {

constexpr double kIndependentWidths = 2.0;  // the curves of all are alike
constexpr double kNotPassed = 1e-6;         // square of a spike whose reversal no recording passes, by the noise
constexpr double kSpikes = 4.0;             // at both ends of both axes
constexpr double kStepWidths_deg[] = {0.0, 0.2, 0.4, 0.6, 0.8, 1.0, 1.25, 1.5};
constexpr double kNoWidth_deg = 1e-9;
constexpr double kSettlings_deg[] = {0.2, 0.35, 0.5, 0.7, 1.0};  // of a step that settles exponentially
constexpr double kUsualHeight_um = 3.0;                          // prior sigma of a spike
constexpr double kGap_deg = 45.0;  // from one reversal of an axis to the next there is more

// Neighbouring rows of one recording, after one reversal, and the root of their covariance.
struct Window {
  Indices rows;
  Eigen::LLT<Eigen::MatrixXd> root;
};

std::vector<Window> windows_of(const ErrorRows& rows, double reversal_deg, const Noise& noise) {
  std::vector<Window> windows;
  Eigen::Index last = -1;
  for (Eigen::Index i = 0; i < rows.size(); ++i) {
    if (since_reversal_deg(rows, i, reversal_deg) > kNearReversal_deg) continue;
    const bool goes_on =
        last >= 0 && rows.recording[static_cast<std::size_t>(i)] == rows.recording[static_cast<std::size_t>(last)] &&
        std::abs(std::remainder(deg_from_rad(rows.angle_rad[i] - rows.angle_rad[last]), 360.0)) < kGap_deg;
    if (!goes_on) windows.emplace_back();
    windows.back().rows.push_back(i);
    last = i;
  }
  for (Window& window : windows) window.root.compute(covariance_of(rows, window.rows, noise));
  return windows;
}

// Columns of the windows' rows, window by window.
Eigen::MatrixXd filters_of(const Eigen::MatrixXd& columns, const std::vector<Window>& windows) {
  Eigen::MatrixXd filters(columns.rows(), columns.cols());
  Eigen::Index first = 0;
  for (const Window& window : windows) {
    const auto size = static_cast<Eigen::Index>(window.rows.size());
    filters.middleRows(first, size) = window.root.solve(columns.middleRows(first, size));
    first += size;
  }
  return filters;
}

// The width whose spikes lower most what is left of the windows' rows.
double best_width_deg(const Effect& effect, const ErrorRows& near, const std::vector<Window>& windows,
                      const Eigen::VectorXd& left) {
  const std::vector<double>& grid = effect.parameters[shape_of(effect)].grid;
  double best = grid.front(), most = -1.0;
  for (const double width_deg : grid) {
    const Eigen::MatrixXd columns = effect_columns(effect, width_deg, near, false).values;
    const Eigen::MatrixXd filters = filters_of(columns, windows);
    double lowers = 0.0;
    for (Eigen::Index k = 0; k < columns.cols(); ++k) {
      const double square = filters.col(k).dot(columns.col(k)), product = filters.col(k).dot(left);
      if (square > kNotPassed) lowers += product * product / square;
    }
    if (lowers > most) most = lowers, best = width_deg;
  }
  return best;
}

constexpr double kClearExcess = 1.5;  // of variances

// The joined row of each quiet one; -1: it is not quiet.
std::vector<Eigen::Index> joined_row_of(const ErrorRows& rows) {
  std::vector<Eigen::Index> joined(static_cast<std::size_t>(rows.size()), -1);
  Eigen::Index row = -1;
  Eigen::Index first = -2;  // of the joined row
  for (Eigen::Index i = 0; i < rows.size(); ++i) {
    if (rows.from_reversal_deg[i] <= kNearReversal_deg) continue;
    const auto at = static_cast<std::size_t>(i);
    const bool second = first == i - 1 && rows.recording[at] == rows.recording[at - 1];
    if (!second) {
      ++row;
      first = i;
    } else {
      first = -2;
    }
    joined[at] = row;
  }
  return joined;
}

}  // namespace

StepWidth step_width(const PlayStep& step, const Effect& spike, const ErrorRows& rows, const Eigen::VectorXd& left,
                     const Noise& noise) {
  const std::vector<Window> windows = windows_of(rows, step.effect->rules.reversal_deg, noise);
  Indices near;
  for (const Window& window : windows) near.insert(near.end(), window.rows.begin(), window.rows.end());
  if (near.empty()) return {};
  const ErrorRows at = rows_at(rows, near);
  const auto curve = [&](double width_deg) -> Eigen::VectorXd {
    return at.means(unit_curves(*step.effect, at.fine, width_deg))(Eigen::all, step.gains) * step.values;
  };
  std::vector<Eigen::MatrixXd> spikes, filters;
  for (const double width_deg : spike.parameters[shape_of(spike)].grid) {
    spikes.push_back(at.means(unit_curves(spike, at.fine, width_deg)));
    filters.push_back(filters_of(spikes.back(), windows));
  }
  // ln of the evidence of each width of the step, alone and beside a spike of each width.
  std::vector<double> alone, beside;
  const Eigen::VectorXd at_once = curve(0.0);
  for (const double width_deg : kStepWidths_deg) {
    const Eigen::VectorXd rest = left(near) + at_once - curve(width_deg);
    alone.push_back(-0.5 * rest.dot(filters_of(rest, windows).col(0)));
    double sum = 0.0;
    for (std::size_t k = 0; k < spikes.size(); ++k) {
      double log_factor = 0.0;
      for (Eigen::Index end = 0; end < spikes[k].cols(); ++end) {
        const double square = filters[k].col(end).dot(spikes[k].col(end)), along = filters[k].col(end).dot(rest);
        const double prior = 1.0 / (kUsualHeight_um * kUsualHeight_um);
        log_factor += std::max(0.0, 0.5 * along * along / (square + prior) - 0.5 * std::log1p(square / prior));
      }
      sum += std::exp(std::min(log_factor, 600.0)) / static_cast<double>(spikes.size());
    }
    beside.push_back(alone.back() + std::log(sum));
  }
  // A step that settles exponentially lacks the play, as a spike, at first: also at the reversal itself, where a step
  // of no width has half of it.
  std::vector<double> steps = alone;
  const Eigen::VectorXd after = left(near) - at_once + curve(kNoWidth_deg);
  for (const double settling_deg : kSettlings_deg) {
    const Eigen::MatrixXd lacks = at.means(unit_curves(spike, at.fine, settling_deg))(Eigen::all, step.gains);
    const Eigen::VectorXd rest = after + lacks * step.values;
    steps.push_back(-0.5 * rest.dot(filters_of(rest, windows).col(0)));
  }
  StepWidth result;
  const auto mean_of = [](const std::vector<double>& logs) {
    return log_sum(logs) - std::log(static_cast<double>(logs.size()));
  };
  result.spike_evidence = 2.0 * (mean_of(beside) - mean_of(steps));
  const std::vector<double>& likelihood = result.spike_evidence >= kLeastSpikeEvidence ? beside : alone;
  const auto best = std::max_element(likelihood.begin(), likelihood.end()) - likelihood.begin();
  result.width_deg = kStepWidths_deg[best];
  return result;
}

Spikes spikes_in(const std::vector<const Effect*>& effects, const ErrorRows& rows, const Eigen::VectorXd& left,
                 const Noise& noise) {
  Spikes spikes;
  std::vector<std::pair<FittedEffect, ErrorColumns>> own;
  std::vector<Eigen::MatrixXd> filters;
  for (const Effect* effect : effects) {
    const std::vector<Window> windows = windows_of(rows, effect->rules.reversal_deg, noise);
    Indices near;
    for (const Window& window : windows) near.insert(near.end(), window.rows.begin(), window.rows.end());
    if (near.empty()) continue;
    Eigen::VectorXd weight = Eigen::VectorXd::Zero(rows.size());
    weight(near) = rows.count(near);
    const double width_deg = best_width_deg(*effect, rows_at(rows, near), windows, left(near));
    ErrorColumns columns = present(effect_columns(*effect, width_deg, rows, false), weight);
    if (columns.size() == 0) continue;
    Eigen::MatrixXd filter = Eigen::MatrixXd::Zero(rows.size(), columns.size());
    const Eigen::MatrixXd filtered = filters_of(columns.values(near, Eigen::all), windows);
    filter(near, Eigen::all) = filtered;
    own.emplace_back(FittedEffect{effect, width_deg, {}, kIndependentWidths, kSpikes, false}, std::move(columns));
    filters.push_back(std::move(filter));
  }
  Part part = part_of(own, rows);
  spikes.effects = std::move(part.effects);
  spikes.columns = std::move(part.columns);
  spikes.filters.resize(rows.size(), spikes.columns.size());
  Eigen::Index column = 0;
  for (const Eigen::MatrixXd& filter : filters) {
    spikes.filters.middleCols(column, filter.cols()) = filter;
    column += filter.cols();
  }
  return spikes;
}

QuietRows quiet_rows(const ErrorRows& rows, const Eigen::MatrixXd& columns) {
  const std::vector<Eigen::Index> joined = joined_row_of(rows);
  Eigen::Index n = 0;
  for (const Eigen::Index row : joined) n = std::max(n, row + 1);
  QuietRows quiet;
  ErrorRows& of = quiet.rows;
  of.count = of.time_s = of.angle_rad = of.interval_s = of.deviation_um = Eigen::VectorXd::Zero(n);
  of.recording.resize(static_cast<std::size_t>(n));
  of.recordings = rows.recordings;
  quiet.columns = Eigen::MatrixXd::Zero(n, columns.cols());
  for (Eigen::Index i = 0; i < rows.size(); ++i) {
    const Eigen::Index row = joined[static_cast<std::size_t>(i)];
    if (row < 0) continue;
    of.count[row] += rows.count[i];
    of.time_s[row] += rows.count[i] * rows.time_s[i];
    of.angle_rad[row] += rows.count[i] * rows.angle_rad[i];
    of.deviation_um[row] += rows.count[i] * rows.deviation_um[i];
    of.interval_s[row] = rows.interval_s[i];
    of.recording[static_cast<std::size_t>(row)] = rows.recording[static_cast<std::size_t>(i)];
    quiet.columns.row(row) += rows.count[i] * columns.row(i);
  }
  for (Eigen::VectorXd* sum : {&of.time_s, &of.angle_rad, &of.deviation_um}) *sum = sum->cwiseQuotient(of.count);
  quiet.columns.array().colwise() /= of.count.array();
  return quiet;
}

Eigen::VectorXd excess_of(const ErrorRows& rows, const Eigen::VectorXd& residual) {
  // Of the four reversals each, and of all rows that are near none.
  constexpr std::size_t kReversals = 4;
  const auto place_of = [&](Eigen::Index i) {
    if (rows.from_reversal_deg[i] > kNearReversal_deg) return kReversals;
    return static_cast<std::size_t>(std::llround(deg_from_rad(rows.angle_rad[i]) / 90.0) % 4 + 4) % kReversals;
  };
  std::array<double, kReversals + 1> squares{}, count{};
  for (Eigen::Index i = 0; i < rows.size(); ++i) {
    if (rows.from_reversal_deg[i] <= kAtReversal_deg) continue;
    squares[place_of(i)] += rows.count[i] * residual[i] * residual[i];
    count[place_of(i)] += rows.count[i];
  }
  Eigen::VectorXd excess = Eigen::VectorXd::Ones(rows.size());
  if (!(squares[kReversals] > 0.0)) return excess;
  const double quiet = squares[kReversals] / count[kReversals];
  for (Eigen::Index i = 0; i < rows.size(); ++i) {
    const std::size_t place = place_of(i);
    const double ratio = place == kReversals ? 1.0 : squares[place] / count[place] / quiet;
    if (ratio >= kClearExcess) excess[i] = std::sqrt(ratio);
  }
  return excess;
}

}  // namespace ballbar
