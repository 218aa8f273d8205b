// Effects added to a model for a try: before, after, and whether the data demand them.
//
//   evidence     2 (ln L with - ln L without), the noise estimated anew under each, at least 0
//   p to stay    chance of as much evidence from an effect that is not there: chi^2 with the number of its free
//                parameters; an effect is needed where it is below 0.001
//
// An added effect is supported where its evidence is at least 25 (d = 5), its gain is the same in every cycle
// (p >= 0.001), cycles left out are predicted better, and its fall of chi^2 is larger than that of the best of 200
// fakes, its own signatures with their phases scrambled. That holds for an effect chosen before looking at these data;
// one found by searching them is for diagnose(). Figures but those of the rows are, of series with more than 1500
// values of the target, of every second, third ..., as diagnose() has them.
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
struct Stay {
  std::size_t term = 0;  // of the model
  std::string label;
  std::size_t parameters = 0;  // free ones
  double evidence = 0.0;
  double p = 1.0;
  bool needed = true;
};

struct Trial {
  Model model;  // with the effects added
  Fit fit_before, fit_after;
  LedgerRow before, after;       // after: with change, evidence, verdict, what is still needed
  std::vector<Candidate> added;  // each beside the rest of the model
  std::vector<Stay> earlier;
};

// Throws Error as fit does.
Trial trial(const Model& model, const std::vector<Term>& added, const Series& data, std::size_t target = 0);

// Every effect among the first `count` terms of the model. The circles of recordings, their base, and effects that are
// all held are not tested.
std::vector<Stay> stays(const Model& model, std::size_t count, const Series& data, std::size_t target = 0);

// Without effects that are not needed, the least needed one first and the rest tested anew. Of the terms from `earlier`
// on, those just added, all stay. Change, figures and what is still needed are then those of the smaller model.
struct Pruned {
  Trial trial;
  std::vector<std::size_t> removed;  // terms of the model before, rising
};
Pruned pruned(Trial trial, const Series& data, std::size_t target = 0);

}  // namespace ballbar
