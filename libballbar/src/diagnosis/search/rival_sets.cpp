#include "diagnosis/search/rival_sets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>

#include "ballbar/error.hpp"
#include "diagnosis/search/best_subset.hpp"
#include "diagnosis/verdict/candidates.hpp"
#include "numerics/parallel.hpp"

namespace ballbar {
namespace {

constexpr double kNearlyAsGood = 6.0;        // 2 ln L, less thresholds or of sets of one size
constexpr double kThreeNearlyAsGood = 12.0;  // 2 ln L less thresholds of sets of three
constexpr double kFarFromGood = 40.0;        // 2 ln L less thresholds: not worth another fit
constexpr double kWorthRefitting = 12.0;     // 2 ln L
constexpr double kGridError = 0.1;           // share of the evidence that a point of a grid may lack
constexpr std::size_t kRefitted = 14;        // sets of one effect; half as many more for every other one
constexpr std::size_t kRounds = 2;

double thresholds(const Hypotheses& now, const SearchNull& null, const Set& set) {
  double sum = 0.0;
  for (const std::size_t index : set) sum += null.threshold(*now.family(index).effect);
  return sum;
}

// Fitted sets, each set of effects once.
class Fitted {
 public:
  Fitted(const Hypotheses& now, const Ground& ground) : now_(now), ground_(ground) {}

  // Those that are new, at most so many.
  void add(const std::vector<Set>& sets, std::size_t most) {
    std::vector<Set> fresh;
    for (const Set& set : sets) {
      if (fresh.size() == most) break;
      std::vector<std::string> key;
      for (const std::size_t index : set) key.push_back(label_of(now_.bound(index)));
      std::sort(key.begin(), key.end());
      if (std::find(done_.begin(), done_.end(), key) != done_.end()) continue;
      done_.push_back(std::move(key));
      fresh.push_back(set);
    }
    if (!fresh.empty()) now_.tell(fmt::format("fitting {} sets of effects", fresh.size()));
    std::vector<std::optional<Refitted>> fitted(fresh.size());
    in_parallel(fresh.size(), [&](std::size_t i) {
      try {
        fitted[i] = judged(now_.refitted(fresh[i], ground_.noise));
      } catch (const Error&) {
        return;  // a set that cannot be fitted explains nothing
      }
    });
    for (std::optional<Refitted>& one : fitted) {
      if (one) refits_.push_back(std::move(*one));
    }
  }

  void again_from(const Refitted& near) {
    in_parallel(refits_.size(), [&](std::size_t i) {
      Refitted& other = refits_[i];
      if (other.penalised < near.penalised - kFarFromGood) return;
      const bool shares = std::any_of(other.set.begin(), other.set.end(),
                                      [&](std::size_t index) { return has(now_, near.set, now_.bound(index)); });
      if (!shares) return;
      try {
        Refitted again = judged(now_.refitted_from(near, other.set));
        if (again.log_likelihood > other.log_likelihood) other = std::move(again);
      } catch (const Error&) {
        return;  // from there it has no fit
      }
    });
  }

  void sort() {
    std::stable_sort(refits_.begin(), refits_.end(),
                     [](const Refitted& a, const Refitted& b) { return a.penalised > b.penalised; });
  }

  std::vector<Refitted>& refits() { return refits_; }

 private:
  Refitted judged(Refitted refitted) const {
    refitted.penalised = 2.0 * refitted.log_likelihood - thresholds(now_, ground_.null, refitted.set);
    return refitted;
  }

  const Hypotheses& now_;
  const Ground& ground_;
  std::vector<Refitted> refits_;
  std::vector<std::vector<std::string>> done_;
};

// By the grid, the most likely first.
std::vector<Set> worth_a_look(Hypotheses& now, const Ground& ground) {
  constexpr std::size_t kMost = 20;
  std::vector<Set> sets;
  for (const Subset& subset : best_subsets(now.bank(), ground.seen, &ground.null, now.largest_set())) {
    sets.push_back(subset.signatures);
    if (sets.size() == kMost) break;
  }
  if (!ground.first.set.empty()) sets.push_back(ground.first.set);
  if (sets.empty()) return sets;
  now.evaluate(sets, ground.noise);
  const auto by_likelihood = [&](const Set& a, const Set& b) {
    return penalised(now, ground, a) > penalised(now, ground, b);
  };
  std::stable_sort(sets.begin(), sets.end(), by_likelihood);
  for (Set& swapped : swaps(now, ground.seen, sets.front())) sets.push_back(std::move(swapped));
  now.evaluate(sets, ground.noise);
  std::stable_sort(sets.begin(), sets.end(), by_likelihood);
  return sets;
}

// In the place of each effect of the best set others: a grid point far from the truth ends in a hollow of its own.
void add_in_place(const Hypotheses& now, const Ground& ground, Fitted& fitted) {
  for (std::size_t round = 0; round < kRounds; ++round) {
    const Refitted whole = fitted.refits().front();
    std::vector<std::vector<std::size_t>> others(whole.set.size());
    in_parallel(others.size(), [&](std::size_t out) { others[out] = in_place_of(now, whole, out, ground.null); });
    std::vector<Set> swapped;
    for (std::size_t out = 0; out < others.size(); ++out) {
      for (const std::size_t other : others[out]) {
        swapped.push_back(whole.set);
        swapped.back()[out] = other;
      }
    }
    fitted.add(swapped, swapped.size());
    fitted.again_from(whole);
    fitted.sort();
    if (fitted.refits().front().set == whole.set) return;
  }
}

// The best set without each of its effects: what a point of the grid lacked another effect may have filled in, which
// with free shapes is not needed.
void add_with_fewer(Fitted& fitted) {
  const std::vector<Refitted>& refits = fitted.refits();
  for (std::size_t before = 0; before != refits.size() && refits.front().set.size() > 1;) {
    before = refits.size();
    const Set whole = refits.front().set;
    std::vector<Set> fewer;
    for (std::size_t out = 0; out < whole.size(); ++out) {
      fewer.push_back(whole);
      fewer.back().erase(fewer.back().begin() + static_cast<std::ptrdiff_t>(out));
    }
    fitted.add(fewer, fewer.size());
    fitted.sort();
  }
}

}  // namespace

double penalised(Hypotheses& now, const Ground& ground, const Set& set) {
  return 2.0 * now.evaluated(set, ground.noise).log_likelihood - thresholds(now, ground.null, set);
}

bool is_open_between(const Refitted& best, const Refitted& other) {
  const double nearly = best.set.size() < 3 ? kNearlyAsGood : kThreeNearlyAsGood;
  return other.penalised > best.penalised - nearly ||
         (other.set.size() == best.set.size() && 2.0 * (best.log_likelihood - other.log_likelihood) < kNearlyAsGood);
}

std::vector<Refitted> rival_sets(Hypotheses& now, const Ground& ground) {
  const std::vector<Set> sets = worth_a_look(now, ground);
  if (sets.empty()) return {};
  const double gained = 2.0 * (now.evaluated(sets.front(), ground.noise).log_likelihood - ground.log_likelihood);
  const double allowance = kWorthRefitting + kGridError * std::max(0.0, gained);
  const std::size_t most = kRefitted * (sets.front().size() + 1) / 2;
  Fitted fitted(now, ground);
  std::vector<Refitted>& refits = fitted.refits();
  std::vector<Set> tried;
  for (const Set& set : sets) {
    if (penalised(now, ground, set) < penalised(now, ground, sets.front()) - allowance) break;
    tried.push_back(set);
  }
  fitted.add(tried, most);
  fitted.sort();
  if (refits.empty()) return {};

  for (std::size_t size = 0; size != refits.front().set.size();) {
    size = refits.front().set.size();
    add_in_place(now, ground, fitted);
    add_with_fewer(fitted);
  }
  for (std::size_t k = 1; k < refits.size(); ++k) {
    if (!is_open_between(refits.front(), refits[k]) || !redrawn(now, refits[k], refits.front())) continue;
    std::rotate(refits.begin(), refits.begin() + static_cast<std::ptrdiff_t>(k),
                refits.begin() + static_cast<std::ptrdiff_t>(k) + 1);
    k = 0;
  }
  return std::move(refits);
}

}  // namespace ballbar
