// An effect put into data on purpose: could it have been seen there?
//
// What an effect adds is evaluated on the data's own rows and added to the target; a diagnosis of the result says
// whether it would be named. The data's own noise and everything else that is in them stay as they are.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "ballbar/diagnosis/verdict/diagnosis.hpp"
#include "ballbar/fit/fit.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

struct Injection {
  BoundEffect bound;
  std::vector<double> parameters;  // as bound.effect->parameters
};

// Shapes where the catalogue starts, the first gain 1 and any other 0. An onset that starts at 0 is put to the middle
// of the data: a step in the first row is a constant.
Injection injection_of(const BoundEffect& bound, const Series& data);

// What it adds, um, one a row of the data. Throws Error where a column is missing, has gaps or does not move.
std::vector<double> signal_of(const Injection& injection, const Series& data);

// The data with `amplitude_um` as the range of the signal added to the target; gaps stay. Throws Error where the signal
// does not move, or the target is not there.
Series injected(const Series& data, std::string_view target, const Injection& injection, double amplitude_um);

// The signal (one a row of the data) on the fit's rows, whitened by the noise and freed of the fit's Jacobian.
//   d = |P W g|  its norm: root of the expected fall of chi^2;   share = |P W g|^2 / |W g|^2
struct Survival {
  std::vector<double> left;  // P W g, one a row of the fit
  double d = 0.0;
  double share = 0.0;
};
Survival survival_of(std::span<const double> signal_um, const Fit& fit, const Noise& noise);

enum class Sight { named, probable, in_set, driver, candidate, unexplained, undetected };

// What a diagnosis makes of an effect that is there: it names it, calls it probable, has it in a set of equivalent
// ones, says that a column which the effect reads drives something, has it in its best set without confirming it, says
// that something unexplained is there, or sees nothing of it.
Sight sight_of(const Diagnosis& diagnosis, const BoundEffect& bound);
// "named", "probable", "in the reported set", "driver", "candidate", "unexplained", "not seen"
std::string_view name_of(Sight sight);
bool is_detected(Sight sight);  // by its name: named, probable or in a reported set

// Amplitudes (range of the signal, um) between which the smallest lies that is seen: named, probable or in a reported
// set.
struct DetectionLimit {
  double undetected_um = 0.0;  // the largest that was tried below
  double detected_um = 0.0;    // the smallest that was tried and seen; infinite: none
  std::size_t diagnoses = 0;
};

// Narrows what is `known` by at most 6 diagnoses of the model's first target with more and less of the signal, until
// the two are within 15 %: first at d = 7.5 and 5 (d_per_um: d of 1 um), then at their geometric mean; where nothing is
// seen, twice the amplitude, three times. Seeing need not grow with the amplitude everywhere; then it is one place
// where it changes.
DetectionLimit detection_limit(const Model& model, const Series& data, const Injection& injection, double d_per_um,
                               DetectionLimit known, const DiagnosisOptions& options,
                               const std::function<void(std::size_t)>& progress);

}  // namespace ballbar
