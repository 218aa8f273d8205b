#include "diagnosis/posterior/conditional_fit.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "diagnosis/evidence/shape_fit.hpp"

namespace ballbar {
namespace {

// A model with the set's effects as terms, and its parameters; their gains are those that a fit starts with anyway.
std::pair<Model, std::vector<double>> with_effects(const Problem& problem, Model model,
                                                   const std::vector<std::size_t>& signatures,
                                                   std::vector<double> parameters) {
  for (const std::size_t i : signatures) {
    const Signature& one = problem.library.signatures[i];
    const BoundEffect& bound = problem.library.families[one.family].bound;
    model.terms.push_back(term_of(problem, bound));
    for (std::size_t k = 0; k < one.point.size(); ++k) {
      Setting& setting = model.terms.back().settings[k];
      // An exponent that the catalogue holds lies between the points of its grid as well.
      const Parameter& parameter = bound.effect->parameters[k];
      if (parameter.held && parameter.grid.size() > 1 && given_term(problem, bound) == nullptr) setting.held = false;
      parameters.push_back(std::clamp(one.point[k], setting.lower, setting.upper));
    }
  }
  return {std::move(model), std::move(parameters)};
}

// The prior of a shape reaches as far as its grid: beyond it, a lag of nearly 0 would stand for the effect without one.
// A range that the user states is the prior.
double within_prior(const Parameter& parameter, const Setting* given, double value) {
  const bool is_stated = given != nullptr && (given->lower != parameter.lower || given->upper != parameter.upper);
  if (parameter.grid.size() < 2 || is_stated) return value;
  const auto [low, high] = std::minmax_element(parameter.grid.begin(), parameter.grid.end());
  return std::clamp(value, *low, *high);
}

enum class Shapes { held, free };

struct FitTogether {
  ShapeFit fit;
  Eigen::MatrixXd delays;  // of the inputs of both
};

// The model from these parameters together with the effects of the set, the shapes of these at their points or free.
FitTogether fit_together(const Problem& problem, const Linearisation& linearisation,
                         const std::vector<std::size_t>& signatures, const std::vector<double>& parameters,
                         const NoiseFilter& filter, Shapes shapes) {
  auto [model, start] = with_effects(problem, problem.model, signatures, parameters);
  for (std::size_t t = problem.model.terms.size(); t < model.terms.size() && shapes == Shapes::held; ++t) {
    Term& term = model.terms[t];
    for (std::size_t k = 0; k < term.settings.size(); ++k)
      term.settings[k].held = term.settings[k].held || term.effect->parameters[k].kind != ParameterKind::gain;
  }
  const BaseModel with(model, problem.logged, problem.y, problem.base.row);
  ShapeFit fit = shape_fit(with, start, free_of(problem, linearisation.freed), linearisation.open, filter.whitening,
                           problem.known, kSearched);
  Eigen::MatrixXd delays = with.delays_at(fit.parameters, problem.tuning, problem.model.terms.size());
  return {std::move(fit), std::move(delays)};
}

// The set, and the model where a fit of both has it.
ConditionalFit taken_over(const Problem& problem, std::vector<std::size_t> signatures, FitTogether fitted) {
  std::vector<double>& parameters = fitted.fit.parameters;
  parameters.resize(problem.base_model->parameters());
  return {std::move(signatures), std::move(parameters), std::move(fitted.delays)};
}

// The signatures of the set at the shapes that a fit has; new ones are added to the library.
std::vector<std::size_t> signatures_at(Problem& problem, std::vector<std::size_t> signatures,
                                       std::span<const double> fitted) {
  std::size_t place = 0;
  for (std::size_t& i : signatures) {
    const std::size_t family = problem.library.signatures[i].family;
    const std::vector<Parameter>& parameters = problem.library.families[family].bound.effect->parameters;
    const Term* given = given_term(problem, problem.library.families[family].bound);
    std::vector<double> shape = problem.library.signatures[i].point;
    bool moved = false;
    for (std::size_t k = 0; k < shape.size(); ++k, ++place) {
      if (parameters[k].kind == ParameterKind::gain) continue;
      const double value = within_prior(parameters[k], given != nullptr ? &given->settings[k] : nullptr, fitted[place]);
      moved = moved || std::abs(value - shape[k]) > problem.tuning.same_shape * std::abs(shape[k]);
      shape[k] = value;
    }
    if (moved) i = add_signature(problem, family, shape).value_or(i);
  }
  return signatures;
}

// The columns of a model as open columns. Those that are flat get a prior many times as wide as the readings; they are
// orthogonal under the filter, because nearly equal columns with such a prior would leave no digits.
Eigen::MatrixXd as_open(const LinearModel& model, const Whitening& whitening) {
  constexpr double kWide = 100.0, kNothingNew = 1e-10;
  std::vector<Eigen::Index> flat, others;
  for (std::size_t k = 0; k < model.is_flat.size(); ++k)
    (model.is_flat[k] != 0 ? flat : others).push_back(static_cast<Eigen::Index>(k) + 1);
  if (flat.empty()) return model.columns(Eigen::all, others);
  const Eigen::MatrixXd columns = model.columns(Eigen::all, flat), white = whitened(whitening, columns);
  const Eigen::VectorXd scale = white.colwise().norm().transpose().cwiseMax(1e-300).cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(scale.asDiagonal() * (white.transpose() * white) *
                                                             scale.asDiagonal());
  std::vector<Eigen::Index> kept;
  for (Eigen::Index k = 0; k < eigen.eigenvalues().size(); ++k)
    if (eigen.eigenvalues()[k] > kNothingNew) kept.push_back(k);
  const auto count = static_cast<Eigen::Index>(kept.size());
  const double wide = kWide * whitened(whitening, Eigen::VectorXd(model.columns.col(0))).norm();
  Eigen::MatrixXd result(columns.rows(), count + static_cast<Eigen::Index>(others.size()));
  result.leftCols(count) = wide * columns * scale.asDiagonal() * eigen.eigenvectors()(Eigen::all, kept) *
                           eigen.eigenvalues()(kept).cwiseSqrt().cwiseInverse().asDiagonal();
  result.rightCols(result.cols() - count) = model.columns(Eigen::all, others);
  return result;
}

}  // namespace

ConditionalFit conditional_fit(const Problem& problem, const Linearisation& linearisation,
                               const std::vector<std::size_t>& signatures, const NoiseFilter& filter) {
  return taken_over(problem, signatures,
                    fit_together(problem, linearisation, signatures, linearisation.parameters, filter, Shapes::held));
}

ConditionalFit sharpened(Problem& problem, const Linearisation& linearisation, std::vector<std::size_t> signatures,
                         const std::vector<std::vector<double>>& starts, const NoiseFilter& filter) {
  const Shapes shapes = problem.tuning.finer_shapes ? Shapes::free : Shapes::held;
  FitTogether best;
  for (const std::vector<double>& start : starts) {
    FitTogether fitted = fit_together(problem, linearisation, signatures, start, filter, shapes);
    if (best.fit.parameters.empty() || fitted.fit.square < (1.0 - problem.tuning.better_fit) * best.fit.square)
      best = std::move(fitted);
  }
  if (shapes == Shapes::free)
    signatures = signatures_at(problem, std::move(signatures),
                               std::span(best.fit.parameters).subspan(problem.base_model->parameters()));
  return taken_over(problem, std::move(signatures), std::move(best));
}

void sharpen_beside(Problem& problem, const LinearModel& beside, const std::vector<std::size_t>& signatures,
                    const NoiseFilter& filter) {
  if (!problem.tuning.finer_shapes) return;
  const Eigen::VectorXd y = beside.columns.col(0);
  const Eigen::MatrixXd open = as_open(beside, filter.whitening);
  Model nothing = problem.model;
  nothing.terms.clear();
  nothing.constant_um = 0.0;  // the columns have it
  for (const std::size_t signature : signatures) {
    auto [model, start] = with_effects(problem, nothing, {signature}, {0.0});
    const BaseModel alone(model, problem.logged, y, problem.base.row);
    const ShapeFit fitted = shape_fit(alone, std::move(start), {}, open, filter.whitening, problem.known, {50, 1e-9});
    signatures_at(problem, {signature}, std::span(fitted.parameters).subspan(1));
  }
}

}  // namespace ballbar
