// One effect of a fitted set as a candidate for what is missing.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "hypotheses.hpp"
#include "search_null.hpp"

namespace ballbar {

// Its parameters, amplitude and RMSE.
Candidate candidate_of(const Hypotheses& now, const Refitted& with, std::size_t place);

// All the tests of the effect at `place` beside the rest of the set; `why_not`: sentences, empty where all are passed.
struct Confirmed {
  Candidate candidate;
  double best_fake_fall = 0.0;
  std::vector<std::string> why_not;
};
Confirmed confirmed(const Hypotheses& now, const Series& data, const Refitted& with, std::size_t place,
                    const SearchNull& null, const std::vector<std::size_t>& cycle, const DiagnosisOptions& options);

// `rich` is `plain` with another effect in the place of one of the set: one that at the edge of its shapes becomes it,
// and as fitted draws the same curve. Gives the place in the set of `rich`.
std::optional<std::size_t> redrawn(const Hypotheses& now, const Refitted& plain, const Refitted& rich);

// Effects that stand in the place of one of the best set in a rival set, one group for each.
std::vector<std::vector<BoundEffect>> groups_of(const Hypotheses& now, const Projected& seen, const Refitted& best,
                                                const std::vector<const Refitted*>& rivals);

}  // namespace ballbar
