#include "diagnosis/next_test/undecided_pairs.hpp"

#include <algorithm>
#include <utility>

#include "ballbar/diagnosis/thresholds.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kComparedPoints = 60;  // of the shapes of all candidates

bool in(const std::vector<BoundEffect>& group, const BoundEffect& bound) {
  return std::find(group.begin(), group.end(), bound) != group.end();
}

// Groups of which one is it: those of the diagnosis, else the strongest two.
std::vector<std::vector<BoundEffect>> open_groups(const Diagnosis& diagnosis) {
  std::vector<std::vector<BoundEffect>> groups;
  for (const std::vector<BoundEffect>& group : diagnosis.equivalent) {
    if (!group.empty()) groups.push_back(group);
  }
  if (!groups.empty()) return groups;
  std::vector<const Candidate*> strongest;
  for (const Candidate& candidate : diagnosis.candidates) {
    if (!in(diagnosis.named, candidate.bound)) strongest.push_back(&candidate);
  }
  std::stable_sort(strongest.begin(), strongest.end(),
                   [](const Candidate* a, const Candidate* b) { return a->p > b->p; });
  if (strongest.size() > 1) groups.push_back({strongest[0]->bound, strongest[1]->bound});
  return groups;
}

}  // namespace

UndecidedPairs undecided_pairs_of(const Model& model, const Series& data, const Diagnosis& diagnosis) {
  UndecidedPairs question{{&model, &data, &diagnosis.base, {}}, {}};
  std::vector<Competitor>& competitors = question.candidates.competitors;
  std::vector<std::size_t> best_set;
  const std::size_t points = kComparedPoints / std::max<std::size_t>(4, diagnosis.candidates.size());
  for (const Candidate& candidate : diagnosis.candidates) {
    std::optional<Competitor> competitor = competitor_of(candidate, data, points);
    if (!competitor) continue;
    if (candidate.in_best_set) best_set.push_back(competitors.size());
    competitors.push_back(std::move(*competitor));
  }
  const std::size_t known = competitors.size();
  for (const std::vector<BoundEffect>& group : open_groups(diagnosis)) {
    std::vector<std::size_t> members, others;
    for (std::size_t k = 0; k < known; ++k) {
      if (in(group, competitors[k].bound)) members.push_back(k);
    }
    for (const std::size_t k : best_set) {
      if (!in(group, competitors[k].bound)) others.push_back(k);
    }
    if (group.size() == 1 && members.size() == 1) {
      Competitor once = competitors[members[0]];
      once.only_once = true;
      members.push_back(competitors.size());
      competitors.push_back(std::move(once));
    }
    for (std::size_t i = 0; i < members.size(); ++i) {
      for (std::size_t j = i + 1; j < members.size(); ++j) question.pairs.push_back({members[i], members[j], others});
    }
  }
  return question;
}

}  // namespace ballbar
