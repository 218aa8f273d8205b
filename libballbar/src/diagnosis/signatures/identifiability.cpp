#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "ballbar/diagnosis/signatures/search.hpp"
#include "ballbar/internal/numerics/order_statistic.hpp"
#include "ballbar/internal/numerics/parallel.hpp"
#include "diagnosis/signatures/signature_library.hpp"
#include "diagnosis/signatures/thresholds.hpp"
#include "fit/model_columns.hpp"
#include "model/bindings.hpp"
#include "model/resolved_periods.hpp"
#include "noise/whitening.hpp"
#include "series/subsampled.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kComparedShapes = 12;  // of one family, compared with those of the others
constexpr double kInseparable = 0.95;        // coherence of two inseparable effects

auto block(const SignatureProjection& projection, const Signature& signature) {
  return projection.columns.middleCols(signature.first, signature.width);
}

// Smallest canonical correlation: 1 if one space contains the other.
double coherence(const Eigen::MatrixXd& between) {
  if (between.size() == 1) return std::abs(between(0, 0));
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(between);
  return svd.singularValues()[svd.singularValues().size() - 1];
}

std::vector<std::size_t> some_shapes(const Family& family) {
  std::vector<std::size_t> shapes;
  const std::size_t stride = 1 + (family.count - 1) / kComparedShapes;
  for (std::size_t i = family.first; i < family.first + family.count; i += stride) shapes.push_back(i);
  return shapes;
}

// The lower median, over the shapes of `a`, of the largest coherence with a shape of `b`.
double imitated(const SignatureLibrary& library, const SignatureProjection& projection, const Family& a,
                const Family& b) {
  std::vector<double> largest;
  const std::vector<std::size_t> others = some_shapes(b);
  for (const std::size_t mine : some_shapes(a)) {
    if (projection.share[mine] < kAbsorbed) continue;
    double most = 0.0;
    for (const std::size_t other : others) {
      if (projection.share[other] < kAbsorbed) continue;
      const Signature &one = library.signatures[mine], &two = library.signatures[other];
      most = std::max(most, coherence(block(projection, one).transpose().lazyProduct(block(projection, two))));
    }
    largest.push_back(most);
  }
  if (largest.empty()) return 0.0;
  const std::size_t lower = (largest.size() - 1) / 2;
  return std::min(1.0, order_statistic(std::move(largest), lower));
}

// Range of the effect with d = 1, for the most detectable shape.
double um_for_unit_d(const SignatureLibrary& library, const SignatureProjection& projection, const Family& family) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = family.first; i < family.first + family.count; ++i) {
    least = std::min(least, detectable_um(library, projection, i, 1.0));
  }
  return least;
}

bool takes(const Input& input, const Column& column) {
  return input.units.empty() ||
         std::find(input.units.begin(), input.units.end(), unit_of(column.name)) != input.units.end();
}

// Of an effect without a binding.
Deficiency missing_inputs_of(const Effect& effect, const Series& data) {
  Deficiency deficiency;
  for (const Input& input : effect.inputs) {
    const bool any = std::any_of(data.columns.begin(), data.columns.end(),
                                 [&](const Column& column) { return takes(input, column); });
    if (!any) deficiency.missing_inputs.push_back({input.role, input.units});
  }
  if (!deficiency.missing_inputs.empty()) return deficiency;
  const auto first = std::find_if(effect.inputs.begin(), effect.inputs.end(),
                                  [](const Input& input) { return !input.none_accepted.empty(); });
  if (first != effect.inputs.end()) deficiency.none_accepted = first->none_accepted;
  return deficiency;
}

// Why an effect that has columns is not in the signature library.
void judge_unusable(Detectability& detectable, const Model& model, const Series& data,
                    const std::vector<std::vector<std::string>>& bindings) {
  const auto in_model = [&](const std::vector<std::string>& names) {
    return has_term(model, *detectable.effect, names);
  };
  if (std::all_of(bindings.begin(), bindings.end(), in_model)) {
    detectable.testability = Testability::in_the_model;
    return;
  }
  const bool usable = std::any_of(bindings.begin(), bindings.end(), [&](const std::vector<std::string>& names) {
    return inputs_of(*detectable.effect, names, data).usable;
  });
  if (usable) {
    detectable.testability = Testability::absorbed;
    return;
  }
  detectable.testability = Testability::input_constant;
  detectable.deficiency.has_gaps = std::any_of(
      bindings.begin(), bindings.end(),
      [&](const std::vector<std::string>& names) { return inputs_of(*detectable.effect, names, data).has_gaps; });
}

}  // namespace

std::vector<Detectability> detectability_of(const Catalogue& catalogue, const SignatureLibrary& library,
                                            const SignatureProjection& projection, const Model& model,
                                            const Series& data, std::optional<Motion> motion,
                                            std::span<const double> time_s) {
  const double rate_Hz = highest_Hz(time_s);
  std::vector<Detectability> detectability;
  std::vector<const Family*> best;
  for (const auto& effect : catalogue) {
    if (effect->level != model.level || effect->rules.is_base) continue;
    Detectability detectable;
    detectable.effect = effect.get();
    const Family* chosen = nullptr;
    double least = std::numeric_limits<double>::infinity();
    const std::vector<std::vector<std::string>> bindings = bindings_of(*effect, model, data);
    detectable.bindings = count_of_bindings(*effect, model, data);
    detectable.searched = bindings.size();
    for (const Family& family : library.families) {
      if (family.bound.effect != effect.get()) continue;
      const double um = um_for_unit_d(library, projection, family);
      if (chosen == nullptr || um < least) chosen = &family;
      least = std::min(least, um);
    }
    if (!data.has_clock && needs_clock(*effect)) {
      detectable.testability = Testability::no_clock;
    } else if (!is_resolved(*effect, rate_Hz)) {
      detectable.testability = Testability::rows_too_far_apart;
      detectable.deficiency.step_s = 0.5 / rate_Hz;
      detectable.deficiency.period_s = usual_period_s(*effect);
    } else if (motion && !applies_to(*effect, *motion)) {
      detectable.testability = Testability::other_motion;
      detectable.deficiency.motion = motion;
    } else if (bindings.empty()) {
      detectable.testability = Testability::input_missing;
      detectable.deficiency = missing_inputs_of(*effect, data);
    } else if (chosen == nullptr) {
      judge_unusable(detectable, model, data, bindings);
    } else if (!std::isfinite(least)) {
      detectable.testability = Testability::absorbed;
    } else {
      detectable.columns = chosen->bound.columns;
      detectable.detectable_um = kDetectable * least;
      detectable.identifiable_um = kIdentifiable * least;
      for (std::size_t i = chosen->first; i < chosen->first + chosen->count; ++i) {
        detectable.surviving_share = std::max(detectable.surviving_share, projection.share[i]);
      }
    }
    best.push_back(detectable.testability == Testability::testable ? chosen : nullptr);
    detectability.push_back(std::move(detectable));
  }
  in_parallel(best.size(), [&](std::size_t i) {
    for (std::size_t j = 0; j < best.size(); ++j) {
      if (i == j || best[i] == nullptr || best[j] == nullptr) continue;
      const std::string& name = detectability[j].effect->name;
      detectability[i].imitated_by.push_back({name, imitated(library, projection, *best[i], *best[j])});
      if (detectability[i].imitated_by.back().coherence > kInseparable)
        detectability[i].inseparable_from.push_back(name);
    }
  });
  return detectability;
}

Preflight preflight(const Model& model, const Series& data, std::size_t target, std::optional<Motion> motion,
                    const Catalogue& catalogue) {
  const Series rows = subsampled(data, model.targets.at(target), kMostTested);
  const Fit fitted = fit(model, rows, target);
  Preflight result;
  result.target = fitted.target;
  const std::vector<double>& values = find_column(data, fitted.target)->values;
  result.n = static_cast<std::size_t>(
      std::count_if(values.begin(), values.end(), [](double value) { return !std::isnan(value); }));
  result.noise = fitted.noise;
  result.noise_source = model.terms.empty() ? NoiseSource::target : NoiseSource::residual;
  SignatureOptions options;
  options.motion = motion;
  const SignatureLibrary library = signature_library_of(catalogue, model, rows, fitted, options);
  const SignatureProjection projection =
      signature_projection(library, model_columns(fitted), Whitening(fitted.noise, fitted.time_s, fitted.sigma_um));
  result.detectability = detectability_of(catalogue, library, projection, model, rows, motion, fitted.time_s);
  return result;
}

}  // namespace ballbar
