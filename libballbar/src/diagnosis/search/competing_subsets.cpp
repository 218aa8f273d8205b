#include "diagnosis/search/competing_subsets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>

#include "ballbar/diagnosis/statistics/thresholds.hpp"
#include "ballbar/error.hpp"
#include "ballbar/numerics/parallel.hpp"
#include "diagnosis/search/best_subset.hpp"
#include "diagnosis/search/nested_effects.hpp"

namespace ballbar {
namespace {

double thresholds(const SubsetFits& now, const MaxScoreNull& null, const Set& set) {
  double sum = 0.0;
  for (const std::size_t index : set) sum += null.threshold(*now.bound(index).effect);
  return sum;
}

// Fitted sets, each set of effects once.
class Fitted {
 public:
  Fitted(const SubsetFits& now, const NullModel& null_model) : now_(now), null_model_(null_model) {}

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
    std::vector<std::optional<SubsetFit>> fitted(fresh.size());
    in_parallel(fresh.size(), [&](std::size_t i) {
      try {
        fitted[i] = penalised_fit(now_.refitted(fresh[i], null_model_.noise));
      } catch (const Error&) {
        return;  // a set that cannot be fitted explains nothing
      }
    });
    for (std::optional<SubsetFit>& one : fitted) {
      if (one) refits_.push_back(std::move(*one));
    }
  }

  void again_from(const SubsetFit& near) {
    in_parallel(refits_.size(), [&](std::size_t i) {
      SubsetFit& other = refits_[i];
      if (other.penalised < near.penalised - kFarFromGood) return;
      const bool shares = std::any_of(other.set.begin(), other.set.end(),
                                      [&](std::size_t index) { return has(now_, near.set, now_.bound(index)); });
      if (!shares) return;
      try {
        SubsetFit again = penalised_fit(now_.refitted_from(near, other.set));
        if (again.noise_fit.log_likelihood > other.noise_fit.log_likelihood) other = std::move(again);
      } catch (const Error&) {
        return;  // from there it has no fit
      }
    });
  }

  void sort() {
    std::stable_sort(refits_.begin(), refits_.end(),
                     [](const SubsetFit& a, const SubsetFit& b) { return a.penalised > b.penalised; });
  }

  std::vector<SubsetFit>& refits() { return refits_; }

 private:
  SubsetFit penalised_fit(SubsetFit refitted) const {
    refitted.penalised = 2.0 * refitted.noise_fit.log_likelihood - thresholds(now_, null_model_.null, refitted.set);
    return refitted;
  }

  const SubsetFits& now_;
  const NullModel& null_model_;
  std::vector<SubsetFit> refits_;
  std::vector<std::vector<std::string>> done_;
};

// By the grid, the most likely first.
struct WorthALook {
  std::vector<Set> sets;
  Evaluations evaluated;
};

// On the grid: 2 ln L less what a search without any effect finds.
double penalised(const SubsetFits& now, const NullModel& null_model, const Evaluations& evaluated, const Set& set) {
  return 2.0 * evaluation_of(evaluated, set).log_likelihood - thresholds(now, null_model.null, set);
}

WorthALook worth_a_look(const SubsetFits& now, const NullModel& null_model) {
  std::vector<Set> sets;
  for (const Subset& subset : best_subsets(now.signatures(), null_model.seen, &null_model.null, now.largest_set())) {
    sets.push_back(subset.signatures);
    if (sets.size() == kWorthALook) break;
  }
  if (!null_model.first.empty()) sets.push_back(null_model.first);
  if (sets.empty()) return {};
  Evaluations evaluated = now.evaluated(null_model.evaluated, sets, null_model.noise);
  const auto by_likelihood = [&](const Set& a, const Set& b) {
    return penalised(now, null_model, evaluated, a) > penalised(now, null_model, evaluated, b);
  };
  std::stable_sort(sets.begin(), sets.end(), by_likelihood);
  for (Set& swapped : swaps(now, null_model.seen, sets.front())) sets.push_back(std::move(swapped));
  evaluated = now.evaluated(std::move(evaluated), sets, null_model.noise);
  std::stable_sort(sets.begin(), sets.end(), by_likelihood);
  return {std::move(sets), std::move(evaluated)};
}

// In the place of each effect of the best set others: a grid point far from the truth ends in a hollow of its own.
void add_in_place(const SubsetFits& now, const NullModel& null_model, Fitted& fitted) {
  for (std::size_t round = 0; round < kInPlaceRounds; ++round) {
    const SubsetFit whole = fitted.refits().front();
    std::vector<std::vector<std::size_t>> others(whole.set.size());
    in_parallel(others.size(), [&](std::size_t out) { others[out] = in_place_of(now, whole, out, null_model.null); });
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
  const std::vector<SubsetFit>& refits = fitted.refits();
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

bool is_open_between(const SubsetFit& best, const SubsetFit& other) {
  const double nearly = best.set.size() < 3 ? kNearlyAsGood : kThreeNearlyAsGood;
  return other.penalised > best.penalised - nearly ||
         (other.set.size() == best.set.size() &&
          2.0 * (best.noise_fit.log_likelihood - other.noise_fit.log_likelihood) < kNearlyAsGood);
}

std::vector<SubsetFit> competing_subsets(const SubsetFits& now, const NullModel& null_model) {
  const auto [sets, evaluated] = worth_a_look(now, null_model);
  if (sets.empty()) return {};
  const double gained = 2.0 * (evaluation_of(evaluated, sets.front()).log_likelihood - null_model.log_likelihood);
  const double allowance = kWorthRefitting + kGridError * std::max(0.0, gained);
  const std::size_t most = kMostRefitted * (sets.front().size() + 1) / 2;
  Fitted fitted(now, null_model);
  std::vector<SubsetFit>& refits = fitted.refits();
  std::vector<Set> tried;
  for (const Set& set : sets) {
    if (penalised(now, null_model, evaluated, set) < penalised(now, null_model, evaluated, sets.front()) - allowance)
      break;
    tried.push_back(set);
  }
  fitted.add(tried, most);
  fitted.sort();
  if (refits.empty()) return {};

  for (std::size_t size = 0; size != refits.front().set.size();) {
    size = refits.front().set.size();
    add_in_place(now, null_model, fitted);
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
