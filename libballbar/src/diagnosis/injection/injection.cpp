#include "ballbar/internal/diagnosis/injection/injection.hpp"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "ballbar/error.hpp"
#include "ballbar/internal/numerics/range.hpp"
#include "diagnosis/signatures/signature_library.hpp"
#include "diagnosis/signatures/thresholds.hpp"
#include "fit/model_columns.hpp"
#include "noise/whitening.hpp"
#include "numerics/orthonormal.hpp"

namespace ballbar {

Injection injection_of(const BoundEffect& bound, const Series& data) {
  Injection injection{bound, {}};
  bool has_gain = false;
  for (const Parameter& parameter : bound.effect->parameters) {
    double value = parameter.start;
    if (parameter.kind == ParameterKind::gain) {
      value = has_gain ? 0.0 : 1.0;
      has_gain = true;
    }
    if (parameter.shape_of == ShapeOf::onset && value <= data.time_s.front()) {
      value = 0.5 * (data.time_s.front() + data.time_s.back());
    }
    injection.parameters.push_back(value);
  }
  return injection;
}

std::vector<double> signal_of(const Injection& injection, const Series& data) {
  const Effect& effect = *injection.bound.effect;
  for (const std::string& column : injection.bound.columns) {
    if (find_column(data, column) == nullptr) {
      throw Error(fmt::format("expected the column {} for {}, found none.", column, effect.name));
    }
  }
  const BoundInputs inputs = inputs_of(effect, injection.bound.columns, data);
  if (inputs.has_gaps) {
    throw Error(fmt::format("expected columns without gaps for {}, found a gap in them.", label_of(injection.bound)));
  }
  if (!inputs.usable) {
    throw Error(fmt::format("expected columns that change for {}, found constant ones.", label_of(injection.bound)));
  }
  std::vector<double> signal(data.time_s.size());
  effect.evaluate(inputs.rows, injection.parameters.data(), signal.data(), nullptr);
  return signal;
}

Series injected(const Series& data, std::string_view target, const Injection& injection, double amplitude_um) {
  std::vector<double> signal = signal_of(injection, data);
  const double range = range_of(signal);
  if (!(range > 0.0) || !std::isfinite(range)) {
    throw Error(fmt::format("expected {} to move on these data, found that with these shapes it does not.",
                            label_of(injection.bound)));
  }
  Series result = data;
  const auto at = std::find_if(result.columns.begin(), result.columns.end(),
                               [&](const Column& column) { return column.name == target; });
  if (at == result.columns.end()) throw Error(fmt::format("expected the column {}, found none.", target));
  for (std::size_t i = 0; i < signal.size(); ++i) at->values[i] += amplitude_um / range * signal[i];
  return result;
}

Survival survival_of(std::span<const double> signal_um, const Fit& fit, const Noise& noise) {
  const Whitening whitening(noise, fit.time_s, fit.sigma_um, fit.discounted);
  const Eigen::MatrixXd basis = orthonormal(whitened(whitening, model_columns(fit)));
  Eigen::VectorXd white(static_cast<Eigen::Index>(fit.row.size()));
  for (std::size_t i = 0; i < fit.row.size(); ++i) white[static_cast<Eigen::Index>(i)] = signal_um[fit.row[i]];
  whitening.apply(white.data(), 1, white.data(), 1);
  const Eigen::VectorXd left = orthogonal_part(white, basis);
  const double whole = white.squaredNorm();
  return {{left.begin(), left.end()}, left.norm(), whole > 0.0 ? left.squaredNorm() / whole : 0.0};
}

Sight sight_of(const Diagnosis& diagnosis, const BoundEffect& bound) {
  const auto holds = [&](const std::vector<BoundEffect>& bounds) {
    return std::find(bounds.begin(), bounds.end(), bound) != bounds.end();
  };
  if (holds(diagnosis.named)) return Sight::named;
  if (holds(diagnosis.probable)) return Sight::probable;
  if (std::any_of(diagnosis.equivalent.begin(), diagnosis.equivalent.end(), holds)) return Sight::in_set;
  const auto drives = [&](const Driver& driver) {
    return driver.p >= kSureDriver &&
           std::find(bound.columns.begin(), bound.columns.end(), driver.column) != bound.columns.end();
  };
  if (diagnosis.verdict == Verdict::driver && std::any_of(diagnosis.drivers.begin(), diagnosis.drivers.end(), drives))
    return Sight::driver;
  const auto is_best = [&](const Candidate& candidate) { return candidate.in_best_set && candidate.bound == bound; };
  const bool calls = diagnosis.verdict != Verdict::nothing && diagnosis.verdict != Verdict::untestable;
  if (calls && std::any_of(diagnosis.candidates.begin(), diagnosis.candidates.end(), is_best)) return Sight::candidate;
  return diagnosis.verdict == Verdict::unexplained ? Sight::unexplained : Sight::undetected;
}

std::string_view name_of(Sight sight) {
  constexpr std::string_view kNames[] = {"named",       "probable", "in the reported set", "driver", "candidate",
                                         "unexplained", "not seen"};
  return kNames[static_cast<std::size_t>(sight)];
}

bool is_detected(Sight sight) { return sight == Sight::named || sight == Sight::probable || sight == Sight::in_set; }

DetectionLimit detection_limit(const Model& model, const Series& data, const Injection& injection, double d_per_um,
                               DetectionLimit known, const DiagnosisOptions& options,
                               const std::function<void(std::size_t)>& progress) {
  constexpr double kClose = 1.15;
  constexpr int kMost = 6, kMostUpwards = 3;
  int upwards = 0;
  for (int tries = 0; tries < kMost && known.detected_um > kClose * known.undetected_um; ++tries) {
    const double detected_um = kDetectable / d_per_um, identified_um = kIdentifiable / d_per_um;
    double try_um = std::sqrt(known.undetected_um * known.detected_um);
    if (!std::isfinite(known.detected_um)) {
      if (++upwards > kMostUpwards) break;
      try_um = identified_um > 1.5 * known.undetected_um && std::isfinite(identified_um) ? identified_um
                                                                                         : 2.0 * known.undetected_um;
    } else if (known.undetected_um == 0.0) {
      try_um = detected_um < 0.9 * known.detected_um ? detected_um : 0.5 * known.detected_um;
    }
    progress(known.diagnoses + 1);
    const Diagnosis found = diagnose(model, injected(data, model.targets.front(), injection, try_um), 0, options);
    (is_detected(sight_of(found, injection.bound)) ? known.detected_um : known.undetected_um) = try_um;
    ++known.diagnoses;
  }
  return known;
}

}  // namespace ballbar
