// Effects added to a model (workbench.hpp): before, after, and whether the data demand them.
//
//   2 ln B             2 ln of how much more likely the readings are with an effect than without, its gains and shapes
//                      and the noise integrated out, as diagnose() weighs it (candidate.hpp)
//   P superfluous      of an effect of the model: 1 / (1 + B); it is needed below 0.05
//
// An added effect is supported where 2 ln B is at least 10 and it has no doubt: its gain is the same in every cycle
// (p >= 0.01), and it does not go with time alone. That holds for an effect chosen before looking at these data; one
// found by searching them is for diagnose(). The shapes of the added effects begin where they are likeliest, so that a
// fit of the model is the fit that is told. Figures but those of the rows are, of long series, of every second, third
// ... value, as diagnose() has them.
//
// Errors of linear axes on recordings are judged beside all other errors of the axes: chi^2 in place of 2 ln B, and the
// p of that, below 0.001 where an error is needed (machine_errors.hpp).
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "ballbar/diagnosis/verdict/candidate.hpp"
#include "ballbar/fit/fit.hpp"
#include "ballbar/model/model.hpp"
#include "ballbar/revision/ledger.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

// An effect of the model, tested by leaving it out.
struct DropTest {
  std::size_t term = 0;  // of the model
  std::string label;
  std::size_t parameters = 0;     // free ones
  double likelihood_ratio = 0.0;  // 2 ln B
  double p = 1.0;                 // that it is not needed
  bool needed = true;
};

struct EffectTest {
  Model model;  // with the effects added
  Fit fit_before, fit_after;
  LedgerRow before, after;       // after: with change, likelihood ratio, verdict, what is still needed
  std::vector<Candidate> added;  // each beside the rest of the model
  // Of the model with the effects, by the likelihood that `added` is judged by; none where nothing could be judged, or
  // once the model is pruned.
  std::vector<FittedParameter> parameters;
  std::vector<DropTest> earlier;
};

// Every effect among the first `count` terms of the model. The circles of recordings, their base, and effects that are
// all held are not tested.
std::vector<DropTest> drop_tests(const Model& model, std::size_t count, const Series& data, std::size_t target = 0);

// Without effects that are not needed, the least needed one first and the rest tested anew. Of the terms from `earlier`
// on, those just added, all stay. Change, figures and what is still needed are then those of the smaller model.
struct Pruned {
  EffectTest effect_test;
  std::vector<std::size_t> removed;  // terms of the model before, rising
};
Pruned pruned(EffectTest effect_test, const Series& data, std::size_t target = 0);

}  // namespace ballbar
