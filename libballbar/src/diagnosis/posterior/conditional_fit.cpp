#include "diagnosis/posterior/conditional_fit.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "ballbar/diagnosis/thresholds.hpp"
#include "diagnosis/evidence/shape_fit.hpp"

namespace ballbar {
namespace {

constexpr Stop kStop{12, 1e-5};      // accuracy of a search
constexpr double kSameShape = 0.01;  // relative

// The model with the set's effects as terms, and its parameters.
std::pair<Model, std::vector<double>> with_effects(const Problem& problem, const ConditionalFit& conditional) {
  Model model = problem.model;
  std::vector<double> parameters = conditional.parameters;
  Eigen::Index column = 0;
  for (const std::size_t i : conditional.signatures) {
    const Signature& one = problem.library.signatures[i];
    const BoundEffect& bound = problem.library.families[one.family].bound;
    model.terms.push_back(term_of(problem, bound));
    Eigen::Index gain = 0;
    for (std::size_t k = 0; k < one.point.size(); ++k) {
      Setting& setting = model.terms.back().settings[k];
      // An exponent that the catalogue holds lies between the points of its grid as well.
      const Parameter& parameter = bound.effect->parameters[k];
      if (parameter.held && parameter.grid.size() > 1 && given_term(problem, bound) == nullptr) setting.held = false;
      if (bound.effect->parameters[k].kind != ParameterKind::gain || gain == one.width) {
        parameters.push_back(std::clamp(one.point[k], setting.lower, setting.upper));
        continue;
      }
      // A sharpened signature may have more gains than there are coefficients: any will do, it is linear.
      const bool known = column + gain < conditional.coefficients.size();
      parameters.push_back(known ? conditional.coefficients[column + gain] / problem.deviation[one.first + gain] : 0.0);
      ++gain;
    }
    column += one.width;
  }
  return {std::move(model), std::move(parameters)};
}

// The prior of a shape reaches as far as its grid: beyond it, a lag of nearly 0 would stand for the effect without one.
double within_grid(const Parameter& parameter, double value) {
  if (parameter.grid.size() < 2) return value;
  const auto [low, high] = std::minmax_element(parameter.grid.begin(), parameter.grid.end());
  return std::clamp(value, *low, *high);
}

enum class Shapes { held, free };

// The model and the effects of the set together, the shapes of these at their points or free.
ShapeFit fit_together(const Problem& problem, const Variant& variant, const ConditionalFit& conditional,
                      const Point& point, Shapes shapes) {
  auto [model, start] = with_effects(problem, conditional);
  for (std::size_t t = problem.model.terms.size(); t < model.terms.size() && shapes == Shapes::held; ++t) {
    Term& term = model.terms[t];
    for (std::size_t k = 0; k < term.settings.size(); ++k)
      term.settings[k].held = term.settings[k].held || term.effect->parameters[k].kind != ParameterKind::gain;
  }
  const BaseModel with(model, problem.logged, problem.y, problem.base.row);
  return shape_fit(with, start, free_of(problem, variant.own), variant.times, point.filter, problem.known, kStop);
}

// Of the columns of these signatures, from the parameters of their effects one after the other.
Eigen::VectorXd coefficients_of(const Problem& problem, const std::vector<std::size_t>& signatures,
                                std::span<const double> parameters) {
  std::vector<double> coefficients;
  std::size_t place = 0;
  for (const std::size_t i : signatures) {
    const Signature& signature = problem.library.signatures[i];
    Eigen::Index gain = 0;
    for (const Parameter& parameter : problem.library.families[signature.family].bound.effect->parameters) {
      const double value = parameters[place++];
      if (parameter.kind != ParameterKind::gain || gain == signature.width) continue;
      coefficients.push_back(value * problem.deviation[signature.first + gain++]);
    }
  }
  return Eigen::VectorXd::Map(coefficients.data(), static_cast<Eigen::Index>(coefficients.size()));
}

// The set and the model where a fit of both has them; its signatures stay as they are.
ConditionalFit taken_over(const Problem& problem, ConditionalFit conditional, const ShapeFit& fitted) {
  const std::size_t own = conditional.parameters.size();
  std::copy_n(fitted.parameters.begin(), own, conditional.parameters.begin());
  conditional.coefficients =
      coefficients_of(problem, conditional.signatures, std::span(fitted.parameters).subspan(own));
  conditional.square = fitted.square;
  return conditional;
}

// The signatures of the set at the shapes that a fit has; new ones are added to the library.
std::vector<std::size_t> signatures_at(Problem& problem, std::vector<std::size_t> signatures,
                                       std::span<const double> fitted) {
  std::size_t place = 0;
  for (std::size_t& i : signatures) {
    const std::size_t family = problem.library.signatures[i].family;
    const std::vector<Parameter>& parameters = problem.library.families[family].bound.effect->parameters;
    std::vector<double> shape = problem.library.signatures[i].point;
    bool moved = false;
    for (std::size_t k = 0; k < shape.size(); ++k, ++place) {
      if (parameters[k].kind == ParameterKind::gain) continue;
      const double value = within_grid(parameters[k], fitted[place]);
      moved = moved || std::abs(value - shape[k]) > kSameShape * std::abs(shape[k]);
      shape[k] = value;
    }
    if (moved) i = add_signature(problem, family, shape).value_or(i);
  }
  return signatures;
}

}  // namespace

ConditionalFit conditional_fit(const Problem& problem, const Variant& variant,
                               const std::vector<std::size_t>& signatures, const Point& point) {
  ConditionalFit conditional{signatures, variant.parameters, {}};
  const ShapeFit fitted = fit_together(problem, variant, conditional, point, Shapes::held);
  return taken_over(problem, std::move(conditional), fitted);
}

ConditionalFit sharpened(Problem& problem, const Variant& variant, ConditionalFit conditional, const Point& point) {
  if (!problem.tuning.finer_shapes) return conditional_fit(problem, variant, conditional.signatures, point);
  const ShapeFit fitted = fit_together(problem, variant, conditional, point, Shapes::free);
  conditional.signatures = signatures_at(problem, std::move(conditional.signatures),
                                         std::span(fitted.parameters).subspan(conditional.parameters.size()));
  return taken_over(problem, std::move(conditional), fitted);
}

}  // namespace ballbar
