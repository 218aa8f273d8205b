#include "ballbar/identifiability.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>

#include "ballbar/trace.hpp"
#include "model_rows.hpp"
#include "series_cost.hpp"
#include "shape_grid.hpp"

namespace ballbar {
namespace {

constexpr double kAbsorbed = 0.05;
constexpr double kInseparable = 0.95;
constexpr double kDetectable = 5.0;
constexpr double kIdentifiable = 7.5;
constexpr std::size_t kMostShapes = 12;    // of one binding
constexpr std::size_t kMostBindings = 64;  // of one effect
constexpr Eigen::Index kMostRows = 1500;   // signatures are smooth: thinned after whitening, rescaled

// What one point of the shape grid adds: whitened and freed of the model, its orthonormal basis.
struct Signature {
  Eigen::MatrixXd basis;  // thinned rows by gains, orthonormal
  double surviving_share = 0.0;
  double um_for_unit_d = 0.0;  // range of the effect with d = 1
};

struct Binding {
  std::vector<std::string> columns;
  std::vector<Signature> signatures;
};

class Stage {
 public:
  Stage(const Series& data, const Fit& fit)
      : data_(data),
        rows_(fit.row),
        weighting_{Eigen::VectorXd::Ones(static_cast<Eigen::Index>(fit.row.size())),
                   Whitening(fit.noise, fit.time_s, fit.sigma_um)} {
    stride_ = 1 + static_cast<Eigen::Index>(fit.row.size()) / kMostRows;
    std::vector<Eigen::Index> used;
    for (std::size_t k = 0; k < fit.parameters.size(); ++k) {
      const ParameterState state = fit.parameters[k].state;
      const auto index = static_cast<Eigen::Index>(k);
      if (state != ParameterState::held && fit.jacobian.col(index).norm() > 0.0) used.push_back(index);
    }
    Eigen::MatrixXd jacobian(fit.jacobian.rows(), static_cast<Eigen::Index>(used.size()));
    for (std::size_t j = 0; j < used.size(); ++j) {
      jacobian.col(static_cast<Eigen::Index>(j)) = fit.jacobian.col(used[j]).normalized();
    }
    model_basis_ = orthonormal(weighted(weighting_, jacobian));
  }

  std::optional<Signature> signature(const Effect& effect, const EffectRows& inputs,
                                     const std::vector<double>& point) const {
    const std::size_t count = effect.parameters.size();
    std::vector<double> values(data_.time_s.size()), slopes(values.size() * count);
    effect.evaluate(inputs, point.data(), values.data(), slopes.data());
    const auto n = static_cast<Eigen::Index>(rows_.size());
    std::vector<Eigen::VectorXd> gains;
    for (std::size_t k = 0; k < count; ++k) {
      if (effect.parameters[k].kind != ParameterKind::gain) continue;
      Eigen::VectorXd column(n);
      for (Eigen::Index i = 0; i < n; ++i) column[i] = slopes[rows_[static_cast<std::size_t>(i)] * count + k];
      if (!column.allFinite() || column.maxCoeff() - column.minCoeff() < 1e-12) continue;
      gains.push_back(std::move(column));
    }
    if (gains.empty()) return std::nullopt;
    Eigen::MatrixXd raw(n, static_cast<Eigen::Index>(gains.size()));
    for (std::size_t k = 0; k < gains.size(); ++k) raw.col(static_cast<Eigen::Index>(k)) = gains[k];
    const Eigen::MatrixXd whitened = weighted(weighting_, raw);
    const Eigen::MatrixXd left = whitened - model_basis_ * (model_basis_.transpose() * whitened);
    // The weakest direction of the gains: what they could add there for a unit of d.
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(left, Eigen::ComputeThinU | Eigen::ComputeThinV);
    const Eigen::Index last = svd.singularValues().size() - 1;
    const Eigen::VectorXd weakest = svd.matrixV().col(last);
    const Eigen::VectorXd added = raw * weakest;
    Signature result;
    const double all = (whitened * weakest).squaredNorm();
    result.surviving_share =
        all > 0.0 ? std::min(1.0, svd.singularValues()[last] * svd.singularValues()[last] / all) : 0.0;
    result.um_for_unit_d = (added.maxCoeff() - added.minCoeff()) / std::max(svd.singularValues()[last], 1e-300);
    Eigen::MatrixXd thin((n + stride_ - 1) / stride_, left.cols());
    for (Eigen::Index i = 0; i < thin.rows(); ++i) thin.row(i) = left.row(i * stride_);
    result.basis = orthonormal(thin);
    return result;
  }

 private:
  static Eigen::MatrixXd orthonormal(const Eigen::MatrixXd& columns) {
    if (columns.cols() == 0) return columns;
    const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(columns);
    return Eigen::MatrixXd(qr.householderQ() * Eigen::MatrixXd::Identity(columns.rows(), qr.rank()));
  }

  const Series& data_;
  const std::vector<std::size_t>& rows_;
  Weighting weighting_;
  Eigen::Index stride_ = 1;
  Eigen::MatrixXd model_basis_;
};

bool accepts(const Input& input, const Column& column) {
  const std::string_view unit = unit_of(column.name);
  return std::find(input.units.begin(), input.units.end(), unit) != input.units.end();
}

// All choices of different columns for the inputs, target and sigmas left out; on recordings the trace's own.
std::vector<std::vector<std::string>> bindings_of(const Effect& effect, const Model& model, const Series& data) {
  std::vector<std::vector<std::string>> bindings{{}};
  for (const Input& input : effect.inputs) {
    std::vector<std::vector<std::string>> more;
    for (const Column& column : data.columns) {
      const bool own = effect.level == Level::recording
                           ? column.name == trace_column(input.role)
                           : accepts(input, column) && column.name.find("_sigma_") == std::string::npos;
      const bool target = std::find(model.targets.begin(), model.targets.end(), column.name) != model.targets.end();
      if (!own || target) continue;
      for (const std::vector<std::string>& binding : bindings) {
        if (std::find(binding.begin(), binding.end(), column.name) != binding.end()) continue;
        more.push_back(binding);
        more.back().push_back(column.name);
        if (more.size() == kMostBindings) break;
      }
      if (more.size() == kMostBindings) break;
    }
    bindings = std::move(more);
  }
  return bindings;
}

std::vector<std::vector<double>> shapes_of(const Effect& effect, const EffectRows& rows) {
  std::vector<double> first;
  for (const Parameter& parameter : effect.parameters) first.push_back(parameter.start);
  std::vector<std::vector<double>> points{first};
  for (std::size_t k = 0; k < effect.parameters.size(); ++k) {
    const Parameter& parameter = effect.parameters[k];
    if (parameter.kind == ParameterKind::gain || parameter.held) continue;
    std::vector<double> grid = shape_grid(effect, k, rows, parameter.lower, parameter.upper, kMostShapes);
    if (parameter.name == "onset_s") {
      for (int part = 1; part < 8; ++part) {
        grid.push_back(rows.time_s.front() + part * (rows.time_s.back() - rows.time_s.front()) / 8.0);
      }
    }
    if (grid.empty() || points.size() * grid.size() > 4 * kMostShapes) continue;
    std::vector<std::vector<double>> more;
    for (const std::vector<double>& point : points) {
      for (const double value : grid) {
        more.push_back(point);
        more.back()[k] = value;
      }
    }
    points = std::move(more);
  }
  if (points.size() <= kMostShapes) return points;
  std::vector<std::vector<double>> some;
  for (std::size_t i = 0; i < kMostShapes; ++i) some.push_back(points[i * points.size() / kMostShapes]);
  return some;
}

bool is_constant(const std::vector<double>& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return !(*high > *low);
}

// Smallest canonical correlation: 1 where one space holds the other.
double coherence(const Signature& a, const Signature& b) {
  if (a.basis.cols() == 0 || b.basis.cols() == 0) return 0.0;
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(Eigen::MatrixXd(a.basis.transpose() * b.basis));
  return svd.singularValues()[svd.singularValues().size() - 1];
}

// Whether most of the shapes of `a` can be imitated by some shape of `b`.
bool imitated(const Binding& a, const Binding& b) {
  std::size_t alike = 0, counted = 0;
  for (const Signature& mine : a.signatures) {
    if (mine.surviving_share < kAbsorbed) continue;
    ++counted;
    const bool found = std::any_of(b.signatures.begin(), b.signatures.end(), [&](const Signature& other) {
      return other.surviving_share >= kAbsorbed && coherence(mine, other) > kInseparable;
    });
    if (found) ++alike;
  }
  return counted > 0 && 2 * alike > counted;
}

double smallest_um(const Binding& binding) {
  double least = std::numeric_limits<double>::infinity();
  for (const Signature& signature : binding.signatures) {
    if (signature.surviving_share >= kAbsorbed) least = std::min(least, signature.um_for_unit_d);
  }
  return least;
}

bool has_term(const Model& model, const Effect& effect, const std::vector<std::string>& columns) {
  return std::any_of(model.terms.begin(), model.terms.end(),
                     [&](const Term& term) { return term.effect->name == effect.name && term.columns == columns; });
}

std::string roles_missing(const Effect& effect, const Series& data) {
  std::vector<std::string> missing;
  for (const Input& input : effect.inputs) {
    const bool any = std::any_of(data.columns.begin(), data.columns.end(),
                                 [&](const Column& column) { return accepts(input, column); });
    if (!any) missing.push_back(fmt::format("{} ({})", input.role, fmt::join(input.units, " or ")));
  }
  return missing.empty() ? "there are too few columns of the kind"
                         : fmt::format("no column for {}", fmt::join(missing, ", "));
}

}  // namespace

Preflight preflight(const Model& model, const Series& data, std::size_t target, std::optional<Motion> motion) {
  const Fit fitted = fit(model, data, target);
  Preflight result;
  result.target = fitted.target;
  result.n = fitted.row.size();
  result.noise = fitted.noise;
  result.noise_source = model.terms.empty() ? "target about its mean: every effect that is there counts as noise"
                                            : "residual of the model";
  const Stage stage(data, fitted);
  std::vector<Binding> best;  // as result.prospects
  for (const Effect* effect : effects()) {
    if (effect->level != model.level) continue;
    Prospect prospect;
    prospect.effect = effect;
    if (motion && !applies_to(*effect, *motion)) {
      prospect.testability = Testability::other_motion;
      prospect.why = fmt::format("it is not one of circles driven by {}", name_of(*motion));
      result.prospects.push_back(std::move(prospect));
      best.emplace_back();
      continue;
    }
    Binding chosen;
    double least = std::numeric_limits<double>::infinity();
    bool varying = effect->inputs.empty();
    bool all_in_the_model = true;
    for (const std::vector<std::string>& columns : bindings_of(*effect, model, data)) {
      ++prospect.bindings;
      if (has_term(model, *effect, columns)) continue;
      all_in_the_model = false;
      EffectRows inputs;
      inputs.time_s = data.time_s;
      bool constant = false, whole = true;
      for (const std::string& name : columns) {
        const Column& column = *find_column(data, name);
        whole =
            whole && std::all_of(column.values.begin(), column.values.end(), [](double v) { return std::isfinite(v); });
        constant = constant || (effect->level == Level::series && is_constant(column.values));
        inputs.inputs.emplace_back(column.values);
      }
      if (constant || !whole) continue;
      varying = true;
      Binding binding{columns, {}};
      for (const std::vector<double>& point : shapes_of(*effect, inputs)) {
        auto signature = stage.signature(*effect, inputs, point);
        if (signature) binding.signatures.push_back(std::move(*signature));
      }
      const double um = smallest_um(binding);
      if (um < least || chosen.signatures.empty()) {
        least = std::min(least, um);
        chosen = std::move(binding);
      }
    }
    if (prospect.bindings == 0) {
      prospect.testability = Testability::input_missing;
      prospect.why = roles_missing(*effect, data);
    } else if (all_in_the_model) {
      prospect.testability = Testability::in_the_model;
      prospect.why = "it is in the model";
    } else if (!varying) {
      prospect.testability = Testability::input_constant;
      prospect.why = "its input does not change, or has gaps";
    } else if (!std::isfinite(least)) {
      prospect.testability = Testability::absorbed;
      prospect.why = "what it adds is made by the model already";
      chosen.signatures.clear();
    } else {
      prospect.columns = chosen.columns;
      prospect.detectable_um = kDetectable * least;
      prospect.identifiable_um = kIdentifiable * least;
      for (const Signature& signature : chosen.signatures) {
        prospect.surviving_share = std::max(prospect.surviving_share, signature.surviving_share);
      }
    }
    result.prospects.push_back(std::move(prospect));
    best.push_back(std::move(chosen));
  }
  for (std::size_t i = 0; i < best.size(); ++i) {
    for (std::size_t j = 0; j < best.size(); ++j) {
      if (i == j || result.prospects[j].testability != Testability::testable) continue;
      if (result.prospects[i].testability != Testability::testable) continue;
      if (imitated(best[i], best[j])) result.prospects[i].inseparable_from.push_back(result.prospects[j].effect->name);
    }
  }
  return result;
}

}  // namespace ballbar
