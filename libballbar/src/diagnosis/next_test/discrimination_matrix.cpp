#include "diagnosis/next_test/discrimination_matrix.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <set>

#include "ballbar/diagnosis/thresholds.hpp"
#include "diagnosis/signatures/signature_library.hpp"
#include "effects/effect_at.hpp"
#include "fit/model_columns.hpp"
#include "numerics/orthonormal.hpp"

namespace ballbar {
namespace {

constexpr double kUntilTest_s = 12.0 * 3600.0;  // from the end of the data

bool goes_on(const Effect& effect, const PlannedTest& test) {
  return effect.time_only && effect.inputs.empty() && !test.new_set_up;
}

// nullopt: the test lacks columns of the effect.
std::optional<EffectAt> in_test(const Effect& effect, const std::vector<std::string>& columns,
                                const std::vector<double>& parameters, const PlannedTest& test, const Series& data) {
  if (goes_on(effect, test)) {
    std::vector<double> time_s = data.time_s;
    std::vector<std::size_t> rows;
    for (const std::size_t row : test.rows) rows.push_back(data.time_s.size() + row);
    for (const double since_s : test.inputs.time_s) time_s.push_back(data.time_s.back() + kUntilTest_s + since_s);
    return effect_at(effect, {time_s, {}}, parameters, rows);
  }
  EffectRows inputs{test.inputs.time_s, {}};
  for (const std::string& name : columns) {
    const Column* column = find_column(test.inputs, name);
    if (column == nullptr) return std::nullopt;
    inputs.inputs.emplace_back(column->values);
  }
  return effect_at(effect, inputs, parameters, test.rows);
}

bool is_base(const Term& term) { return term.effect->rules.is_base; }

// The parameter with the index of the recording.
std::optional<std::size_t> recording_of(const Effect& effect) {
  for (std::size_t k = 0; k < effect.parameters.size(); ++k) {
    if (effect.parameters[k].shape_of == ShapeOf::recording) return k;
  }
  return std::nullopt;
}

}  // namespace

std::optional<Competitor> competitor_of(const Candidate& candidate, const Series& data, std::size_t most_points) {
  const Effect* effect = candidate.bound.effect;
  if (effect == nullptr || candidate.parameters.size() != effect->parameters.size()) return std::nullopt;
  if (candidate.bound.columns.size() != effect->inputs.size()) return std::nullopt;
  for (const std::string& name : candidate.bound.columns) {
    if (find_column(data, name) == nullptr) return std::nullopt;
  }
  Competitor competitor;
  competitor.bound = candidate.bound;
  for (std::size_t k = 0; k < candidate.parameters.size(); ++k) {
    if (!std::isfinite(candidate.parameters[k].value)) return std::nullopt;
    competitor.parameters.push_back(candidate.parameters[k].value);
    if (candidate.parameters[k].state != ParameterState::held) {
      competitor.free.push_back(k);
      if (effect->parameters[k].kind == ParameterKind::gain) competitor.gains.push_back(k);
    }
  }
  if (competitor.gains.size() == competitor.free.size() || most_points == 0) return competitor;
  // No lag and the longest lag, at which effects become equal to others.
  for (const std::size_t k : competitor.free) {
    const Parameter& parameter = effect->parameters[k];
    if (parameter.kind != ParameterKind::shape || parameter.shape_of == ShapeOf::onset) continue;
    for (const double bound : {parameter.lower, parameter.upper}) {
      if (!std::isfinite(bound)) continue;
      competitor.points.push_back(competitor.parameters);
      competitor.points.back()[k] = bound;
    }
  }
  SignatureOptions options;
  options.every_onset = false;
  const BoundInputs inputs = inputs_of(*effect, candidate.bound.columns, data);
  const std::vector<std::vector<double>> grid = shapes_of(*effect, inputs.rows, options);
  const std::size_t stride = 1 + (grid.size() - 1) / most_points;
  for (std::size_t i = 0; i < grid.size(); i += stride) {
    competitor.points.push_back(competitor.parameters);
    for (const std::size_t k : competitor.free) {
      if (effect->parameters[k].kind == ParameterKind::shape) competitor.points.back()[k] = grid[i][k];
    }
  }
  return competitor;
}

Places places_of(const DiscriminationMatrix& candidates, Eigen::Index own) {
  Places places;
  Eigen::Index next = 0;
  const auto shared = static_cast<Eigen::Index>(used_parameters(*candidates.base).size()) + own;
  while (next < shared) places.shared.push_back(next++);
  for (const Competitor& competitor : candidates.competitors) {
    places.signal.push_back(next++);
    places.free.emplace_back();
    const auto add = [&](std::size_t count) {
      std::vector<Eigen::Index>& fit = places.free.back().emplace_back();
      while (fit.size() < count) fit.push_back(next++);
    };
    add(competitor.free.size());
    for (std::size_t point = 0; point < competitor.points.size(); ++point) add(competitor.gains.size());
  }
  return places;
}

namespace {

Eigen::Index width_of(const DiscriminationMatrix& candidates, Eigen::Index own) {
  auto width = static_cast<Eigen::Index>(used_parameters(*candidates.base).size()) + own;
  for (const Competitor& competitor : candidates.competitors) {
    width += 1 + static_cast<Eigen::Index>(competitor.free.size() + competitor.gains.size() * competitor.points.size());
  }
  return width;
}

// at: the effect's values with given parameters, nullopt where it has none; false then.
template <class At>
bool put(const Competitor& competitor, const At& at, Eigen::Index& column, Eigen::MatrixXd& result) {
  const auto slopes = [&](const EffectAt& values, const std::vector<std::size_t>& by) {
    for (const std::size_t k : by) result.col(column++) = values.slopes.col(static_cast<Eigen::Index>(k));
  };
  const std::optional<EffectAt> fitted = at(competitor.parameters);
  if (!fitted) return false;
  result.col(column++) = fitted->values;
  slopes(*fitted, competitor.free);
  for (const std::vector<double>& point : competitor.points) slopes(*at(point), competitor.gains);
  return true;
}

}  // namespace

std::optional<Eigen::MatrixXd> columns_in_data(const DiscriminationMatrix& candidates, Eigen::Index own) {
  const Fit& base = *candidates.base;
  const std::vector<Eigen::Index> used = used_parameters(base);
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(base.row.size()), width_of(candidates, own));
  Eigen::Index column = 0;
  for (const Eigen::Index k : used) result.col(column++) = base.jacobian.col(k);
  column += own;
  for (const Competitor& competitor : candidates.competitors) {
    const BoundInputs inputs = inputs_of(*competitor.bound.effect, competitor.bound.columns, *candidates.data);
    const auto at = [&](const std::vector<double>& parameters) {
      return std::optional(effect_at(*competitor.bound.effect, inputs.rows, parameters, base.row));
    };
    put(competitor, at, column, result);
  }
  if (!result.allFinite()) return std::nullopt;
  return result;
}

Eigen::MatrixXd own_columns(const DiscriminationMatrix& candidates, const PlannedTest& test) {
  const auto n = static_cast<Eigen::Index>(test.rows.size());
  const std::vector<Term>& terms = candidates.model->terms;
  const auto first = std::find_if(terms.begin(), terms.end(), is_base);
  if (first == terms.end()) return Eigen::MatrixXd::Ones(n, 1);
  const Effect& circle = *first->effect;
  std::size_t offset = 1;
  for (auto term = terms.begin(); term != first; ++term) offset += term->settings.size();
  std::vector<double> parameters;
  for (std::size_t k = 0; k < circle.parameters.size(); ++k) {
    parameters.push_back(candidates.base->parameters[offset + k].value);
  }
  const std::optional<std::size_t> recording = recording_of(circle);
  const bool one_for_all = !recording || parameters[*recording] < -0.5;
  if (one_for_all && !test.new_set_up) return Eigen::MatrixXd(n, 0);
  std::set<double> numbers{-1.0};
  if (!one_for_all) {
    const std::vector<double>& number = find_column(test.inputs, "recording")->values;
    numbers = {number.begin(), number.end()};
  }
  Eigen::MatrixXd result(n, 0);
  for (const double number : numbers) {
    if (recording) parameters[*recording] = number;
    const std::optional<EffectAt> values = in_test(circle, first->columns, parameters, test, *candidates.data);
    if (!values) continue;
    const Eigen::MatrixXd slopes = values->gains(circle);
    Eigen::MatrixXd more(n, result.cols() + slopes.cols());
    more << result, slopes;
    result = std::move(more);
  }
  return result;
}

std::optional<Eigen::MatrixXd> columns_in_test(const DiscriminationMatrix& candidates, const PlannedTest& test,
                                               const Eigen::MatrixXd& own) {
  const Fit& base = *candidates.base;
  const auto n = static_cast<Eigen::Index>(test.rows.size());
  Eigen::MatrixXd all = Eigen::MatrixXd::Ones(n, base.jacobian.cols());
  Eigen::Index offset = 1;
  for (const Term& term : candidates.model->terms) {
    std::vector<double> parameters;
    for (std::size_t k = 0; k < term.settings.size(); ++k) {
      parameters.push_back(base.parameters[static_cast<std::size_t>(offset) + k].value);
    }
    const std::optional<EffectAt> values = in_test(*term.effect, term.columns, parameters, test, *candidates.data);
    if (!values) return std::nullopt;
    all.middleCols(offset, values->slopes.cols()) = values->slopes;
    offset += values->slopes.cols();
  }
  Eigen::MatrixXd result(n, width_of(candidates, own.cols()));
  Eigen::Index column = 0;
  for (const Eigen::Index k : used_parameters(base)) result.col(column++) = all.col(k);
  for (Eigen::Index k = 0; k < own.cols(); ++k) result.col(column++) = own.col(k);
  for (const Competitor& competitor : candidates.competitors) {
    const auto at = [&](const std::vector<double>& parameters) {
      std::optional<EffectAt> values =
          in_test(*competitor.bound.effect, competitor.bound.columns, parameters, test, *candidates.data);
      if (values && competitor.only_once) {
        values->values.setZero();
        values->slopes.setZero();
      }
      return values;
    };
    if (!put(competitor, at, column, result)) return std::nullopt;
  }
  if (!result.allFinite()) return std::nullopt;
  return result;
}

namespace {

Eigen::MatrixXd triangular(const Eigen::MatrixXd& columns) {
  if (columns.rows() <= columns.cols()) return columns;
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(columns);
  return qr.matrixQR().topRows(columns.cols()).triangularView<Eigen::Upper>();
}

}  // namespace

Eigen::MatrixXd whitened_factor(const Eigen::MatrixXd& columns, const Whitening& whitening) {
  return triangular(whitened(whitening, columns));
}

Eigen::MatrixXd both(const Eigen::MatrixXd& first, const Eigen::MatrixXd& columns, const Whitening& whitening) {
  Eigen::MatrixXd stacked(first.rows() + columns.rows(), first.cols());
  stacked << first, whitened(whitening, columns);
  return triangular(stacked);
}

double distance(const Eigen::MatrixXd& factor, Eigen::Index signal, const std::vector<Eigen::Index>& columns) {
  std::vector<Eigen::Index> used;
  for (const Eigen::Index column : columns) {
    if (factor.col(column).norm() > 0.0) used.push_back(column);
  }
  Eigen::MatrixXd basis = factor(Eigen::all, used);
  for (Eigen::Index k = 0; k < basis.cols(); ++k) basis.col(k).normalize();
  basis = orthonormal(basis);
  const Eigen::VectorXd a = factor.col(signal);
  // Twice, for accuracy.
  return orthogonal_part(orthogonal_part(a, basis), basis).norm();
}

}  // namespace ballbar
