#include "diagnosis/posterior/problem.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string_view>

#include "diagnosis/posterior/priors.hpp"
#include "diagnosis/signatures/any_form.hpp"
#include "diagnosis/signatures/thresholds.hpp"
#include "effects/effect_at.hpp"
#include "fit/model_columns.hpp"
#include "model/resolved_periods.hpp"
#include "numerics/standard_deviation.hpp"
#include "series/saturated_rows.hpp"
#include "series/stuck_rows.hpp"
#include "series/subsampled.hpp"

namespace ballbar {
namespace {

constexpr double kFewJumps = 5.0;
constexpr Eigen::Index kRoomForColumns = 64;

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

std::vector<HeldParameter> held_parameters_of(const Model& model) {
  std::vector<HeldParameter> held;
  std::size_t place = 1;
  for (const Term& term : model.terms) {
    for (std::size_t k = 0; k < term.settings.size(); ++k, ++place) {
      const Parameter& parameter = term.effect->parameters[k];
      if (!term.settings[k].held) continue;
      const bool is_shape = is_of_curve(parameter.shape_of) && (!parameter.grid.empty() || parameter.unit == "s");
      if (parameter.kind != ParameterKind::gain && !is_shape) continue;  // a dimension of the part
      held.push_back({place, term.settings[k].start});
    }
  }
  return held;
}

// Rows in which a sensor stands at the end of its range or is stuck; none if less than a third of the rows would
// remain.
std::set<std::size_t> rows_of_faults(const LoggedInputs& logged, const Fit& base, Level level, const Tuning& tuning) {
  std::set<std::size_t> faults;
  if (level != Level::series) return faults;
  for (const LoggedInput& input : logged.inputs) faults.insert(input.at_end.begin(), input.at_end.end());
  for (const std::size_t k : clipped_readings(base, tuning)) faults.insert(base.row[k]);
  for (const std::size_t k : stuck_readings(base, tuning)) faults.insert(base.row[k]);
  const auto count =
      std::count_if(base.row.begin(), base.row.end(), [&](std::size_t row) { return faults.contains(row); });
  if (static_cast<double>(count) > tuning.most_saturated * static_cast<double>(base.row.size())) faults.clear();
  return faults;
}

// The variance of each reading that is known beforehand. Rows in whose sample an input changed tell nothing, nor those
// of faults.
std::vector<double> stated_variance_of(const LoggedInputs& logged, const std::vector<std::size_t>& rows,
                                       const std::set<std::size_t>& faults, const Tuning& tuning) {
  std::set<std::size_t> in_jumps;
  for (const LoggedInput& input : logged.inputs) {
    for (const Jump& jump : input.jumps) {
      for (std::size_t row = jump.first + 1; row < jump.last && tuning.rows_at_jumps; ++row) in_jumps.insert(row);
    }
  }
  std::vector<double> variance;
  variance.reserve(rows.size());
  for (const std::size_t row : rows)
    variance.push_back(in_jumps.contains(row) || faults.contains(row) ? kUnknownVariance : 0.0);
  return variance;
}

// Rows near jumps of a temperature: a jump there may be that of the temperature, which is smoothed.
std::vector<char> rows_of_temperature_jumps(const Series& data, const std::vector<std::size_t>& rows,
                                            const Tuning& tuning) {
  std::vector<char> found(rows.size(), 0);
  const auto mark = [&](std::size_t k) {
    const std::size_t first = k > tuning.rows_about_jump ? k - tuning.rows_about_jump : 0,
                      last = std::min(rows.size() - 1, k + tuning.rows_about_jump);
    std::fill(found.begin() + static_cast<std::ptrdiff_t>(first), found.begin() + static_cast<std::ptrdiff_t>(last) + 1,
              char{1});
  };
  const std::vector<RowRange> runs = data.sensor_jumps.empty() ? std::vector<RowRange>{} : runs_of(data.time_s);
  for (const SensorJump& jump : data.sensor_jumps) {
    for (std::size_t run = 0; run < runs.size(); ++run) {
      if (run < data.runs.size() && data.runs[run].name != jump.run) continue;
      const auto behind = std::find_if(rows.begin(), rows.end(), [&](std::size_t row) {
        return row >= runs[run].begin && row < runs[run].end && data.time_s[row] >= jump.time_s;
      });
      if (behind != rows.end()) mark(static_cast<std::size_t>(behind - rows.begin()));
    }
  }
  for (const Column& column : data.columns) {
    const std::string_view unit = unit_of(column.name);
    if (unit != "degC" && unit != "K") continue;
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const std::size_t row : rows) {
      low = std::min(low, column.values[row]);
      high = std::max(high, column.values[row]);
    }
    const auto jumps = [&](std::size_t k) {
      return std::abs(column.values[rows[k]] - column.values[rows[k - 1]]) > tuning.temperature_jump * (high - low);
    };
    std::size_t count = 0;
    for (std::size_t k = 1; k < rows.size(); ++k) count += jumps(k) ? 1 : 0;
    if (static_cast<double>(count) >
        std::max(kFewJumps, tuning.most_temperature_jumps * static_cast<double>(rows.size())))
      continue;  // it is noise
    for (std::size_t k = 1; k < rows.size(); ++k) {
      if (jumps(k)) mark(k);
    }
  }
  return found;
}

}  // namespace

std::vector<std::size_t> clipped_readings(const Fit& base, const Tuning& tuning) {
  return saturated_rows(base.measured_um,
                        {tuning.fewest_at_end, tuning.least_at_end, tuning.small_step, tuning.fewest_changes});
}

std::vector<std::size_t> stuck_readings(const Fit& base, const Tuning& tuning) {
  std::vector<std::size_t> readings;
  for (const RowRange& run : tuning.stuck_sensors ? stuck_runs(base.measured_um) : std::vector<RowRange>{}) {
    for (std::size_t k = run.begin; k < run.end; ++k) readings.push_back(k);
  }
  return readings;
}

NoiseFilter noise_filter_at(const Problem& problem, const Covariance& covariance) {
  return {covariance, Whitening(covariance, problem.time_s,
                                {.variance = problem.stated_variance, .relative_variance = problem.relative_variance})};
}

std::vector<double> fitted_parameters(const Problem& problem) {
  std::vector<double> parameters;
  for (const FittedParameter& one : problem.base.parameters) parameters.push_back(one.value);
  parameters.front() -= problem.centre_um;
  return parameters;
}

std::size_t largest_sum(const Problem& problem) {
  constexpr std::size_t kValuesForAnEffect = 4;  // rows beyond the model's
  const std::size_t values = problem.time_s.size(), parameters = used_parameters(problem.base).size();
  if (values <= parameters) return 0;
  return std::min(problem.tuning.most_effects, (values - parameters) / kValuesForAnEffect);
}

bool is_still(const Problem& problem) {
  constexpr double kStill_um = 1e-9;  // rms
  const double square = (problem.y.array() - problem.y.mean()).square().sum();
  return !(square > kStill_um * kStill_um * static_cast<double>(problem.y.size()));
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
    if (library.signatures[i].point == point) return i;
  }
  if (is_without_its_lag(library, problem.logged, of.bound, point, problem.tuning)) return std::nullopt;
  const Effect& effect = *of.bound.effect;
  const BoundInputs inputs = inputs_of(effect, of.bound.columns, problem.logged.series);
  const Eigen::MatrixXd gains = effect_at(effect, inputs.rows, point, problem.base.row).gains(effect);
  const Signature& usual = library.signatures[of.first];
  if (!gains.allFinite() || gains.cols() != usual.width) return std::nullopt;
  if (is_same_as_input(effect, inputs.rows, problem.base.row, gains.col(0))) return std::nullopt;
  Signature added{family, point, problem.deviation.size(), usual.width,
                  gains.col(0).maxCoeff() - gains.col(0).minCoeff()};
  Eigen::MatrixXd unit = gains;
  Eigen::VectorXd deviation(gains.cols());
  for (Eigen::Index k = 0; k < gains.cols(); ++k) {
    deviation[k] = standard_deviation(gains.col(k));
    if (!(deviation[k] > 1e-12)) return std::nullopt;
    unit.col(k) /= deviation[k];
  }
  added.range_um /= deviation[0];
  problem.deviation.conservativeResize(added.first + added.width);
  problem.deviation.tail(added.width) = deviation;
  if (problem.deviation.size() > library.columns.cols())
    library.columns.conservativeResize(Eigen::NoChange, problem.deviation.size() + kRoomForColumns);
  library.columns.middleCols(added.first, added.width) = unit;
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

LoggedInputs logged_inputs_of(const Model& model, const Series& data, std::size_t target,
                              const ProblemOptions& options) {
  return logged_inputs(subsampled(data, model.targets.at(target), options.most_rows, options.whole_about_s),
                       model.targets, options.search.tuning);
}

std::unique_ptr<Problem> problem_of(const Model& model, const Series& data, std::size_t target,
                                    const ProblemOptions& options) {
  auto problem = std::make_unique<Problem>();
  problem->tuning = options.search.tuning;
  const Tuning& tuning = problem->tuning;
  problem->logged = options.logged != nullptr ? *options.logged : logged_inputs_of(model, data, target, options);
  problem->base = base_fit(model, problem->logged.series, target);
  const Fit& base = problem->base;
  problem->time_s = base.time_s;
  problem->highest_Hz = highest_Hz(problem->time_s);
  problem->model = with_resolved_periods(model, problem->highest_Hz);
  problem->at_jump_of_temperature = rows_of_temperature_jumps(data, base.row, tuning);
  const auto n = static_cast<Eigen::Index>(base.row.size());
  problem->y = Eigen::VectorXd::Map(base.measured_um.data(), n);
  if (model.level == Level::series && !model.constant_um) {
    problem->centre_um = problem->y.mean();
    problem->y.array() -= problem->centre_um;
  }
  problem->rows_of_faults = rows_of_faults(problem->logged, base, model.level, tuning);
  problem->stated_variance = stated_variance_of(problem->logged, base.row, problem->rows_of_faults, tuning);
  problem->relative_variance.assign(base.row.size(), 1.0);
  if (!base.sigma_um.empty()) {
    double mean = 0.0;
    for (const double sigma : base.sigma_um) mean += sigma * sigma / static_cast<double>(n);
    for (std::size_t i = 0; i < base.sigma_um.size(); ++i)
      problem->relative_variance[i] = base.sigma_um[i] * base.sigma_um[i] / mean;
    problem->known = {4.0, mean};
  }
  problem->longest_memory_s =
      model.level == Level::series ? options.search.longest_memory_s : std::numeric_limits<double>::infinity();
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
  problem->deviation = Eigen::VectorXd::Ones(problem->library.columns.cols());
  for (Eigen::Index k = 0; k < problem->deviation.size(); ++k) {
    auto column = problem->library.columns.col(k);
    const double deviation = standard_deviation(column);
    if (!(deviation > 0.0)) continue;
    column /= deviation;
    problem->deviation[k] = deviation;
  }
  for (Signature& one : problem->library.signatures) one.range_um /= problem->deviation[one.first];
  problem->log_prior = log_priors_of_identities(problem->library, model.level, tuning);
  problem->log_prior_of_shape = log_priors_of_shapes(problem->library, problem->logged, tuning);
  if (tuning.held_values > 0.0) problem->held = held_parameters_of(model);
  problem->terms = options.terms;
  problem->covariances = options.covariances;
  return problem;
}

}  // namespace ballbar
