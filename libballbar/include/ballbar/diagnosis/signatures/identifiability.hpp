// What data could show, told before any residual is looked at.
//
// For every effect of a catalogue and every column it could read: its signature g (what a unit gain adds, at each
// point of its shape grid) is whitened by the noise, W g, and freed of all that the model can already make, the columns
// of W J. What survives decides:
//
//   surviving share   |P W g|^2 / |W g|^2;           below 0.05 the model absorbs the effect
//   d                 gain |P W g|                    root of the expected fall of chi^2
//   detectable        range (max - min) in um of an effect with d = 5; identifiable: d = 7.5
//   coherence         |cos| between the surviving signatures of two effects; above 0.95 at most of the shapes of one,
//                     whatever shape the other has, they are inseparable here
//
// An effect with several gains counts by the space they span: coherence by the smallest canonical correlation; d is
// that of its first. Of more than 1500 values of the target every
// second, third ... counts.
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
  rows_too_far_apart,  // to show the period of what repeats
};

// How well one effect imitates another: the coherence that half of the other's shapes reach at least, each with that
// shape of this effect which is most like it.
struct Likeness {
  std::string with;
  double coherence = 0.0;
};

struct Detectability {
  const Effect* effect = nullptr;
  std::vector<std::string> columns;  // of the best binding; empty where there is none
  std::size_t bindings = 0;          // choices of columns that the data offer
  std::size_t searched = 0;          // of these
  Testability testability = Testability::testable;
  std::string why;  // a phrase where it is not testable
  double surviving_share = 0.0;
  double detectable_um = 0.0;
  double identifiable_um = 0.0;
  std::vector<std::string> inseparable_from;  // names of effects that are not in the model
  std::vector<Likeness> imitated_by;          // every other testable effect
};

struct Preflight {
  std::string target;
  std::size_t n = 0;
  Noise noise;
  std::string noise_source;                  // a phrase: "residual of the model"
  std::vector<Detectability> detectability;  // in the order of the catalogue
};

// By the noise and the Jacobian of the model's fit. Without terms the model is a constant, and every effect that is
// there counts as noise, which is pessimistic. Throws Error as fit does. motion: what drove the recordings; effects of
// other motions do not apply.
Preflight preflight(const Model& model, const Series& data, std::size_t target = 0,
                    std::optional<Motion> motion = std::nullopt, const Catalogue& catalogue = built_in_catalogue());

}  // namespace ballbar
