#include "ballbar/predict/growth.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "ballbar/predict/effect_regression.hpp"
#include "ballbar/series/runs.hpp"
#include "diagnosis/surrogates/phase_randomised.hpp"
#include "predict/forecasts.hpp"
#include "predict/selection.hpp"

namespace ballbar {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

// Every k-th row of the design.
struct Thin {
  std::vector<std::size_t> rows;  // of the design
  Eigen::MatrixXd columns, surrogates;
  Eigen::VectorXd target_um;
  std::vector<double> time_s;
};

Thin thin_of(const Design& design) {
  std::vector<std::size_t> all(design.row.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  Thin thin;
  thin.rows = thinned(all, kRidgeRows);
  thin.columns = design.values(thin.rows, Eigen::all);
  thin.target_um = design.target_um(thin.rows);
  for (const std::size_t row : thin.rows) thin.time_s.push_back(design.time_s[row]);
  thin.surrogates.resize(thin.columns.rows(), thin.columns.cols());
  std::mt19937_64 random(1);
  const std::vector<double> phases = random_phases(thin.rows.size(), random);
  for (Eigen::Index k = 0; k < thin.columns.cols(); ++k) {
    const std::vector<double> values(thin.columns.col(k).begin(), thin.columns.col(k).end());
    const std::vector<double> turned = phase_randomised(spectrum_of(values), phases);
    thin.surrogates.col(k) = Eigen::Map<const Eigen::VectorXd>(turned.data(), static_cast<Eigen::Index>(turned.size()));
  }
  return thin;
}

bool has_free_gain(const Term& term) {
  for (std::size_t k = 0; k < term.settings.size(); ++k) {
    if (term.effect->parameters[k].kind == ParameterKind::gain && !term.settings[k].held) return true;
  }
  return false;
}

// Of the base model, fitted to the first rows of the data: what is held, and a column for each gain that is not.
struct BaseColumns {
  Eigen::VectorXd held_um;  // thinned rows
  Eigen::MatrixXd free;
};

BaseColumns base_columns(const Model& base, const Series& data, std::size_t target, std::size_t rows,
                         const Design& design, const Thin& thin) {
  Series head = rows_of(data, {0, rows});
  head.runs = data.runs;
  const Fit fitted = fit(base, head, target);
  const Prediction prediction = predict(base, fitted.parameters, data);
  const auto at_thin = [&](const std::vector<double>& values) {
    Eigen::VectorXd column(static_cast<Eigen::Index>(thin.rows.size()));
    for (std::size_t i = 0; i < thin.rows.size(); ++i)
      column[static_cast<Eigen::Index>(i)] = values[design.row[thin.rows[i]]];
    return column;
  };
  BaseColumns columns;
  const auto n = static_cast<Eigen::Index>(thin.rows.size());
  columns.held_um = Eigen::VectorXd::Constant(n, base.constant_um.value_or(0.0));
  std::vector<Eigen::VectorXd> free;
  if (!base.constant_um) free.push_back(Eigen::VectorXd::Ones(n));
  for (std::size_t t = 0; t < base.terms.size(); ++t) {
    const Eigen::VectorXd adds_um = at_thin(prediction.contribution_um[t]);
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

// Predictors chosen on the first n thinned rows, and what that says of all of them.
struct Grown {
  std::vector<Eigen::Index> of;  // columns of the design that the selection's are
  Eigen::VectorXd mean, sd;      // of these
  PredictorSelection selection;
  std::vector<Eigen::VectorXd> predicted_um;  // thinned rows, with 0, 1 ... effects
};

Grown grown_on(const Thin& thin, const Eigen::MatrixXd& of, const BaseColumns& base, Eigen::Index n) {
  Grown grown;
  const ColumnScales scales = column_scales(of.topRows(n));
  for (Eigen::Index k = 0; k < of.cols(); ++k) {
    if (scales.sd[k] > 0.0) grown.of.push_back(k);
  }
  grown.mean = scales.mean(grown.of);
  grown.sd = scales.sd(grown.of);
  Eigen::MatrixXd columns = of(Eigen::all, grown.of);
  columns.rowwise() -= grown.mean.transpose();
  columns.array().rowwise() /= grown.sd.transpose().array();
  SelectionProblem problem;
  problem.fixed = base.free.topRows(n);
  problem.columns = columns.topRows(n);
  problem.target_um = (thin.target_um - base.held_um).head(n);
  problem.time_s.assign(thin.time_s.begin(), thin.time_s.begin() + n);
  problem.run.assign(static_cast<std::size_t>(n), 0);
  problem.end_s = problem.time_s.back();
  grown.selection = forward_selection(
      problem, selection_states(std::array{600.0, 1800.0, 7200.0, 30'000.0}, std::array{0.3, 1.0, 3.0, 10.0}),
      kMostSelected);
  const Eigen::Index fixed = base.free.cols();
  for (std::size_t k = 0; k < grown.selection.fits.size(); ++k) {
    const Eigen::VectorXd& gains = grown.selection.fits[k].gains;
    Eigen::VectorXd sum = base.held_um + base.free * gains.head(fixed);
    for (std::size_t j = 0; j < k; ++j) {
      sum += gains[fixed + static_cast<Eigen::Index>(j)] *
             columns.col(static_cast<Eigen::Index>(grown.selection.joined[j].column));
    }
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

double rms(const Eigen::VectorXd& errors) {
  return std::sqrt(errors.squaredNorm() / static_cast<double>(errors.size()));
}

// Sums over the forecasts' rows.
struct ForecastSums {
  double square = 0.0, absolute = 0.0, surrogate_square = 0.0;
};

// The last row whose forecasts are better than those of as many surrogates and of the base model; 0: none. Not that of
// the best forecasts: the least of a dozen errors from three origins is mostly luck.
std::size_t last_that_pays(const std::vector<GrowthErrors>& errors, std::size_t tried) {
  for (std::size_t k = tried; k > 0; --k) {
    if (errors[k].forecast_um < std::min(errors[0].forecast_um, errors[k].surrogate_forecast_um)) return k;
  }
  return 0;
}

}  // namespace

Growth growth(const Model& base, const Series& data, std::size_t target,
              const std::function<void(const std::string& what)>& progress, const Catalogue& catalogue) {
  const auto say = [&](const std::string& what) {
    if (progress) progress(what);
  };
  const Design design = design_of({&data, 1}, base.targets[target], catalogue);
  const Thin thin = thin_of(design);
  const auto n = static_cast<Eigen::Index>(thin.rows.size());
  say("growing the model");
  const BaseColumns whole = base_columns(base, data, target, data.time_s.size(), design, thin);
  const Grown grown = grown_on(thin, thin.columns, whole, n);
  const Grown surrogate = grown_on(thin, thin.surrogates, whole, n);
  const std::vector<ForecastRows> ahead = forecast_rows(design, data);
  std::vector<ForecastSums> sums(grown.selection.fits.size());
  double rows = 0.0;
  for (std::size_t i = 0; i < ahead.size(); ++i) {
    say(fmt::format("growing it again for forecast {} of {}", i + 1, ahead.size()));
    const auto at = [&](std::size_t row) {
      return std::lower_bound(thin.rows.begin(), thin.rows.end(), row) - thin.rows.begin();
    };
    const Eigen::Index first = at(ahead[i].first), count = at(ahead[i].end) - first;
    const BaseColumns early = base_columns(base, data, target, design.row[ahead[i].first], design, thin);
    const Grown again = grown_on(thin, thin.columns, early, first);
    const Grown nonsense = grown_on(thin, thin.surrogates, early, first);
    const auto errors = [&](const Eigen::VectorXd& predicted) {
      return (thin.target_um - predicted).segment(first, count).eval();
    };
    for (std::size_t k = 0; k < sums.size(); ++k) {
      const auto with = [&](const Grown& model) {
        return errors(model.predicted_um[std::min(k, model.predicted_um.size() - 1)]);
      };
      const Eigen::VectorXd error = with(again);
      sums[k].square += error.squaredNorm();
      sums[k].absolute += error.cwiseAbs().sum();
      sums[k].surrogate_square += with(nonsense).squaredNorm();
    }
    rows += static_cast<double>(count);
  }
  Growth result;
  result.forecasts = ahead.size();
  for (std::size_t k = 0; k < grown.predicted_um.size(); ++k) {
    GrowthErrors errors;
    errors.rmse_um = rms(thin.target_um - grown.predicted_um[k]);
    errors.surrogate_um = rms(thin.target_um - surrogate.predicted_um[std::min(k, surrogate.predicted_um.size() - 1)]);
    errors.forecast_um = rows > 0.0 ? std::sqrt(sums[k].square / rows) : kNone;
    errors.forecast_mean_um = rows > 0.0 ? sums[k].absolute / rows : kNone;
    errors.surrogate_forecast_um = rows > 0.0 ? std::sqrt(sums[k].surrogate_square / rows) : kNone;
    errors.sigma_um = grown.selection.fits[k].sigma_um;
    result.errors.push_back(errors);
  }
  while (result.tried < grown.selection.joined.size() && grown.selection.joined[result.tried].p_none <= kNotNeeded) {
    ++result.tried;
  }
  std::size_t kept = result.tried;
  result.stop = result.tried < kMostSelected ? GrowthStop::none_needed : GrowthStop::most;
  if (ahead.empty()) {
    kept = 0;
    result.stop = GrowthStop::untested;
  } else {
    kept = last_that_pays(result.errors, result.tried);
    if (kept < result.tried) result.stop = GrowthStop::as_good_as_surrogates;
  }
  const Eigen::Index fixed = whole.free.cols();
  for (std::size_t k = 1; k <= kept; ++k) {
    const Selected& joined = grown.selection.joined[k - 1];
    GrownEffect effect{{}, joined.log_bayes, joined.p_none, {}};
    for (std::size_t j = 0; j < k; ++j) {
      const std::size_t column = grown.selection.joined[j].column;
      const auto at = static_cast<Eigen::Index>(column);
      const double gain = grown.selection.fits[k].gains[fixed + static_cast<Eigen::Index>(j)] / grown.sd[at];
      const Predictor& predictor = design.predictors.each[static_cast<std::size_t>(grown.of[column])];
      effect.terms.push_back(file_term(predictor, gain, catalogue));
    }
    effect.label = label_of(effect.terms.back());
    result.effects.push_back(std::move(effect));
  }
  return result;
}

}  // namespace ballbar
