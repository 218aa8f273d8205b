#include "diagnosis/signatures/signature_library.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "ballbar/internal/numerics/parallel.hpp"
#include "diagnosis/signatures/thresholds.hpp"
#include "effects/effect_at.hpp"
#include "model/bindings.hpp"
#include "model/measured_input.hpp"
#include "model/resolved_periods.hpp"
#include "noise/whitening.hpp"
#include "numerics/orthonormal.hpp"

namespace ballbar {
namespace {

constexpr double kNothingLeft = 1e-8;    // share of a column's square that is rounding error
constexpr std::size_t kMostWaves = 400;  // of one shape on recordings
constexpr std::size_t kMostPeriods = 200;
constexpr std::size_t kMostOnsets = 7;

bool is_constant(const std::vector<double>& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return !(*high > *low);
}

bool is_whole(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
}

// One column per gain, at the rows of the fit; empty if a value is not finite or all are constant.
std::vector<Eigen::VectorXd> gains_of(const Effect& effect, const EffectRows& inputs, const std::vector<double>& point,
                                      const std::vector<std::size_t>& rows) {
  std::vector<Eigen::VectorXd> gains;
  const Eigen::MatrixXd columns = effect_at(effect, inputs, point, rows).gains(effect);
  for (const auto& column : columns.colwise()) {
    if (!column.allFinite() || column.maxCoeff() - column.minCoeff() < 1e-12) continue;
    gains.emplace_back(column);
  }
  return gains;
}

std::size_t gain_count(const Effect& effect) {
  return static_cast<std::size_t>(
      std::count_if(effect.parameters.begin(), effect.parameters.end(),
                    [](const Parameter& parameter) { return parameter.kind == ParameterKind::gain; }));
}

std::vector<double> onsets(const EffectRows& rows) {
  std::vector<double> grid;
  const std::size_t n = rows.time_s.size();
  const std::size_t stride = 1 + n / kMostOnsets;
  for (std::size_t row = std::max<std::size_t>(1, stride / 2); row < n; row += stride) {
    grid.push_back(0.5 * (rows.time_s[row] + rows.time_s[row - 1]));
  }
  return grid;
}

}  // namespace

bool is_same_as_input(const Effect& effect, const EffectRows& inputs, const std::vector<std::size_t>& rows,
                      const Eigen::VectorXd& gain) {
  if (!effect.rules.same_as_input) return false;
  Eigen::VectorXd input(gain.size());
  for (std::size_t i = 0; i < rows.size(); ++i) input[static_cast<Eigen::Index>(i)] = inputs.inputs[0][rows[i]];
  const Eigen::VectorXd a = input.array() - input.mean(), b = gain.array() - gain.mean();
  return std::abs(a.dot(b)) > *effect.rules.same_as_input * a.norm() * b.norm();
}

bool is_jump(const Effect& effect) {
  return effect.level == Level::series && effect.time_only && effect.inputs.empty() && effect.parameters.size() == 2 &&
         effect.parameters[1].shape_of == ShapeOf::onset;
}

bool describes_drift(const Effect& effect) {
  return effect.level == Level::series && effect.time_only && !is_jump(effect);
}

std::vector<std::size_t> shapes_of(const Family& family) {
  std::vector<std::size_t> shapes(family.count);
  std::iota(shapes.begin(), shapes.end(), family.first);
  shapes.insert(shapes.end(), family.more.begin(), family.more.end());
  return shapes;
}

BoundInputs inputs_of(const Effect& effect, const std::vector<std::string>& names, const Series& data) {
  BoundInputs bound;
  bound.rows.time_s = data.time_s;
  std::size_t still = 0;
  bool whole = true;
  for (const std::string& name : names) {
    const Column& column = *find_column(data, name);
    bound.values.push_back(effect.level == Level::series ? input_values(data, column) : column.values);
    const std::vector<double>& values = bound.values.back();
    bound.has_gaps = bound.has_gaps || !is_whole(values);
    whole = whole && is_whole(values);
    if (effect.level == Level::series && is_constant(values)) still += column.role == Role::speed ? names.size() : 1;
  }
  bound.usable = whole && still == 0;
  bound.is_half = whole && still > 0 && still < names.size();
  for (const std::vector<double>& values : bound.values) bound.rows.inputs.emplace_back(values);
  return bound;
}

namespace {

// The points of the grid of a term's shapes on these rows, within its bounds, including held shapes that have a grid.
std::vector<std::vector<double>> shapes_of(const Effect& effect, const std::vector<Setting>& settings,
                                           const EffectRows& rows, const SignatureOptions& options) {
  std::vector<double> first;
  for (std::size_t k = 0; k < effect.parameters.size(); ++k) {
    const bool is_gain = effect.parameters[k].kind == ParameterKind::gain;
    first.push_back(is_gain ? 0.0 : std::clamp(effect.parameters[k].start, settings[k].lower, settings[k].upper));
  }
  std::vector<std::vector<double>> points{first};
  for (std::size_t k = 0; k < effect.parameters.size(); ++k) {
    const Parameter& parameter = effect.parameters[k];
    if (parameter.kind == ParameterKind::gain || (parameter.held && parameter.grid.empty())) continue;
    const std::size_t most = effect.level == Level::series ? kMostPeriods : kMostWaves;
    std::vector<double> grid = grid_of(parameter, rows, settings[k].lower, settings[k].upper, most);
    if (parameter.shape_of == ShapeOf::onset) grid = onsets(rows);
    if (grid.empty()) continue;
    std::erase_if(grid, [&](double value) { return frequency_Hz(parameter, value) > options.highest_Hz; });
    std::vector<std::vector<double>> more;
    for (const std::vector<double>& point : points) {
      for (const double value : grid) {
        more.push_back(point);
        more.back()[k] = value;
      }
    }
    points = std::move(more);
  }
  return points;
}

// An effect on columns, with the columns of each of its shapes.
struct EffectShapes {
  Family family;
  BoundInputs bound;
  std::vector<std::vector<double>> points;
  std::vector<std::vector<Eigen::VectorXd>> gains;  // of each point
};

// The points with held shapes at their held values, each point once.
std::vector<std::vector<double>> as_held(std::vector<std::vector<double>> points, const Term& term) {
  for (std::vector<double>& point : points) {
    for (std::size_t k = 0; k < point.size(); ++k) {
      const bool is_gain = term.effect->parameters[k].kind == ParameterKind::gain;
      if (!is_gain && term.settings[k].held) point[k] = term.settings[k].start;
    }
  }
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return points;
}

// Whether an effect of two columns has the same quantity in both: it would be one of that quantity alone.
bool has_equal_inputs(const BoundInputs& bound) {
  if (bound.values.size() != 2 || bound.is_half) return false;
  constexpr double kRounding = 1e-9;
  std::vector<Eigen::ArrayXd> about_mean;
  for (const std::vector<double>& values : bound.values) {
    const auto all = Eigen::ArrayXd::Map(values.data(), static_cast<Eigen::Index>(values.size()));
    about_mean.emplace_back(all - all.mean());
  }
  const double norms = about_mean[0].matrix().norm() * about_mean[1].matrix().norm();
  return std::abs((about_mean[0] * about_mean[1]).sum()) > (1.0 - kRounding) * norms;
}

std::vector<EffectShapes> effect_shapes_of(const Catalogue& catalogue, const Model& model, const Series& data,
                                           const SignatureOptions& options) {
  std::vector<EffectShapes> result;
  for (const Term& term : options.terms) {
    BoundInputs bound = inputs_of(*term.effect, term.columns, data);
    if (!bound.usable && !bound.is_half) continue;
    EffectShapes one{{{term.effect.get(), term.columns}, 0, 0}, std::move(bound), {}, {}};
    one.points = as_held(shapes_of(*term.effect, term.settings, one.bound.rows, options), term);
    one.gains.resize(one.points.size());
    result.push_back(std::move(one));
  }
  const auto is_given = [&](const Effect& effect, const std::vector<std::string>& names) {
    return std::any_of(options.terms.begin(), options.terms.end(),
                       [&](const Term& term) { return term.effect->name == effect.name && term.columns == names; });
  };
  for (const auto& effect : catalogue) {
    if (effect->level != model.level || effect->rules.is_base) continue;
    if (options.motion && !applies_to(*effect, *options.motion)) continue;
    if (!data.has_clock && needs_clock(*effect)) continue;
    if (!is_resolved(*effect, options.highest_Hz)) continue;
    if (options.causes_only && describes_drift(*effect)) continue;
    if (std::find(options.without.begin(), options.without.end(), effect->name) != options.without.end()) continue;
    const std::vector<Setting> usual = term_of(*effect, {}).settings;
    for (std::vector<std::string>& names : bindings_of(*effect, model, data)) {
      if (has_term(model, *effect, names) && !effect->rules.may_repeat) continue;
      if (is_given(*effect, names)) continue;
      BoundInputs bound = inputs_of(*effect, names, data);
      if ((!bound.usable && !bound.is_half) || has_equal_inputs(bound)) continue;
      EffectShapes one{{{effect.get(), std::move(names)}, 0, 0}, std::move(bound), {}, {}};
      one.points = shapes_of(*effect, usual, one.bound.rows, options);
      one.gains.resize(one.points.size());
      result.push_back(std::move(one));
    }
  }
  return result;
}

void evaluate(std::vector<EffectShapes>& all, const std::vector<std::size_t>& rows) {
  std::vector<std::pair<EffectShapes*, std::size_t>> parts;
  for (EffectShapes& one : all) {
    for (std::size_t i = 0; i < one.points.size(); ++i) parts.emplace_back(&one, i);
  }
  in_parallel(parts.size(), [&](std::size_t k) {
    auto& [one, i] = parts[k];
    const Effect& effect = *one->family.bound.effect;
    std::vector<Eigen::VectorXd> gains = gains_of(effect, one->bound.rows, one->points[i], rows);
    if (gains.empty() || is_same_as_input(effect, one->bound.rows, rows, gains.front())) return;
    if (one->bound.is_half && gains.size() < gain_count(effect)) return;
    one->gains[i] = std::move(gains);
  });
}

}  // namespace

SignatureLibrary signature_library_of(const Catalogue& catalogue, const Model& model, const Series& data,
                                      const Fit& fit, SignatureOptions options) {
  options.highest_Hz = highest_Hz(fit.time_s);
  std::vector<EffectShapes> all = effect_shapes_of(catalogue, model, data, options);
  evaluate(all, fit.row);
  SignatureLibrary library;
  std::vector<Eigen::VectorXd> columns;
  for (EffectShapes& one : all) {
    one.family.first = library.signatures.size();
    for (std::size_t i = 0; i < one.points.size(); ++i) {
      std::vector<Eigen::VectorXd>& gains = one.gains[i];
      if (gains.empty()) continue;
      Signature signature{library.families.size(), std::move(one.points[i]), static_cast<Eigen::Index>(columns.size()),
                          static_cast<Eigen::Index>(gains.size()), gains.front().maxCoeff() - gains.front().minCoeff()};
      for (Eigen::VectorXd& gain : gains) columns.push_back(std::move(gain));
      library.signatures.push_back(std::move(signature));
      ++one.family.count;
    }
    if (one.family.count > 0) library.families.push_back(std::move(one.family));
  }
  library.columns.resize(static_cast<Eigen::Index>(fit.row.size()), static_cast<Eigen::Index>(columns.size()));
  for (std::size_t k = 0; k < columns.size(); ++k) library.columns.col(static_cast<Eigen::Index>(k)) = columns[k];
  return library;
}

SignatureProjection signature_projection(const SignatureLibrary& library, const Eigen::MatrixXd& basis,
                                         const Whitening& whitening) {
  constexpr std::size_t kTogether = 64;  // signatures
  SignatureProjection result;
  const Eigen::MatrixXd model = orthonormal(whitened(whitening, basis));
  result.columns.resize(library.columns.rows(), library.columns.cols());
  const std::size_t count = library.signatures.size();
  result.share.resize(count);
  result.norm.resize(count);
  in_parallel((count + kTogether - 1) / kTogether, [&](std::size_t batch) {
    const std::size_t begin = batch * kTogether, end = std::min(count, begin + kTogether);
    const Signature &front = library.signatures[begin], &back = library.signatures[end - 1];
    const Eigen::Index first = front.first, width = back.first + back.width - first;
    const Eigen::MatrixXd all = whitened(whitening, library.columns.middleCols(first, width));
    result.columns.middleCols(first, width) = orthogonal_part(all, model);
    for (std::size_t k = begin; k < end; ++k) {
      const Signature& signature = library.signatures[k];
      const Eigen::MatrixXd own = all.middleCols(signature.first - first, signature.width);
      const Eigen::RowVectorXd before = own.colwise().squaredNorm();
      const Eigen::RowVectorXd left =
          orthonormalise(result.columns.middleCols(signature.first, signature.width), before, kNothingLeft);
      result.norm[k] = std::sqrt(left[0]);
      result.share[k] = 1.0;
      for (Eigen::Index j = 0; j < signature.width; ++j) {
        result.share[k] = std::min(result.share[k], before[j] > 0.0 ? left[j] / before[j] : 0.0);
      }
    }
  });
  return result;
}

double detectable_um(const SignatureLibrary& library, const SignatureProjection& projected, std::size_t signature,
                     double d) {
  if (projected.share[signature] < kAbsorbed) return std::numeric_limits<double>::infinity();
  return d * library.signatures[signature].range_um / projected.norm[signature];
}

}  // namespace ballbar
