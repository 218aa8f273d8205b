// Tests effects added to a model (workbench.hpp): before, after, and whether the data support them.
//
//   2 ln B             2 ln of how much more likely the readings are with an effect than without, its gains and shapes
//                      and the noise integrated out, as diagnose() weighs it (candidate.hpp)
//   P superfluous      of an effect of the model: 1 / (1 + B); it is needed below 0.05
//
// An added effect is supported if 2 ln B is at least 10, its gain is equal in all cycles (p >= 0.01), and it does not
// depend on time alone. The test assumes that the other effects of the most probable set of diagnose() with these
// effects are missing as well, so that both report the same figures; a large missing effect would otherwise hide a
// small one. If that set has another value of a held parameter, the test frees it. Earlier effects are tested without
// these assumptions. This is valid for an effect chosen before looking at these data. Use diagnose() to search the data
// for an effect. The shapes of the added effects start at their most likely values, so that a fit of the model equals
// the reported fit. For long series all figures but those of the ledger rows use every second, third ... value, as in
// diagnose().
//
// Errors of linear axes on recordings are tested together with all other errors of the axes: chi^2 replaces 2 ln B, and
// an error is needed if its p-value is below 0.001 (machine_errors.hpp).
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "ballbar/diagnosis/verdict/candidate.hpp"
#include "ballbar/fit/fit.hpp"
#include "ballbar/model/model.hpp"
#include "ballbar/revision/ledger.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

// The test of an effect of the model by leaving it out.
struct DropTest {
  std::size_t term = 0;  // of the model
  std::string label;
  std::size_t parameters = 0;     // free ones
  double likelihood_ratio = 0.0;  // 2 ln B
  double p = 1.0;                 // probability that it is not needed
  bool needed = true;
};

// A parameter that the model holds and the test frees.
struct FreedParameter {
  std::string effect;     // label of the term
  std::string parameter;  // "gain_um_per_K"

  friend bool operator==(const FreedParameter&, const FreedParameter&) = default;
};

struct EffectTest {
  Model model;  // with the effects added
  Fit fit_before, fit_after;
  LedgerRow before, after;          // `after` has change, likelihood ratio, verdict, effects still needed
  std::vector<Candidate> added;     // each with the rest of the model, and with the effects `beside` it
  std::vector<std::string> beside;  // labels of effects that are not in the model and assumed missing in the test
  std::optional<FreedParameter> freed;
  // Parameters of the model with the effects, from the likelihood used for `added`. Empty if no effect could be tested,
  // if the test assumes further effects or frees a value, and after pruning.
  std::vector<FittedParameter> parameters;
  std::vector<DropTest> earlier;
};

// Tests every effect among the first `count` terms of the model, except base effects and effects whose parameters are
// all held.
std::vector<DropTest> drop_tests(const Model& model, std::size_t count, const Series& data, std::size_t target = 0);

// Removes effects that are not needed: the least needed one first, then tests the rest again. The effects just added
// stay. Change, figures and effects still needed are then those of the smaller model.
struct Pruned {
  EffectTest effect_test;
  std::vector<std::size_t> removed;  // rising indices into the terms of the earlier model
};
Pruned pruned(EffectTest effect_test, const Series& data, std::size_t target = 0);

}  // namespace ballbar
