// Which effects the data could show at all, judged before any residual is examined.
//
// For every effect of a catalogue and every column it could read, take its signature g: the curve of a unit gain, at
// each point of its shape grid. W whitens it by the noise. P removes the part that the model can already produce, the
// columns of W J. The remaining part P W g decides:
//
//   surviving share   |P W g|^2 / |W g|^2;           below 0.05 the model absorbs the effect
//   d                 gain |P W g|                    root of the expected fall of chi^2
//   detectable        range (max - min) in um of an effect with d = 5; identifiable: range with d = 7.5
//   coherence         |cos| between the remaining signatures of two effects. Two effects are inseparable in these data
//                     if it exceeds 0.95 at most shapes of one of them, with the best shape of the other.
//
// For an effect with several gains the coherence is the smallest canonical correlation of the spaces that they span,
// and d is that of the first gain. Of more than 1500 values of the target only every second, third ... is used.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ballbar/fit/fit.hpp"
#include "ballbar/model/model.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

enum class Testability {
  testable,
  input_missing,
  input_constant,
  absorbed,
  in_the_model,
  other_motion,
  no_clock,
  rows_too_far_apart,  // too far apart to resolve the period of a periodic effect
};

// An input for which the data have no column.
struct MissingInput {
  std::string role;
  std::vector<std::string> units;  // accepted; empty: any

  friend bool operator==(const MissingInput&, const MissingInput&) = default;
};

// What the data lack to show an effect. The facts of each testability are in its members; the others keep their default
// values.
struct Deficiency {
  // input_missing. Empty: columns of the units are there, but none is accepted, or they are too few.
  std::vector<MissingInput> missing_inputs = {};
  std::string none_accepted = {};     // input_missing: Input::none_accepted of the effect; empty: it has none
  bool has_gaps = false;              // input_constant: the input has gaps; else it does not change
  std::optional<Motion> motion = {};  // other_motion: of the recordings
  double step_s = 0.0;                // rows_too_far_apart: of the rows
  double period_s = 0.0;              // rows_too_far_apart: of the effect

  friend bool operator==(const Deficiency&, const Deficiency&) = default;
};

// How well one effect imitates another: the median over the other's shapes of the coherence with the most similar shape
// of this effect.
struct Likeness {
  std::string with;
  double coherence = 0.0;
};

struct Detectability {
  const Effect* effect = nullptr;
  std::vector<std::string> columns;  // of the best binding; empty: no binding
  std::size_t bindings = 0;          // number of column choices that the data offer
  std::size_t searched = 0;          // number of these that were searched
  Testability testability = Testability::testable;
  Deficiency deficiency;  // why it is not testable
  double surviving_share = 0.0;
  double detectable_um = 0.0;
  double identifiable_um = 0.0;
  std::vector<std::string> inseparable_from;  // names of effects that are not in the model
  std::vector<Likeness> imitated_by;          // every other testable effect
};

enum class NoiseSource {
  residual,  // of the model
  target,    // about its mean, of a model without terms: every real effect counts as noise
};

struct Preflight {
  std::string target;
  std::size_t n = 0;
  Noise noise;
  NoiseSource noise_source = NoiseSource::residual;
  std::vector<Detectability> detectability;  // in the order of the catalogue
};

// Uses the noise and the Jacobian of the model's fit. A model without terms is a constant; every real effect then
// counts as noise, which is pessimistic. Throws Error as fit() does. motion: what moved the ballbar in the recordings;
// effects of other motions do not apply.
Preflight preflight(const Model& model, const Series& data, std::size_t target = 0,
                    std::optional<Motion> motion = std::nullopt, const Catalogue& catalogue = built_in_catalogue());

}  // namespace ballbar
