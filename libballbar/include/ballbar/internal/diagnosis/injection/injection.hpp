// Injection tests: add a known effect to measured data and see whether a diagnosis detects it.
//
// The effect is evaluated on the rows of the data and added to the target. The noise and everything else in the data
// stay as they are.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "ballbar/diagnosis/verdict/diagnose.hpp"
#include "ballbar/fit/fit.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

struct Injection {
  BoundEffect bound;
  std::vector<double> parameters;  // as bound.effect->parameters
};

// The effect at the start values of its shapes, with its first gain 1 and all others 0. An onset that starts at 0 moves
// to the middle of the data, because a step in the first row is a constant.
Injection injection_of(const BoundEffect& bound, const Series& data);

// The values of the injected effect in um, one per row of the data. Throws Error where a column is missing, has gaps or
// is constant.
std::vector<double> signal_of(const Injection& injection, const Series& data);

// The data with the effect added to the target, scaled so that its range (max - min) is `amplitude_um`. Gaps stay gaps.
// Throws Error where the effect is constant on these rows or the target does not exist.
Series injected(const Series& data, std::string_view target, const Injection& injection, double amplitude_um);

// The part of a signal g that the fitted model cannot absorb. W whitens by the noise; P projects onto the complement of
// the whitened Jacobian of the fit.
//   d = |P W g|   root of the expected fall of chi^2;   share = |P W g|^2 / |W g|^2
// signal_um: one value per row of the data.
struct Survival {
  std::vector<double> left;  // P W g, one value per row of the fit
  double d = 0.0;
  double share = 0.0;
};
Survival survival_of(std::span<const double> signal_um, const Fit& fit, const Noise& noise);

enum class Sight { named, probable, in_set, driver, candidate, unexplained, undetected };

// How a diagnosis reports an effect that is in the data: it names the effect (named), calls it probable (probable),
// lists it in a set of equivalent effects (in_set), reports a column that the effect reads as a driver (driver), has it
// unconfirmed in its best set (candidate), reports an unexplained remainder (unexplained), or reports nothing of it
// (undetected).
Sight sight_of(const Diagnosis& diagnosis, const BoundEffect& bound);
// "named", "probable", "in the reported set", "driver", "candidate", "unexplained", "not seen"
std::string_view name_of(Sight sight);
bool is_detected(Sight sight);  // named, probable or in_set

// Brackets the smallest amplitude (range of the signal, um) that is detected in the sense of is_detected().
struct DetectionLimit {
  double undetected_um = 0.0;  // largest amplitude tried that was not detected
  double detected_um = 0.0;    // smallest amplitude tried that was detected; infinite: none
  std::size_t diagnoses = 0;   // number of amplitudes tried
};

// Narrows the bracket `known` by at most 6 diagnoses of the model's first target, until both ends are within 15 %. The
// first amplitudes are those of d = 7.5 and d = 5 (d_per_um: d of 1 um), the next the geometric mean of the bracket.
// Where nothing is detected the amplitude is doubled, up to three times. Detection need not be monotonic in the
// amplitude; the result is then one of several places where it changes.
DetectionLimit detection_limit(const Model& model, const Series& data, const Injection& injection, double d_per_um,
                               DetectionLimit known, const DiagnosisOptions& options,
                               const std::function<void(std::size_t)>& progress);

}  // namespace ballbar
