#include "machine_errors/reversal_fit.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "ballbar/units.hpp"
#include "machine_errors/error_noise.hpp"
#include "numerics/log_sum.hpp"

namespace ballbar {
namespace {

constexpr double kIndependentWidths = 2.0;  // the curves of all are alike
constexpr double kNotPassed = 1e-6;         // square of a spike whose reversal no recording passes, by the noise
constexpr double kSpikes = 4.0;             // at both ends of both axes
constexpr double kStepWidths_deg[] = {0.0, 0.2, 0.4, 0.6, 0.8, 1.0, 1.25, 1.5};
constexpr double kSettlings_deg[] = {0.2, 0.35, 0.5, 0.7, 1.0};  // of a step that settles exponentially
constexpr double kNoWidth_deg = 1e-9;
constexpr double kUsualHeight_um = 3.0;  // prior sigma of a spike
constexpr double kNeeded = 10.0;         // 2 ln of the Bayes factor
constexpr double kGap_deg = 45.0;        // from one reversal of an axis to the next there is more

// The rows after the reversals of an axis, with V of each reversal and recording.
struct RowsAfter {
  Indices rows;
  std::vector<Eigen::LLT<Eigen::MatrixXd>> roots;

  // V^-1 of columns of these rows.
  Eigen::MatrixXd filtered(const Eigen::MatrixXd& columns) const {
    Eigen::MatrixXd filters(columns.rows(), columns.cols());
    Eigen::Index first = 0;
    for (const Eigen::LLT<Eigen::MatrixXd>& root : roots) {
      filters.middleRows(first, root.rows()) = root.solve(columns.middleRows(first, root.rows()));
      first += root.rows();
    }
    return filters;
  }
  double chi2(const Eigen::VectorXd& values) const { return values.dot(filtered(values).col(0)); }
};

RowsAfter rows_after(const ErrorRows& rows, double reversal_deg, const Noise& noise) {
  RowsAfter after;
  Indices one;
  const auto close = [&] {
    if (!one.empty()) after.roots.emplace_back(covariance_of(rows, one, noise));
    one.clear();
  };
  for (Eigen::Index i = 0; i < rows.size(); ++i) {
    if (since_reversal_deg(rows, i, reversal_deg) > kNearReversal_deg) continue;
    const Eigen::Index last = one.empty() ? i : one.back();
    const double step_deg = deg_from_rad(rows.angle_rad[i] - rows.angle_rad[last]);
    const bool goes_on =
        rows.recording[static_cast<std::size_t>(i)] == rows.recording[static_cast<std::size_t>(last)] &&
        std::abs(std::remainder(step_deg, 360.0)) < kGap_deg;
    if (!goes_on) close();
    one.push_back(i);
    after.rows.push_back(i);
  }
  close();
  return after;
}

const std::vector<double>& widths_of(const Effect& spike) { return spike.parameters[shape_of(spike)].grid; }

}  // namespace

EffectDesign spike_design(const Effect& spike, const ErrorRows& rows, const Eigen::VectorXd& left, const Noise& noise) {
  const RowsAfter after = rows_after(rows, spike.rules.reversal_deg, noise);
  if (after.rows.empty()) return {};
  const ErrorRows near = rows_at(rows, after.rows);
  double best_deg = widths_of(spike).front(), most = -1.0;
  for (const double width_deg : widths_of(spike)) {
    const Eigen::MatrixXd columns = near.means(unit_curves(spike, near.fine, width_deg));
    const Eigen::MatrixXd filters = after.filtered(columns);
    double lowers = 0.0;
    for (Eigen::Index k = 0; k < columns.cols(); ++k) {
      const double square = filters.col(k).dot(columns.col(k)), product = filters.col(k).dot(left(after.rows));
      if (square > kNotPassed) lowers += product * product / square;
    }
    if (lowers > most) most = lowers, best_deg = width_deg;
  }
  Eigen::VectorXd weight = Eigen::VectorXd::Zero(rows.size());
  weight(after.rows) = rows.count(after.rows);
  EffectDesign design;
  design.x = present(effect_columns(spike, best_deg, rows, false), weight);
  design.z = Eigen::MatrixXd::Zero(rows.size(), design.x.size());
  design.z(after.rows, Eigen::all) = after.filtered(design.x.values(after.rows, Eigen::all));
  design.effect.effect = &spike;
  design.effect.shape = best_deg;
  design.effect.searched = kIndependentWidths;
  design.effect.looked_at = kSpikes;
  return design;
}

StepWidth step_width(const PlayStep& step, const Effect& spike, const ErrorRows& rows, const Eigen::VectorXd& left,
                     const Noise& noise) {
  const RowsAfter after = rows_after(rows, step.effect->rules.reversal_deg, noise);
  if (after.rows.empty()) return {};
  const ErrorRows near = rows_at(rows, after.rows);
  const auto unit = [&](const Effect& effect, double shape) -> Eigen::MatrixXd {
    return near.means(unit_curves(effect, near.fine, shape));
  };
  const auto curve = [&](double width_deg) -> Eigen::VectorXd {
    return unit(*step.effect, width_deg)(Eigen::all, step.gains) * step.values;
  };
  const Eigen::VectorXd without = left(after.rows) + curve(0.0);
  std::vector<Eigen::MatrixXd> spikes, filters;
  for (const double width_deg : widths_of(spike)) {
    spikes.push_back(unit(spike, width_deg));
    filters.push_back(after.filtered(spikes.back()));
  }
  // ln of the evidence of each step alone, and of each width beside a spike of any width.
  std::vector<double> alone, beside;
  const double prior = 1.0 / (kUsualHeight_um * kUsualHeight_um);
  for (const double width_deg : kStepWidths_deg) {
    const Eigen::VectorXd rest = without - curve(width_deg);
    alone.push_back(-0.5 * after.chi2(rest));
    std::vector<double> factors;
    for (std::size_t k = 0; k < spikes.size(); ++k) {
      factors.push_back(0.0);
      for (Eigen::Index end = 0; end < spikes[k].cols(); ++end) {
        const double square = filters[k].col(end).dot(spikes[k].col(end)), along = filters[k].col(end).dot(rest);
        factors.back() += std::max(0.0, 0.5 * along * along / (square + prior) - 0.5 * std::log1p(square / prior));
      }
    }
    beside.push_back(alone.back() + log_sum(factors) - std::log(static_cast<double>(factors.size())));
  }
  // A step that settles exponentially lacks the play, as a spike, at first: also at the reversal itself, where a step
  // of no width has half of it.
  std::vector<double> steps = alone;
  for (const double settling_deg : kSettlings_deg) {
    const Eigen::VectorXd lacks = unit(spike, settling_deg)(Eigen::all, step.gains) * step.values;
    steps.push_back(-0.5 * after.chi2(without - curve(kNoWidth_deg) + lacks));
  }
  const auto mean_of = [](const std::vector<double>& logs) {
    return log_sum(logs) - std::log(static_cast<double>(logs.size()));
  };
  StepWidth result;
  result.needs_spike = 2.0 * (mean_of(beside) - mean_of(steps)) >= kNeeded;
  const std::vector<double>& likelihood = result.needs_spike ? beside : alone;
  const auto best = std::max_element(likelihood.begin(), likelihood.end());
  result.width_deg = kStepWidths_deg[best - likelihood.begin()];
  return result;
}

}  // namespace ballbar
