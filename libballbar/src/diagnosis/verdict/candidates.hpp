// One effect of a fitted set as a candidate for what is missing.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "diagnosis/search/hypotheses.hpp"
#include "diagnosis/search/search_null.hpp"

namespace ballbar {

// Of a trace by least squares from there: a form error is easily taken for noise with a memory, under which the circle
// hardly counts and its RMSE may rise.
double rmse_after_um(const Hypotheses& now, const Refitted& with);

// Its parameters, amplitude and RMSE.
Candidate candidate_of(const Hypotheses& now, const Refitted& with, std::size_t place);

// All the tests of the effect at `place` beside the rest of the set; `why_not`: sentences, empty where all are passed.
struct Confirmed {
  Candidate candidate;
  double best_fake_fall = 0.0;
  std::vector<std::string> why_not;
  bool at_the_edge = false;  // a shape lies on its bound: something like it, but not it
};
Confirmed confirmed(const Hypotheses& now, const Series& data, const Refitted& with, std::size_t place,
                    const SearchNull& null, const std::vector<std::size_t>& cycle, const DiagnosisOptions& options);

// `rich` is at the edge of its shapes `plain`, on the same columns.
bool becomes(const BoundEffect& rich, const BoundEffect& plain);

// The effect at place k of `rich` is one that at the edge of its shapes becomes that at place m of `plain`, and as
// fitted draws the same curve but for its factor.
bool draws_the_same(const Hypotheses& now, const Refitted& plain, std::size_t m, const Refitted& rich, std::size_t k);

// `rich` is `plain` but for one effect, and that draws the same.
bool redrawn(const Hypotheses& now, const Refitted& plain, const Refitted& rich);

// Effects that stand in the place of one of the best set in a rival set, one group for each; not what draws the same,
// nor what the rival could do without.
std::vector<std::vector<BoundEffect>> groups_of(const Hypotheses& now, const Projected& seen, const Refitted& best,
                                                const std::vector<const Refitted*>& rivals);

}  // namespace ballbar
