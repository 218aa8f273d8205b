#include "diagnosis/next_test/undecided_pairs.hpp"

#include <algorithm>
#include <utility>

#include "ballbar/diagnosis/statistics/thresholds.hpp"

namespace ballbar {
namespace {

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
                   [](const Candidate* a, const Candidate* b) { return a->evidence > b->evidence; });
  if (strongest.size() > 1) groups.push_back({strongest[0]->bound, strongest[1]->bound});
  return groups;
}

}  // namespace

Question question_of(const Model& model, const Series& data, const Diagnosis& diagnosis) {
  Question question{{&model, &data, &diagnosis.base, {}}, {}};
  std::vector<Rival>& rivals = question.candidates.rivals;
  std::vector<std::size_t> best_set;
  const std::size_t points = kComparedPoints / std::max<std::size_t>(4, diagnosis.candidates.size());
  for (const Candidate& candidate : diagnosis.candidates) {
    std::optional<Rival> rival = rival_of(candidate, data, points);
    if (!rival) continue;
    if (candidate.in_best_set) best_set.push_back(rivals.size());
    rivals.push_back(std::move(*rival));
  }
  const std::size_t known = rivals.size();
  for (const std::vector<BoundEffect>& group : open_groups(diagnosis)) {
    std::vector<std::size_t> members, others;
    for (std::size_t k = 0; k < known; ++k) {
      if (in(group, rivals[k].bound)) members.push_back(k);
    }
    for (const std::size_t k : best_set) {
      if (!in(group, rivals[k].bound)) others.push_back(k);
    }
    if (group.size() == 1 && members.size() == 1) {
      Rival once = rivals[members[0]];
      once.only_once = true;
      members.push_back(rivals.size());
      rivals.push_back(std::move(once));
    }
    for (std::size_t i = 0; i < members.size(); ++i) {
      for (std::size_t j = i + 1; j < members.size(); ++j) question.pairs.push_back({members[i], members[j], others});
    }
  }
  return question;
}

}  // namespace ballbar
