#include "ballbar/internal/predict/growth.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "ballbar/fit/fit.hpp"
#include "ballbar/internal/fit/held_model.hpp"
#include "ballbar/series/series.hpp"
#include "numerics/tails.hpp"
#include "predict/forecasts.hpp"

namespace ballbar {
namespace {

constexpr double kUnknown_um = std::numeric_limits<double>::quiet_NaN();
constexpr double kInputError = 0.03;  // of a standard deviation
constexpr double kMostAdded = 0.05;   // of the error of the regression
constexpr double kChance = 0.05;
constexpr std::array<std::size_t, 9> kSizes{1, 2, 3, 5, 8, 12, 18, 27, 40};

double rms(const Eigen::VectorXd& errors) {
  return std::sqrt(errors.squaredNorm() / static_cast<double>(errors.size()));
}

bool has_free_gain(const Term& term) {
  for (std::size_t k = 0; k < term.settings.size(); ++k) {
    if (term.effect->parameters[k].kind == ParameterKind::gain && !term.settings[k].held) return true;
  }
  return false;
}

// Of the base model: what it holds, and a column for each gain that it does not.
struct BaseColumns {
  Eigen::VectorXd held_um;  // at rows of the design
  Eigen::MatrixXd free;
};

// held: the model as fitted.
BaseColumns base_columns(const Model& base, const Model& held, const Series& data, const Design& design,
                         const std::vector<std::size_t>& rows) {
  const Prediction prediction = predict(held, held_parameters(held), data);
  const auto n = static_cast<Eigen::Index>(rows.size());
  BaseColumns columns;
  columns.held_um = Eigen::VectorXd::Constant(n, base.constant_um.value_or(0.0));
  std::vector<Eigen::VectorXd> free;
  if (!base.constant_um) free.push_back(Eigen::VectorXd::Ones(n));
  for (std::size_t t = 0; t < base.terms.size(); ++t) {
    Eigen::VectorXd adds_um(n);
    for (std::size_t i = 0; i < rows.size(); ++i)
      adds_um[static_cast<Eigen::Index>(i)] = prediction.contribution_um[t][design.row[rows[i]]];
    if (!has_free_gain(base.terms[t])) {
      columns.held_um += adds_um;
    } else if (adds_um.cwiseAbs().maxCoeff() > 0.0) {
      free.push_back(adds_um);
    }
  }
  columns.free.resize(n, static_cast<Eigen::Index>(free.size()));
  for (std::size_t k = 0; k < free.size(); ++k) columns.free.col(static_cast<Eigen::Index>(k)) = free[k];
  return columns;
}

// Effects in the order in which they join, and the gains of the base's columns and of these, for each size.
struct Projection {
  std::vector<Eigen::Index> order;
  std::vector<Eigen::VectorXd> gains;
};

Projection projection_of(const Eigen::VectorXd& of, const Eigen::MatrixXd& base, const Eigen::MatrixXd& effects) {
  const Eigen::Index b = base.cols(), p = effects.cols();
  Eigen::MatrixXd columns(base.rows(), b + p);
  columns << base, effects;
  const Eigen::VectorXd with_target = columns.transpose() * of;
  Eigen::MatrixXd gram = columns.transpose() * columns;
  // Terms of the base that add the same share their gain.
  gram.diagonal().head(b) *= 1.0 + 1e-9;
  gram.diagonal().tail(p).array() += kInputError * kInputError * static_cast<double>(base.rows());
  std::vector<Eigen::Index> chosen(static_cast<std::size_t>(b));
  std::iota(chosen.begin(), chosen.end(), Eigen::Index{0});
  Projection projection;
  for (const std::size_t most = std::min(kSizes.back(), static_cast<std::size_t>(p));;) {
    const Eigen::LDLT<Eigen::MatrixXd> root(gram(chosen, chosen));
    projection.gains.emplace_back(root.solve(with_target(chosen)));
    if (projection.order.size() == most) return projection;
    const Eigen::MatrixXd across = gram(chosen, Eigen::all);
    const Eigen::VectorXd left = with_target - across.transpose() * projection.gains.back();
    const Eigen::VectorXd own = gram.diagonal() - across.cwiseProduct(root.solve(across)).colwise().sum().transpose();
    Eigen::Index best = -1;
    double most_fall = -1.0;
    for (Eigen::Index j = b; j < b + p; ++j) {
      if (std::find(chosen.begin(), chosen.end(), j) != chosen.end()) continue;
      const double fall = own[j] > 0.0 ? left[j] * left[j] / own[j] : 0.0;
      if (fall > most_fall) {
        most_fall = fall;
        best = j;
      }
    }
    chosen.push_back(best);
    projection.order.push_back(best - b);
  }
}

// The regression on all effects and what it is projected to, from the first rows of the design.
struct ProjectedRegression {
  std::vector<std::size_t> used;  // predictors of the design
  Eigen::VectorXd sd;             // of these
  Projection projection;
  Eigen::VectorXd target_um, regression_um;   // at the rows that were asked for
  std::vector<Eigen::VectorXd> predicted_um;  // the same, with 0, 1 ... effects
};

// held: the base model as fitted to the rows `from`; named_variance: of its terms in that regression.
ProjectedRegression projected_regression(const Model& base, const Model& held, const Series& data, const Design& of_all,
                                         const std::vector<std::size_t>& from, double named_variance,
                                         const std::vector<std::size_t>& asked) {
  const bool is_named = named_variance > 0.0;
  const Design anew = is_named ? with_named(of_all, held, {&data, 1}) : Design{};
  const Design& design = is_named ? anew : of_all;
  const RidgeProblem problem = ridge_problem(design, from);
  const RidgeFit all = ridge_fit(problem, chosen_setting(problem, named_variance));
  const std::vector<std::size_t> thin = thinned(from, kRidgeRows);
  std::vector<std::size_t> both = thin;
  both.insert(both.end(), asked.begin(), asked.end());
  const BaseColumns columns = base_columns(base, held, data, design, both);
  const auto n = static_cast<Eigen::Index>(thin.size()), m = static_cast<Eigen::Index>(all.used.size());
  Eigen::MatrixXd effects = design.values(both, all.used);
  effects.rowwise() -= problem.mean(all.used).transpose();
  effects.array().rowwise() /= problem.sd(all.used).transpose().array();
  const Eigen::VectorXd regression_um = (effects * all.gains_um.segment(1, m)).array() + all.gains_um[0];
  // What is written is not centred, which a constant that is held does not take up.
  if (base.constant_um) effects.rowwise() += problem.mean(all.used).cwiseQuotient(problem.sd(all.used)).transpose();
  ProjectedRegression grown;
  grown.used = all.used;
  grown.used.resize(grown.used.size() - named_in(problem, all));  // they stand in the base
  effects.conservativeResize(Eigen::NoChange, static_cast<Eigen::Index>(grown.used.size()));
  grown.sd = problem.sd(grown.used);
  grown.projection =
      projection_of((regression_um - columns.held_um).head(n), columns.free.topRows(n), effects.topRows(n));
  grown.target_um = design.target_um(asked);
  const auto ahead = static_cast<Eigen::Index>(asked.size());
  grown.regression_um = regression_um.tail(ahead);
  const Eigen::Index of_base = columns.free.cols();
  for (std::size_t k = 0; k < grown.projection.gains.size(); ++k) {
    const Eigen::VectorXd& gains = grown.projection.gains[k];
    Eigen::VectorXd sum = columns.held_um.tail(ahead) + columns.free.bottomRows(ahead) * gains.head(of_base);
    for (std::size_t j = 0; j < k; ++j)
      sum += gains[of_base + static_cast<Eigen::Index>(j)] * effects.col(grown.projection.order[j]).tail(ahead);
    grown.predicted_um.push_back(std::move(sum));
  }
  return grown;
}

// As a model file can hold it: at the edge of its shapes it is the effect that it becomes there.
Term file_term(const Predictor& predictor, double gain, const Catalogue& catalogue) {
  const std::vector<double> parameters = with_gain(predictor, gain);
  bool is_inside = true;
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    const Parameter& parameter = predictor.effect->parameters[k];
    if (parameter.kind == ParameterKind::shape) is_inside = is_inside && parameters[k] >= parameter.lower;
  }
  if (is_inside || predictor.effect->rules.becomes.empty()) {
    return held_term(predictor.effect, predictor.columns, parameters);
  }
  const auto becomes = std::find_if(catalogue.begin(), catalogue.end(), [&](const auto& effect) {
    return effect->level == Level::series && effect->name == predictor.effect->rules.becomes;
  });
  std::vector<double> of_that;
  for (const Parameter& parameter : (*becomes)->parameters)
    of_that.push_back(parameter.kind == ParameterKind::gain ? gain : parameter.start);
  return held_term(*becomes, predictor.columns, of_that);
}

// Of the forecasts from every origin, each row alike.
struct ForecastSums {
  std::vector<Eigen::VectorXd> log_rms;  // of each origin, by effects
  double rows = 0.0, of_regression = 0.0;
  std::array<double, kSizes.back() + 1> square{}, absolute{}, apart{};  // with 0, 1 ... effects, as many as there are

  void add(const ProjectedRegression& grown) {
    rows += static_cast<double>(grown.target_um.size());
    of_regression += (grown.target_um - grown.regression_um).squaredNorm();
    log_rms.emplace_back(static_cast<Eigen::Index>(square.size()));
    for (std::size_t k = 0; k < square.size(); ++k) {
      const Eigen::VectorXd& predicted_um = grown.predicted_um[std::min(k, grown.predicted_um.size() - 1)];
      const double um = rms(grown.target_um - predicted_um);
      log_rms.back()[static_cast<Eigen::Index>(k)] = std::log(std::max(um, std::numeric_limits<double>::min()));
      square[k] += (grown.target_um - predicted_um).squaredNorm();
      absolute[k] += (grown.target_um - predicted_um).cwiseAbs().sum();
      apart[k] += (grown.regression_um - predicted_um).squaredNorm();
    }
  }
};

// Whether so many effects forecast better than so many others: ln RMS over the origins, paired, one-sided 5 % over all
// comparisons (Bonferroni).
bool is_better(const std::vector<Eigen::VectorXd>& log_rms, std::size_t one, std::size_t other,
               std::size_t comparisons) {
  if (log_rms.size() < 2) return false;
  Eigen::VectorXd less(static_cast<Eigen::Index>(log_rms.size()));
  for (Eigen::Index i = 0; i < less.size(); ++i) {
    const Eigen::VectorXd& of = log_rms[static_cast<std::size_t>(i)];
    less[i] = of[static_cast<Eigen::Index>(other)] - of[static_cast<Eigen::Index>(one)];
  }
  const double degrees = static_cast<double>(less.size() - 1);
  const double sigma = std::sqrt((less.array() - less.mean()).square().sum() / degrees / (degrees + 1.0));
  return less.mean() > 0.0 && (!(sigma > 0.0) || student_tails(less.mean() / sigma, degrees) <
                                                     2.0 * kChance / static_cast<double>(comparisons));
}

// How many revisions are kept, of those that were tried.
std::size_t kept_of(Growth& result, const std::vector<Eigen::VectorXd>& log_rms) {
  const std::vector<GrowthErrors>& errors = result.errors;
  if (result.origins == 0) {
    result.stop = GrowthStop::untested;
    return 0;
  }
  if (errors.size() == 1) {
    result.stop = GrowthStop::no_better;
    return 0;
  }
  std::size_t kept = 1;
  if (result.all_um < errors[0].forecast_um) {
    const double most_um = result.all_um * std::sqrt((1.0 + kMostAdded) * (1.0 + kMostAdded) - 1.0);
    while (kept + 1 < errors.size() && !(errors[kept].apart_um < most_um)) ++kept;
    result.stop = errors[kept].apart_um < most_um ? GrowthStop::as_good_as_all : GrowthStop::most;
    const std::size_t smaller = kept - 1, repeats = errors[kept].effects;
    for (std::size_t r = 1; r <= smaller; ++r) {
      const bool is_least =
          result.stop != GrowthStop::best_forecast || errors[r].forecast_um < errors[kept].forecast_um;
      if (!is_least || !is_better(log_rms, errors[r].effects, repeats, smaller)) continue;
      kept = r;
      result.stop = GrowthStop::best_forecast;
    }
  } else {  // the regression is not worth repeating
    const auto best = std::min_element(errors.begin() + 1, errors.end(),
                                       [](const auto& a, const auto& b) { return a.forecast_um < b.forecast_um; });
    while (errors[kept].forecast_um > (1.0 + kMostAdded) * best->forecast_um) ++kept;
    result.stop = GrowthStop::best_forecast;
  }
  if (errors[kept].forecast_um < errors[0].forecast_um) return kept;
  result.stop = GrowthStop::no_better;
  return 0;
}

}  // namespace

Growth growth(const Model& base, const Series& data, std::size_t target,
              const std::function<void(const std::string& what)>& progress, const Catalogue& catalogue) {
  const auto say = [&](const std::string& what) {
    if (progress) progress(what);
  };
  const Design design = design_of({&data, 1}, base.targets[target], catalogue);
  const std::vector<std::size_t> rows = rows_between(0, design.row.size());
  const std::vector<ForecastFold> folds = forecast_folds(design, data);
  // With the terms of the base model among the effects of the regression, and without.
  std::vector<double> variances{0.0};
  if (!base.terms.empty() && can_be_named(base)) variances.push_back(kFreeNamed);
  const auto held_at_fit = [&](std::size_t end) {
    Series head = rows_of(data, {0, end});
    head.runs = data.runs;
    return held_at(base, fit(base, head, target).parameters);
  };
  std::vector<ForecastSums> tried_sums(variances.size());
  for (std::size_t i = 0; i < folds.size(); ++i) {
    say(fmt::format("growing a model for forecast {} of {}", i + 1, folds.size()));
    const Model held = held_at_fit(design.row[folds[i].rows.front()]);
    for (std::size_t u = 0; u < variances.size(); ++u) {
      tried_sums[u].add(projected_regression(base, held, data, design, folds[i].from, variances[u],
                                             thinned(folds[i].rows, kRidgeRows)));
    }
  }
  const auto best = std::min_element(tried_sums.begin(), tried_sums.end(),
                                     [](const auto& a, const auto& b) { return a.of_regression < b.of_regression; });
  const ForecastSums& sums = *best;
  say("growing the model");
  const ProjectedRegression whole =
      projected_regression(base, held_at_fit(data.time_s.size()), data, design, rows,
                           variances[static_cast<std::size_t>(best - tried_sums.begin())], thinned(rows, kRidgeRows));
  const std::size_t tried = whole.projection.order.size();
  Growth result;
  result.origins = folds.size();
  const auto mean = [&](double sum) { return sums.rows > 0.0 ? sum / sums.rows : kUnknown_um; };
  result.all_um = std::sqrt(mean(sums.of_regression));
  const auto add_errors = [&](std::size_t k) {
    result.errors.push_back({k, rms(whole.target_um - whole.predicted_um[k]), std::sqrt(mean(sums.square[k])),
                             mean(sums.absolute[k]), std::sqrt(mean(sums.apart[k]))});
  };
  add_errors(0);
  for (const std::size_t size : kSizes) {
    if (size <= tried) add_errors(size);
  }
  const std::size_t kept = kept_of(result, sums.log_rms);
  for (std::size_t r = 1; r <= kept; ++r) {
    const std::size_t k = result.errors[r].effects;
    const Eigen::VectorXd& gains = whole.projection.gains[k];
    GrownRevision revision;
    for (std::size_t j = 0; j < k; ++j) {
      const Eigen::Index at = whole.projection.order[j];
      const double gain = gains[gains.size() - static_cast<Eigen::Index>(k - j)] / whole.sd[at];
      const Predictor& predictor = design.predictors.each[whole.used[static_cast<std::size_t>(at)]];
      revision.terms.push_back(file_term(predictor, gain, catalogue));
      if (j >= result.errors[r - 1].effects) revision.joined.push_back(label_of(revision.terms.back()));
    }
    result.revisions.push_back(std::move(revision));
  }
  return result;
}

}  // namespace ballbar
