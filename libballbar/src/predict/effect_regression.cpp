#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "ballbar/error.hpp"
#include "ballbar/internal/fit/held_model.hpp"
#include "ballbar/internal/numerics/order_statistic.hpp"
#include "ballbar/predict/train.hpp"
#include "predict/driver_report.hpp"
#include "predict/forecasts.hpp"

namespace ballbar {
namespace {

// As the bits of RidgeSetting::kinds.
constexpr std::string_view kKinds[kPredictorKinds] = {"sources of heat", "temperatures", "their feedback",
                                                      "differences of temperatures", "temperatures at the start"};

void add_terms(const Predictors& predictors, const RidgeProblem& problem, const RidgeFit& fit,
               EffectRegression& regression) {
  const auto m = static_cast<Eigen::Index>(fit.used.size());
  regression.mean_um.resize(m);
  regression.sd_um.resize(m);
  double constant_um = fit.gains_um[0];
  for (Eigen::Index k = 0; k < m; ++k) {
    const std::size_t of = fit.used[static_cast<std::size_t>(k)];
    const auto at = static_cast<Eigen::Index>(of);
    regression.mean_um[k] = problem.mean[at];
    regression.sd_um[k] = problem.sd[at];
    const double gain = fit.gains_um[k + 1] / problem.sd[at];
    constant_um -= gain * problem.mean[at];
    const Predictor& predictor = predictors.each[of];
    regression.model.terms.push_back(held_term(predictor.effect, predictor.columns, with_gain(predictor, gain)));
  }
  regression.model.constant_um = constant_um;
  regression.end_discrepancy_um = fit.gains_um[m + 1];
  regression.factor_um = fit.factor_um;
}

void add_ranges(std::span<const Series> runs, EffectRegression& regression) {
  for (const Series& run : runs) {
    for (const ColumnRange& range : ranges_of(regression.model, run)) {
      std::vector<ColumnRange>& trained = regression.model.trained;
      const auto known = std::find_if(trained.begin(), trained.end(),
                                      [&](const ColumnRange& one) { return one.column == range.column; });
      if (known == trained.end()) {
        trained.push_back(range);
        regression.roles.push_back(find_column(run, range.column)->role);
      } else {
        known->low = std::min(known->low, range.low);
        known->high = std::max(known->high, range.high);
      }
    }
  }
}

// What other machines had, too.
void widen_ranges(const std::vector<ColumnRange>& others, EffectRegression& regression) {
  for (ColumnRange& range : regression.model.trained) {
    for (const ColumnRange& other : others) {
      if (other.column != range.column) continue;
      range.low = std::min(range.low, other.low);
      range.high = std::max(range.high, other.high);
    }
  }
}

// The state of the model after the last row.
void add_end(const Series& last_run, EffectRegression& regression) {
  LiveModel live(regression.model);
  std::vector<const Column*> columns;
  for (const std::string& name : live.columns()) columns.push_back(find_column(last_run, name));
  std::vector<double> values(columns.size());
  for (std::size_t i = 0; i < last_run.time_s.size(); ++i) {
    for (std::size_t c = 0; c < columns.size(); ++c) values[c] = columns[c]->values[i];
    live.next(last_run.time_s[i], values);
  }
  regression.end = live.state();
  regression.end_step_s = median_step_s(last_run.time_s);
}

// Of all rows of the design, without the discrepancy.
double rmse_um(const Design& design, const RidgeFit& fit, const EffectRegression& regression) {
  const auto m = static_cast<Eigen::Index>(fit.used.size());
  const Eigen::VectorXd gains = fit.gains_um.segment(1, m).cwiseQuotient(regression.sd_um);
  const Eigen::VectorXd error = design.target_um - design.values(Eigen::all, fit.used) * gains;
  return std::sqrt((error.array() - *regression.model.constant_um).square().mean());
}

// Shares of what is predicted on the training rows.
void add_named(const Design& design, const RidgeProblem& problem, const RidgeFit& fit, NamedEffects& named) {
  const auto m = static_cast<Eigen::Index>(fit.used.size()), count = static_cast<Eigen::Index>(named_in(problem, fit));
  const Eigen::MatrixXd added = problem.columns(Eigen::all, fit.used) * fit.gains_um.segment(1, m).asDiagonal();
  Eigen::MatrixXd parts(added.rows(), count + 1);
  parts << added.rightCols(count), added.leftCols(m - count).rowwise().sum();
  const Eigen::VectorXd share_um = shares_of(parts, parts.rowwise().sum());
  const Eigen::VectorXd sigma = fit.factor_um.rowwise().norm();  // of the gains, the constant first
  for (Eigen::Index k = 0; k < count; ++k) {
    const Predictor& predictor = design.predictors.each[fit.used[static_cast<std::size_t>(m - count + k)]];
    const Eigen::Index at = 1 + m - count + k;
    named.effects.push_back({label_of(held_term(predictor.effect, predictor.columns, predictor.parameters)),
                             share_um[k], std::abs(share_um[k] * sigma[at] / fit.gains_um[at])});
  }
  named.rest_um = share_um[count];
}

// On the training rows.
Start start_of(const RidgeProblem& problem, const RidgeFit& fit) {
  const auto m = static_cast<Eigen::Index>(fit.used.size());
  const Eigen::MatrixXd columns = problem.columns(Eigen::all, fit.used);
  Eigen::MatrixXd parts(columns.rows(), 2);
  parts.col(0) = columns * problem.start(fit.used);
  parts.col(1) = columns * fit.gains_um.segment(1, m) - parts.col(0);
  const Eigen::VectorXd share_um = shares_of(parts, parts.rowwise().sum());
  const double before = fit.sigma_um * fit.sigma_um * prior_trace(problem, fit.setting);
  const double after = (columns * fit.factor_um.middleRows(1, m)).squaredNorm();
  return {true, share_um[1], share_um[0], before > 0.0 ? std::min(1.0, after / before) : 1.0, {}, {}};
}

// A regression and how well it forecasts.
struct Trial {
  Design design;
  RidgeProblem problem;
  RidgeFit fit;
  std::optional<TestedForecasts> tested;
};

Trial trial_of(Design design, std::span<const Series> runs, const EffectRegressionOptions& options,
               const ForecastOptions& testing) {
  Trial trial{std::move(design), {}, {}, std::nullopt};
  const std::vector<std::size_t> rows = rows_between(0, trial.design.row.size());
  trial.problem = ridge_problem(trial.design, rows);
  if (options.progress) options.progress(options.few ? "choosing effects" : "choosing the dictionary");
  if (options.few) {
    trial.fit = few_effects(trial.problem);
  } else if (runs.size() >= kFewestRunsToLeaveOut) {
    trial.fit = ridge_fit(trial.problem, chosen_setting(ridge_problem(trial.design, rows, kChoiceRows)));
  } else {  // whether named effects help is for forecasts to tell
    trial.fit = ridge_fit(trial.problem, chosen_setting(trial.problem, trial.problem.named.empty() ? 0.0 : kFreeNamed));
  }
  if (options.forecasts) trial.tested = tested_forecasts(trial.design, runs, trial.problem, trial.fit.setting, testing);
  return trial;
}

}  // namespace

TrainedRegression trained_regression(std::span<const Series> runs, const std::string& target,
                                     const EffectRegressionOptions& options, const Catalogue& catalogue) {
  if (runs.empty()) throw Error("expected a record to train on, found none.");
  const auto say = [&](const std::string& what) {
    if (options.progress) options.progress(what);
  };
  say("evaluating the effects");
  Design without = design_of(runs, target, catalogue);
  std::optional<Design> alone;
  if (options.start != nullptr) {
    alone = without;
    without = with_start(std::move(without), *options.start, runs);
  }
  std::optional<Model> named = options.named;
  if (named) named->targets = {target};
  const ForecastOptions testing{options.few, named ? &*named : nullptr, options.progress};
  TrainedRegression trained;
  Trial trial = named ? trial_of(with_named(without, fitted(*named, runs), runs), runs, options, testing)
                      : trial_of(std::move(without), runs, options, testing);
  if (named && trial.tested) trained.named.with_um = trial.tested->forecasts.rmse_um;
  if (named && !options.few && trial.fit.setting.named_variance > 0.0 && runs.size() < kFewestRunsToLeaveOut &&
      trial.tested) {
    say("without the model's effects");
    Trial other = trial_of(std::move(without), runs, options, testing);
    trained.named.without_um = other.tested->forecasts.rmse_um;
    if (*trained.named.without_um < *trained.named.with_um) trial = std::move(other);
  }
  std::optional<double> adapted_um, alone_um;
  if (alone && trial.tested && runs.size() < kFewestRunsToLeaveOut) {
    say("without the other machines");
    Trial other = trial_of(std::move(*alone), runs, options, {options.few, nullptr, options.progress});
    adapted_um = trial.tested->forecasts.rmse_um;
    alone_um = other.tested->forecasts.rmse_um;
    if (*alone_um < *adapted_um) trial = std::move(other);
  }
  const Design& design = trial.design;
  const RidgeProblem& problem = trial.problem;
  const RidgeFit& fit = trial.fit;
  const RidgeSetting& setting = fit.setting;
  EffectRegression regression;
  regression.model.targets = {target};
  add_terms(design.predictors, problem, fit, regression);
  for (std::size_t kind = 0; kind < kPredictorKinds; ++kind) {
    if ((setting.kinds >> kind & 1U) != 0) regression.dictionary.emplace_back(kKinds[kind]);
  }
  if (options.few) regression.dictionary = {fmt::format("{} effects, the mean of nine selections", fit.used.size())};
  regression.prior_variance = setting.variance;
  regression.length_s = setting.length_s;
  regression.sigma_um = fit.sigma_um;
  regression.rows = design.row.size();
  regression.runs = runs.size();
  regression.left_out = design.predictors.left_out;
  regression.end_s = problem.end_s;
  add_ranges(runs, regression);
  if (problem.start.size() > 0) widen_ranges(options.start->model.trained, regression);
  add_end(runs.back(), regression);
  regression.rmse_um = rmse_um(design, fit, regression);
  if (options.start != nullptr) {
    trained.start = problem.start.size() > 0 ? start_of(problem, fit) : Start{};
    trained.start->adapted_um = adapted_um;
    trained.start->alone_um = alone_um;
  }
  if (named) add_named(design, problem, fit, trained.named);
  if (options.report) {
    say("leaving columns and cycles out");
    trained.drivers = driver_report(design, runs.front(), problem, fit, !options.few);
  }
  if (trial.tested) {
    regression.forecasts = trial.tested->forecasts;
    regression.interval_scale = trial.tested->interval_scale;
    trained.left_out = trial.tested->left_out;
  }
  trained.regression = std::move(regression);
  return trained;
}

EffectRegression effect_regression(std::span<const Series> runs, const std::string& target,
                                   const EffectRegressionOptions& options, const Catalogue& catalogue) {
  EffectRegressionOptions without = options;
  without.report = false;
  return trained_regression(runs, target, without, catalogue).regression;
}

Term held_term(std::shared_ptr<const Effect> effect, std::vector<std::string> columns,
               const std::vector<double>& parameters) {
  Term term{std::move(effect), std::move(columns), {}};
  term.settings.reserve(parameters.size());
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    const Parameter& parameter = term.effect->parameters[k];
    const double value = parameters[k];
    term.settings.push_back({true, value, std::min(value, parameter.lower), std::max(value, parameter.upper), true});
  }
  return term;
}

std::string dictionary_text(const EffectRegression& regression) {
  if (!regression.dictionary.empty()) return fmt::format("{}", fmt::join(regression.dictionary, ", "));
  return regression.model.terms.empty() ? "no effect" : "the effects of another regression";
}

}  // namespace ballbar
