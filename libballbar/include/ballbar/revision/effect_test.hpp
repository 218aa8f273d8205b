// Effects added to a model for a try: before, after, and whether the data demand them.
//
//   likelihood ratio   2 (ln L with - ln L without), the noise estimated anew under each, at least 0
//   drop test p        chance of as large a ratio from an effect that is not there: chi^2 with the number of its free
//                      parameters; an effect is needed where it is below 0.001
//
// An added effect is supported where its likelihood ratio is at least 25 (d = 5), its gain is the same in every cycle
// (p >= 0.001), cycles left out are predicted better, and its fall of chi^2 is larger than that of the best of 200
// surrogates, its own signatures with random phases. That holds for an effect chosen before looking at these data; one
// found by searching them is for diagnose(). Figures but those of the rows are, of series with more than 1500 values of
// the target, of every second, third ..., as diagnose() has them.
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
  std::size_t parameters = 0;  // free ones
  double likelihood_ratio = 0.0;
  double p = 1.0;
  bool needed = true;
};

struct EffectTest {
  Model model;  // with the effects added
  Fit fit_before, fit_after;
  LedgerRow before, after;       // after: with change, likelihood ratio, verdict, what is still needed
  std::vector<Candidate> added;  // each beside the rest of the model
  std::vector<DropTest> earlier;
};

// Throws Error as fit does.
EffectTest effect_test(const Model& model, const std::vector<Term>& added, const Series& data, std::size_t target = 0);

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
