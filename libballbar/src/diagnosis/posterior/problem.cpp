#include "diagnosis/posterior/problem.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string_view>

#include "diagnosis/posterior/any_form.hpp"
#include "diagnosis/posterior/robust.hpp"
#include "diagnosis/thresholds.hpp"
#include "effects/effect_at.hpp"
#include "model/resolved_periods.hpp"
#include "series/subsampled.hpp"

namespace ballbar {
namespace {

constexpr double kTemperatureJump = 0.2;  // of its range, from row to row
constexpr double kMostJumps = 0.02;       // of the rows, and in any case as many as
constexpr double kFewJumps = 5.0;
constexpr std::size_t kRowsAboutJump = 2;
constexpr double kShortestLag = 2.0;          // samples
constexpr double kMostSaturated = 2.0 / 3.0;  // of the rows
constexpr double kPriorOfPairs = 0.1;         // of all effects of two columns
constexpr double kPriorOfForm = 0.05;         // of a column in a form that no effect has

// Columns alike, the effects of one column alike; all effects of several columns together kPriorOfPairs; a column in a
// form that no effect has kPriorOfForm; a jump as one more column.
std::vector<double> log_priors_of_columns(const SignatureLibrary& library, const Tuning& tuning) {
  std::map<std::string, double> effects;  // of each column alone; "" of no column
  double pairs = 0.0, forms = 0.0;
  const auto is_form = [](const Family& family) { return family.bound.effect == &any_form(); };
  for (const Family& family : library.families) {
    const std::vector<std::string>& columns = family.bound.columns;
    if (is_form(family)) {
      forms += 1.0;
    } else if (columns.size() > 1) {
      pairs += 1.0;
    } else {
      effects[columns.empty() ? "" : columns.front()] += 1.0;
    }
  }
  const double of_form = forms > 0.0 ? kPriorOfForm : 0.0;
  const double of_pairs = pairs == 0.0 ? 0.0 : effects.empty() ? 1.0 : tuning.prior_of_pairs ? kPriorOfPairs : 0.5;
  const double of_column = (1.0 - of_pairs) / static_cast<double>(std::max<std::size_t>(1, effects.size()));
  const auto prior_of = [&](const Family& family) {
    const std::vector<std::string>& columns = family.bound.columns;
    if (is_form(family)) return of_form / forms;
    if (columns.size() > 1) return (1.0 - of_form) * of_pairs / pairs;
    return (1.0 - of_form) * of_column / effects.at(columns.empty() ? "" : columns.front());
  };
  std::vector<double> result;
  result.reserve(library.families.size());
  for (const Family& family : library.families) result.push_back(std::log(prior_of(family)));
  return result;
}

// Of recordings: effects alike, columns of an effect alike.
std::vector<double> log_priors_of(const SignatureLibrary& library) {
  std::map<const Effect*, double> families;
  for (const Family& family : library.families) families[family.bound.effect] += 1.0;
  std::vector<double> result;
  result.reserve(library.families.size());
  for (const Family& family : library.families) {
    result.push_back(-std::log(static_cast<double>(families.size())) - std::log(families[family.bound.effect]));
  }
  return result;
}

// Whether a time constant of the shape is 0 although the effect can have a lag.
bool acts_at_once(const Effect& effect, const std::vector<double>& point) {
  for (std::size_t k = 0; k < effect.parameters.size(); ++k) {
    const Parameter& parameter = effect.parameters[k];
    const bool may_lag = parameter.kind == ParameterKind::shape && parameter.unit == "s" && parameter.grid.size() > 1;
    if (may_lag && parameter.grid.front() == 0.0 && point[k] == 0.0) return true;
  }
  return false;
}

bool is_time(const Parameter& parameter) { return parameter.kind == ParameterKind::shape && parameter.unit == "s"; }

// Whether the lags of the effect are so short that the sampling of a logger could cause them, and the catalogue has the
// effect without a lag; or whether it is a shift of the clock by as little.
bool is_without_its_lag(const SignatureLibrary& library, const LoggedInputs& logged, const BoundEffect& bound,
                        const std::vector<double>& point) {
  const bool is_shift = !bound.effect->inputs.empty() && bound.effect->inputs.front().of_another_effect;
  const bool is_twin =
      is_shift || std::any_of(library.families.begin(), library.families.end(), [&](const Family& other) {
        const Effect& effect = *other.bound.effect;
        return effect.name == bound.effect->rules.becomes && other.bound.columns == bound.columns &&
               std::none_of(effect.parameters.begin(), effect.parameters.end(), is_time);
      });
  if (!is_twin) return false;
  double sample_s = 0.0;
  for (const LoggedInput& input : logged.inputs) {
    if (std::find(bound.columns.begin(), bound.columns.end(), input.column) != bound.columns.end())
      sample_s = std::max(sample_s, input.sample_s);
  }
  for (std::size_t k = 0; k < point.size(); ++k) {
    if (is_time(bound.effect->parameters[k]) && std::abs(point[k]) < kShortestLag * sample_s) return true;
  }
  return false;
}

std::vector<double> log_priors_of_shapes(const SignatureLibrary& library, const LoggedInputs& logged,
                                         const Tuning& tuning) {
  std::vector<double> result(library.signatures.size());
  for (const Family& family : library.families) {
    const auto is_short = [&](std::size_t i) {
      return tuning.lags_above_sampling &&
             is_without_its_lag(library, logged, family.bound, library.signatures[i].point);
    };
    std::size_t too_short = 0;
    for (std::size_t i = family.first; i < family.first + family.count; ++i) too_short += is_short(i) ? 1 : 0;
    if (too_short == family.count) too_short = 0;
    std::size_t at_once = 0;
    const auto is_at_once = [&](std::size_t i) {
      return tuning.prior_of_lags && acts_at_once(*family.bound.effect, library.signatures[i].point);
    };
    for (std::size_t i = family.first; i < family.first + family.count; ++i) at_once += is_at_once(i) ? 1 : 0;
    const std::size_t others = family.count - at_once - too_short;
    for (std::size_t i = family.first; i < family.first + family.count; ++i) {
      if (too_short > 0 && is_short(i)) {
        result[i] = kLogZero;
        continue;
      }
      const double share = at_once == 0 || others == 0 ? 1.0 : 0.5;
      result[i] = std::log(share / static_cast<double>(is_at_once(i) ? at_once : others));
    }
  }
  return result;
}

// By least squares; the prediction of a model with all parameters held.
Fit base_fit(const Model& model, const Series& data, std::size_t target) {
  if (has_free(model)) return fit(model, data, target, {.white = true});
  Model free = model;
  free.constant_um.reset();
  Fit result = fit(free, data, target, {.white = true});
  const double held = model.constant_um.value_or(0.0), found = result.parameters.front().value;
  result.parameters.front().value = held;
  result.parameters.front().state = ParameterState::held;
  for (std::size_t i = 0; i < result.row.size(); ++i) {
    result.predicted_um[i] += held - found;
    result.residual_um[i] -= held - found;
  }
  result.jacobian.setZero();
  return result;
}

std::vector<OwnParameter> own_of(const Model& model) {
  std::vector<OwnParameter> own;
  std::size_t place = 1;
  for (const Term& term : model.terms) {
    for (std::size_t k = 0; k < term.settings.size(); ++k, ++place) {
      const Parameter& parameter = term.effect->parameters[k];
      if (!term.settings[k].held) continue;
      const bool is_shape = is_of_curve(parameter.shape_of) && (!parameter.grid.empty() || parameter.unit == "s");
      if (parameter.kind != ParameterKind::gain && !is_shape) continue;  // a dimension of the part
      own.push_back({place, term.settings[k].start, {}});
    }
  }
  return own;
}

// Rows in whose sample an input changed tell nothing.
void set_aside_rows_in_jumps(Problem& problem) {
  std::set<std::size_t> rows;
  for (const LoggedInput& input : problem.logged.inputs) {
    for (const Jump& jump : input.jumps) {
      for (std::size_t row = jump.first + 1; row < jump.last && input.is_stepped; ++row) rows.insert(row);
    }
  }
  for (std::size_t i = 0; i < problem.base.row.size(); ++i) {
    if (rows.contains(problem.base.row[i])) problem.stated_variance[i] = kUnknownVariance;
  }
}

// Rows near jumps of a temperature: a jump there may be that of the temperature, which is smoothed.
std::vector<char> rows_of_temperature_jumps(const Series& data, const std::vector<std::size_t>& rows) {
  std::vector<char> found(rows.size(), 0);
  for (const Column& column : data.columns) {
    const std::string_view unit = unit_of(column.name);
    if (unit != "degC" && unit != "K") continue;
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const std::size_t row : rows) {
      low = std::min(low, column.values[row]);
      high = std::max(high, column.values[row]);
    }
    const auto jumps = [&](std::size_t k) {
      return std::abs(column.values[rows[k]] - column.values[rows[k - 1]]) > kTemperatureJump * (high - low);
    };
    std::size_t count = 0;
    for (std::size_t k = 1; k < rows.size(); ++k) count += jumps(k) ? 1 : 0;
    if (static_cast<double>(count) > std::max(kFewJumps, kMostJumps * static_cast<double>(rows.size())))
      continue;  // it is noise
    for (std::size_t k = 1; k < rows.size(); ++k) {
      if (!jumps(k)) continue;
      const std::size_t first = k > kRowsAboutJump ? k - kRowsAboutJump : 0,
                        last = std::min(rows.size() - 1, k + kRowsAboutJump);
      std::fill(found.begin() + static_cast<std::ptrdiff_t>(first),
                found.begin() + static_cast<std::ptrdiff_t>(last) + 1, char{1});
    }
  }
  return found;
}

// Rows in which a sensor stands at the end of its range tell nothing of it, if at least a third remains.
void set_aside_saturated(Problem& problem) {
  std::set<std::size_t> rows;
  for (const LoggedInput& input : problem.logged.inputs) rows.insert(input.at_end.begin(), input.at_end.end());
  std::vector<std::size_t> known;
  for (std::size_t i = 0; i < problem.base.row.size(); ++i) {
    if (rows.contains(problem.base.row[i])) known.push_back(i);
  }
  if (static_cast<double>(known.size()) > kMostSaturated * static_cast<double>(problem.base.row.size())) return;
  for (const std::size_t i : known) problem.stated_variance[i] = kUnknownVariance;
}

}  // namespace

Point point_at(const Problem& problem, const Covariance& covariance) {
  return {covariance, Whitening(covariance, problem.time_s,
                                {.variance = problem.stated_variance, .relative_variance = problem.relative_variance})};
}

std::vector<double> fitted_parameters(const Problem& problem) {
  std::vector<double> parameters;
  for (const FittedParameter& one : problem.base.parameters) parameters.push_back(one.value);
  parameters.front() -= problem.centre_um;
  return parameters;
}

double least_variance_of(const Problem& problem) {
  constexpr double kRounding = 1e-4;  // of the standard deviation of the readings: finer than any logger
  return kRounding * kRounding * problem.y.squaredNorm() /
         static_cast<double>(std::max<Eigen::Index>(1, problem.y.size()));
}

Eigen::MatrixXd with_levels(const Problem& problem, Eigen::MatrixXd open) {
  const Eigen::Index first = open.cols();
  open.conservativeResize(static_cast<Eigen::Index>(problem.time_s.size()),
                          first + static_cast<Eigen::Index>(problem.level_jumps.size()));
  for (std::size_t k = 0; k < problem.level_jumps.size(); ++k) {
    const LevelJump& jump = problem.level_jumps[k];
    auto column = open.col(first + static_cast<Eigen::Index>(k));
    column.setZero();
    column.tail(column.size() - static_cast<Eigen::Index>(jump.row)).setConstant(jump.size_um);
  }
  return open;
}

std::optional<std::size_t> add_signature(Problem& problem, std::size_t family, const std::vector<double>& point) {
  SignatureLibrary& library = problem.library;
  Family& of = library.families[family];
  for (const std::size_t i : of.more) {
    if (library.signatures[i].point == point) return std::nullopt;
  }
  if (problem.tuning.lags_above_sampling && is_without_its_lag(library, problem.logged, of.bound, point))
    return std::nullopt;
  const Effect& effect = *of.bound.effect;
  const BoundInputs inputs = inputs_of(effect, of.bound.columns, problem.logged.series);
  const Eigen::MatrixXd gains = effect_at(effect, inputs.rows, point, problem.base.row).gains(effect);
  const Signature& usual = library.signatures[of.first];
  if (!gains.allFinite() || gains.cols() != usual.width) return std::nullopt;
  if (is_same_as_input(effect, inputs.rows, problem.base.row, gains.col(0))) return std::nullopt;
  Signature added{family, point, library.columns.cols(), usual.width,
                  gains.col(0).maxCoeff() - gains.col(0).minCoeff()};
  Eigen::MatrixXd unit = gains;
  Eigen::VectorXd deviation(gains.cols());
  for (Eigen::Index k = 0; k < gains.cols(); ++k) {
    const double mean = gains.col(k).mean();
    deviation[k] = std::sqrt((gains.col(k).array() - mean).square().mean());
    if (!(deviation[k] > 1e-12)) return std::nullopt;
    unit.col(k) /= deviation[k];
  }
  library.columns.conservativeResize(Eigen::NoChange, added.first + added.width);
  library.columns.rightCols(added.width) = gains;
  problem.signatures.conservativeResize(Eigen::NoChange, added.first + added.width);
  problem.signatures.rightCols(added.width) = unit;
  problem.deviation.conservativeResize(added.first + added.width);
  problem.deviation.tail(added.width) = deviation;
  problem.log_prior_of_shape.push_back(problem.log_prior_of_shape[of.first + of.count - 1]);
  of.more.push_back(library.signatures.size());
  library.signatures.push_back(std::move(added));
  return library.signatures.size() - 1;
}

const Term* given_term(const Problem& problem, const BoundEffect& bound) {
  const auto given = std::find_if(problem.terms.begin(), problem.terms.end(), [&](const Term& one) {
    return one.effect->name == bound.effect->name && one.columns == bound.columns;
  });
  return given == problem.terms.end() ? nullptr : &*given;
}

Term term_of(const Problem& problem, const BoundEffect& bound) {
  const Term* given = given_term(problem, bound);
  return with_resolved_periods(given != nullptr ? *given : term_of(*bound.effect, bound.columns), problem.highest_Hz);
}

std::unique_ptr<Problem> problem_of(const Model& model, const Series& data, std::size_t target,
                                    const ProblemOptions& options) {
  auto problem = std::make_unique<Problem>();
  problem->tuning = options.search.tuning;
  const Tuning& tuning = problem->tuning;
  const std::string& name = model.targets.at(target);
  const Series rows = subsampled(data, name, options.most_rows, options.whole_about_s);
  problem->logged = logged_inputs(rows, model.targets, tuning);
  problem->base = base_fit(model, problem->logged.series, target);
  const Fit& base = problem->base;
  problem->time_s = base.time_s;
  problem->highest_Hz = highest_Hz(problem->time_s);
  problem->model = with_resolved_periods(model, problem->highest_Hz);
  problem->at_jump_of_temperature = rows_of_temperature_jumps(rows, base.row);
  if (!tuning.jumps_of_temperature) problem->at_jump_of_temperature.assign(base.row.size(), 0);
  const auto n = static_cast<Eigen::Index>(base.row.size());
  problem->y = Eigen::VectorXd::Map(base.measured_um.data(), n);
  if (model.level == Level::series && !model.constant_um) {
    problem->centre_um = problem->y.mean();
    problem->y.array() -= problem->centre_um;
  }
  problem->stated_variance.assign(base.row.size(), 0.0);
  problem->relative_variance.assign(base.row.size(), 1.0);
  if (!base.sigma_um.empty()) {
    double mean = 0.0;
    for (const double sigma : base.sigma_um) mean += sigma * sigma / static_cast<double>(n);
    for (std::size_t i = 0; i < base.sigma_um.size(); ++i)
      problem->relative_variance[i] = base.sigma_um[i] * base.sigma_um[i] / mean;
    problem->known = {4.0, mean};
  }
  if (tuning.rows_at_jumps) set_aside_rows_in_jumps(*problem);
  problem->longest_memory_s = options.search.longest_memory_s;
  if (model.level == Level::series) {
    if (tuning.saturated_rows) set_aside_saturated(*problem);
    if (!tuning.bounded_memory) problem->longest_memory_s = 1e9;
  } else {
    problem->longest_memory_s = std::numeric_limits<double>::infinity();
  }
  problem->base_model = std::make_unique<BaseModel>(problem->model, problem->logged, problem->y, base.row);
  SignatureOptions signatures;
  signatures.terms = options.terms;
  signatures.motion = options.search.motion;
  signatures.without = options.search.without;
  signatures.causes_only = true;
  problem->library = signature_library_of(options.search.catalogue, model, problem->logged.series, base, signatures);
  problem->effects = problem->library.families.size();
  if (model.level == Level::series && base.row.size() > kFewReadings)
    add_any_forms(problem->library, problem->logged.series, base.row);
  problem->signatures = problem->library.columns;
  problem->deviation = Eigen::VectorXd::Ones(problem->signatures.cols());
  for (Eigen::Index k = 0; k < problem->signatures.cols(); ++k) {
    auto column = problem->signatures.col(k);
    const double mean = column.mean();
    const double deviation = std::sqrt((column.array() - mean).square().mean());
    if (!(deviation > 0.0)) continue;
    column /= deviation;
    problem->deviation[k] = deviation;
  }
  problem->log_prior =
      model.level == Level::series ? log_priors_of_columns(problem->library, tuning) : log_priors_of(problem->library);
  problem->log_prior_of_shape = log_priors_of_shapes(problem->library, problem->logged, tuning);
  if (tuning.held_values) problem->own = own_of(model);
  problem->terms = options.terms;
  problem->covariances = options.covariances;
  return problem;
}

}  // namespace ballbar
