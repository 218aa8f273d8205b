#include "diagnosis/search/hypotheses.hpp"

#include <algorithm>
#include <cmath>

#include "ballbar/error.hpp"
#include "diagnosis/search/best_subset.hpp"
#include "diagnosis/statistics/likely.hpp"
#include "numerics/parallel.hpp"

namespace ballbar {
namespace {

constexpr double kWorthRefitting = 12.0;  // 2 ln L
constexpr std::size_t kSearchRounds = 3;
constexpr std::size_t kMostSwaps = 20;  // of one of the set

}  // namespace

Hypotheses::Hypotheses(const Model& model, const Series& data, std::size_t target, const Fit& base,
                       const DiagnosisOptions& options)
    : model_(model), data_(data), target_(target), progress_(options.progress), leftover_(leftover_of(base)) {
  BankOptions searched;
  searched.motion = options.motion;
  searched.without = options.without;
  bank_ = bank_of(options.catalogue, model, data, base, searched);
}

std::size_t Hypotheses::largest_set() const {
  const auto n = static_cast<std::size_t>(leftover_.residual_um.size());
  const auto p = static_cast<std::size_t>(leftover_.model.cols());
  return n <= p ? 0 : std::min<std::size_t>(3, (n - p) / 4);
}

Eigen::MatrixXd Hypotheses::columns(const Set& set) const {
  Eigen::Index width = 0;
  for (const std::size_t index : set) width += at(index).width;
  Eigen::MatrixXd result(bank_.columns.rows(), width);
  Eigen::Index column = 0;
  for (const std::size_t index : set) {
    result.middleCols(column, at(index).width) = bank_.columns.middleCols(at(index).first, at(index).width);
    column += at(index).width;
  }
  return result;
}

Projected Hypotheses::projected_by(const Noise& noise) const {
  return projected(bank_, leftover_.residual_um, leftover_.model,
                   Whitening(noise, leftover_.time_s, leftover_.sigma_um));
}

const Explained& Hypotheses::evaluated(const Set& set, const Noise& start) {
  Set key = set;
  std::sort(key.begin(), key.end());
  const auto known = evaluated_.find(key);
  if (known != evaluated_.end()) return known->second;
  return evaluated_.emplace(std::move(key), explained(leftover_, columns(set), start)).first->second;
}

void Hypotheses::evaluate(const std::vector<Set>& sets, const Noise& start) {
  std::vector<Set> keys;
  for (Set key : sets) {
    std::sort(key.begin(), key.end());
    const bool known = evaluated_.count(key) > 0 || std::find(keys.begin(), keys.end(), key) != keys.end();
    if (!known) keys.push_back(std::move(key));
  }
  std::vector<Explained> found(keys.size());
  in_parallel(keys.size(), [&](std::size_t i) { found[i] = explained(leftover_, columns(keys[i]), start); });
  for (std::size_t i = 0; i < keys.size(); ++i) evaluated_.emplace(std::move(keys[i]), std::move(found[i]));
}

void Hypotheses::fit_by(const Noise& noise, Refitted& refitted) const {
  Seen seen = seen_by(noise, refitted.model, data_, target_);
  refitted.fit = std::move(seen.fit);
  refitted.leftover = std::move(seen.likely.leftover);
  refitted.noise = seen.likely.noise;
  refitted.log_likelihood = seen.likely.log_likelihood;
}

Term Hypotheses::term_at(std::size_t index) const {
  Term term = term_of(*family(index).effect, family(index).columns);
  for (std::size_t k = 0; k < term.settings.size(); ++k) {
    if (term.effect->parameters[k].kind != ParameterKind::shape) continue;
    Setting& setting = term.settings[k];
    setting.start = std::clamp(at(index).point[k], setting.lower, setting.upper);
    setting.stated = true;
  }
  return term;
}

Refitted Hypotheses::refitted(const Set& set, const Noise& noise) const {
  Refitted result{set, model_, {}, {}, {}, 0.0, 0.0};
  for (const std::size_t index : set) result.model.terms.push_back(term_at(index));
  fit_by(noise, result);
  return result;
}

Refitted Hypotheses::refitted_from(const Refitted& near, const Set& set) const {
  Refitted result{set, from_where_it_is(near.model, near.fit), {}, {}, {}, 0.0, 0.0};
  std::vector<Term> shared(result.model.terms.begin() + static_cast<std::ptrdiff_t>(model_.terms.size()),
                           result.model.terms.end());
  result.model.terms.resize(model_.terms.size());
  for (const std::size_t index : set) {
    const auto at =
        std::find_if(near.set.begin(), near.set.end(), [&](std::size_t other) { return bound(other) == bound(index); });
    result.model.terms.push_back(at == near.set.end() ? term_at(index)
                                                      : shared[static_cast<std::size_t>(at - near.set.begin())]);
  }
  fit_by(near.noise, result);
  return result;
}

Refitted Hypotheses::without(const Refitted& whole, std::size_t place) const {
  Refitted result{whole.set, from_where_it_is(whole.model, whole.fit), {}, {}, {}, 0.0, 0.0};
  result.set.erase(result.set.begin() + static_cast<std::ptrdiff_t>(place));
  result.model.terms.erase(result.model.terms.begin() + static_cast<std::ptrdiff_t>(model_.terms.size() + place));
  fit_by(whole.noise, result);
  return result;
}

Guess first_guess(Hypotheses& now, const Noise& base_noise, double base_log_likelihood) {
  constexpr double kPrice = 14.0;  // of an effect, before its threshold is known
  Noise white = base_noise;
  white.white_um =
      std::sqrt(base_noise.white_um * base_noise.white_um + base_noise.correlated_um * base_noise.correlated_um);
  white.correlated_um = 0.0;
  std::vector<Noise> starts{base_noise};
  if (base_noise.correlated_um > 0.0) starts.push_back(white);
  Guess guess{{}, base_noise};
  double most = 2.0 * base_log_likelihood;
  if (now.has_few_rows() && !now.leftover().sigma_um.empty()) {
    // What is stated, nothing more; all is judged by it.
    now.forget();
    guess.noise = {};
    starts = {guess.noise};
    most = 2.0 * now.evaluated({}, guess.noise).log_likelihood;
  }
  for (std::size_t round = 0; round < kSearchRounds && !starts.empty(); ++round) {
    const std::vector<Noise> from = std::move(starts);
    starts.clear();
    bool better = false;
    for (const Noise& start : from) {
      const Projected seen = now.projected_by(start);
      // The best few of every size.
      std::map<std::size_t, std::size_t> taken;
      std::vector<Set> sets;
      for (const Subset& subset : best_subsets(now.bank(), seen, nullptr, now.largest_set())) {
        if (++taken[subset.signatures.size()] <= 5) sets.push_back(subset.signatures);
      }
      now.evaluate(sets, start);
      for (const Set& set : sets) {
        const Explained& found = now.evaluated(set, start);
        const double value = 2.0 * found.log_likelihood - kPrice * static_cast<double>(set.size());
        if (value <= most + 0.5) continue;
        most = value;
        guess = {set, found.noise};
        better = true;
      }
    }
    if (better) starts.push_back(guess.noise);
  }
  return guess;
}

std::vector<Set> swaps(const Hypotheses& now, const Projected& seen, const Set& set) {
  std::vector<Set> result;
  for (std::size_t out = 0; out < set.size(); ++out) {
    Set others = set;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(out));
    Eigen::MatrixXd basis(seen.columns.rows(), 0);
    for (const std::size_t index : others) {
      Eigen::MatrixXd more(basis.rows(), basis.cols() + now.at(index).width);
      more << basis, seen.columns.middleCols(now.at(index).first, now.at(index).width);
      basis = std::move(more);
    }
    basis = orthonormal(basis);
    const Eigen::VectorXd left = seen.residual - basis * (basis.transpose() * seen.residual);
    const Eigen::VectorXd along = seen.columns.transpose() * left;
    const Eigen::MatrixXd inside = basis.transpose() * seen.columns;
    const auto gain = [&](std::size_t index) {
      double sum = 0.0;
      for (Eigen::Index j = now.at(index).first; j < now.at(index).first + now.at(index).width; ++j) {
        const double survives = 1.0 - inside.col(j).squaredNorm();
        if (survives > 0.04) sum += along[j] * along[j] / survives;
      }
      return sum;
    };
    const double own = gain(set[out]);
    std::vector<std::pair<double, Set>> places;
    for (std::size_t f = 0; f < now.bank().families.size(); ++f) {
      const Family& family = now.bank().families[f];
      const bool there = std::any_of(set.begin(), set.end(), [&](std::size_t i) { return now.at(i).family == f; });
      if (there && now.at(set[out]).family != f) continue;
      std::size_t best = family.first;
      for (std::size_t i = family.first; i < family.first + family.count; ++i) {
        if (gain(i) > gain(best)) best = i;
      }
      if (!(gain(best) > 0.0) || gain(best) < 0.8 * own - kWorthRefitting) continue;
      Set swapped = others;
      swapped.push_back(best);
      places.emplace_back(gain(best), std::move(swapped));
    }
    std::stable_sort(places.begin(), places.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    places.resize(std::min(places.size(), kMostSwaps));
    for (auto& [value, swapped] : places) result.push_back(std::move(swapped));
  }
  return result;
}

std::vector<std::size_t> in_place_of(const Hypotheses& now, const Refitted& whole, std::size_t place,
                                     const SearchNull& null) {
  constexpr std::size_t kMost = 8;
  Refitted without;
  try {
    without = now.without(whole, place);
  } catch (const Error&) {
    return {};
  }
  const Whitening whitening(whole.noise, without.leftover.time_s, without.leftover.sigma_um);
  const Projected seen = projected(now.bank(), without.leftover.residual_um, without.leftover.model, whitening);
  const Eigen::VectorXd score = scores(now.bank(), seen, seen.residual);
  const auto net = [&](std::size_t index) {
    return score[static_cast<Eigen::Index>(index)] - null.threshold(*now.family(index).effect);
  };
  std::vector<std::size_t> best;
  double own = 0.0;
  for (std::size_t f = 0; f < now.bank().families.size(); ++f) {
    const Family& family = now.bank().families[f];
    std::size_t most = family.first;
    for (std::size_t i = family.first; i < family.first + family.count; ++i) {
      if (net(i) > net(most)) most = i;
    }
    if (now.at(whole.set[place]).family == f) own = net(most);
    const bool there =
        std::any_of(whole.set.begin(), whole.set.end(), [&](std::size_t i) { return now.at(i).family == f; });
    if (!there) best.push_back(most);
  }
  std::stable_sort(best.begin(), best.end(), [&](std::size_t a, std::size_t b) { return net(a) > net(b); });
  std::size_t taken = 0;
  while (taken < std::min(best.size(), kMost) && net(best[taken]) > 0.8 * own - kWorthRefitting) ++taken;
  best.resize(taken);
  return best;
}

bool has(const Hypotheses& now, const Set& set, const BoundEffect& bound) {
  return std::any_of(set.begin(), set.end(), [&](std::size_t index) { return now.bound(index) == bound; });
}

bool is_without(const Hypotheses& now, const Set& set, const Set& whole, std::size_t place) {
  if (set.size() + 1 != whole.size()) return false;
  for (std::size_t k = 0; k < whole.size(); ++k) {
    if (k != place && !has(now, set, now.bound(whole[k]))) return false;
  }
  return true;
}

}  // namespace ballbar
