#include "diagnosis/search/subset_fits.hpp"

#include <algorithm>
#include <cmath>

#include "ballbar/diagnosis/statistics/thresholds.hpp"
#include "ballbar/error.hpp"
#include "ballbar/numerics/parallel.hpp"
#include "numerics/orthonormal.hpp"

namespace ballbar {
SubsetFits::SubsetFits(const Model& model, const Series& data, std::size_t target, const Fit& base,
                       const SearchOptions& options)
    : model_(model), data_(data), target_(target), progress_(options.progress), linearised_(linearised_fit_of(base)) {
  SignatureOptions searched;
  searched.motion = options.motion;
  searched.without = options.without;
  library_ = signature_library_of(options.catalogue, model, data, base, searched);
}

std::size_t SubsetFits::largest_set() const {
  const auto n = static_cast<std::size_t>(linearised_.residual_um.size());
  const auto p = static_cast<std::size_t>(linearised_.model.cols());
  return n <= p ? 0 : std::min(kLargestSet, (n - p) / kValuesForAnEffect);
}

Eigen::MatrixXd SubsetFits::columns(const Set& set) const {
  Eigen::Index width = 0;
  for (const std::size_t index : set) width += at(index).width;
  Eigen::MatrixXd result(library_.columns.rows(), width);
  Eigen::Index column = 0;
  for (const std::size_t index : set) {
    result.middleCols(column, at(index).width) = library_.columns.middleCols(at(index).first, at(index).width);
    column += at(index).width;
  }
  return result;
}

Projected SubsetFits::projected_by(const Noise& noise) const {
  return projected(library_, linearised_.residual_um, linearised_.model,
                   Whitening(noise, linearised_.time_s, linearised_.sigma_um));
}

const GlsFit& evaluation_of(const Evaluations& known, Set set) {
  std::sort(set.begin(), set.end());
  return known.at(set);
}

Evaluations SubsetFits::evaluated(Evaluations known, const std::vector<Set>& sets, const Noise& start) const {
  std::vector<Set> keys;
  for (Set key : sets) {
    std::sort(key.begin(), key.end());
    const bool there = known.count(key) > 0 || std::find(keys.begin(), keys.end(), key) != keys.end();
    if (!there) keys.push_back(std::move(key));
  }
  std::vector<GlsFit> found(keys.size());
  in_parallel(keys.size(), [&](std::size_t i) { found[i] = gls_fit(linearised_, columns(keys[i]), start); });
  for (std::size_t i = 0; i < keys.size(); ++i) known.emplace(std::move(keys[i]), std::move(found[i]));
  return known;
}

SubsetFit SubsetFits::fitted(Set set, Model model, const Noise& noise) const {
  NoiseFit noise_fit = noise_fit_by(noise, model, data_, target_);
  return {std::move(set), std::move(model), std::move(noise_fit), 0.0};
}

Term SubsetFits::term_at(std::size_t index) const {
  Term term = term_of(*bound(index).effect, bound(index).columns);
  for (std::size_t k = 0; k < term.settings.size(); ++k) {
    if (term.effect->parameters[k].kind != ParameterKind::shape) continue;
    Setting& setting = term.settings[k];
    setting.start = std::clamp(at(index).point[k], setting.lower, setting.upper);
    setting.stated = true;
  }
  return term;
}

SubsetFit SubsetFits::refitted(const Set& set, const Noise& noise) const {
  Model model = model_;
  for (const std::size_t index : set) model.terms.push_back(term_at(index));
  return fitted(set, std::move(model), noise);
}

SubsetFit SubsetFits::refitted_from(const SubsetFit& near, const Set& set) const {
  Model model = from_where_it_is(near.model, near.noise_fit.fit);
  std::vector<Term> shared(model.terms.begin() + static_cast<std::ptrdiff_t>(model_.terms.size()), model.terms.end());
  model.terms.resize(model_.terms.size());
  for (const std::size_t index : set) {
    const auto at =
        std::find_if(near.set.begin(), near.set.end(), [&](std::size_t other) { return bound(other) == bound(index); });
    model.terms.push_back(at == near.set.end() ? term_at(index)
                                               : shared[static_cast<std::size_t>(at - near.set.begin())]);
  }
  return fitted(set, std::move(model), near.noise_fit.noise);
}

SubsetFit SubsetFits::without(const SubsetFit& whole, std::size_t place) const {
  Set set = whole.set;
  set.erase(set.begin() + static_cast<std::ptrdiff_t>(place));
  Model model = from_where_it_is(whole.model, whole.noise_fit.fit);
  model.terms.erase(model.terms.begin() + static_cast<std::ptrdiff_t>(model_.terms.size() + place));
  return fitted(std::move(set), std::move(model), whole.noise_fit.noise);
}

FirstGuess first_guess(const SubsetFits& now, const Noise& base_noise, Evaluations known) {
  Noise white = base_noise;
  white.white_um =
      std::sqrt(base_noise.white_um * base_noise.white_um + base_noise.correlated_um * base_noise.correlated_um);
  white.correlated_um = 0.0;
  std::vector<Noise> starts{base_noise};
  if (base_noise.correlated_um > 0.0) starts.push_back(white);
  if (now.has_few_rows() && !now.linearised().sigma_um.empty()) {
    // What is stated, nothing more; all is judged by it.
    starts = {Noise{}};
    known = now.evaluated({}, {{}}, starts.front());
  }
  Set best;
  double most = 2.0 * evaluation_of(known, best).log_likelihood;
  for (std::size_t round = 0; round < kSearchRounds && !starts.empty(); ++round) {
    const std::vector<Noise> from = std::move(starts);
    starts.clear();
    bool better = false;
    for (const Noise& start : from) {
      const Projected seen = now.projected_by(start);
      // The best few of every size.
      std::map<std::size_t, std::size_t> taken;
      std::vector<Set> sets;
      for (const Subset& subset : best_subsets(now.signatures(), seen, nullptr, now.largest_set())) {
        if (++taken[subset.signatures.size()] <= kBestOfEverySize) sets.push_back(subset.signatures);
      }
      known = now.evaluated(std::move(known), sets, start);
      for (const Set& set : sets) {
        const double value = 2.0 * evaluation_of(known, set).log_likelihood - kPrice * static_cast<double>(set.size());
        if (value <= most + kClearlyMore) continue;
        most = value;
        best = set;
        better = true;
      }
    }
    if (better) starts.push_back(evaluation_of(known, best).noise);
  }
  return {std::move(best), std::move(known)};
}

std::vector<Set> swaps(const SubsetFits& now, const Projected& seen, const Set& set) {
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
    const Eigen::VectorXd left = freed(seen.residual, basis);
    const Eigen::VectorXd along = seen.columns.transpose() * left;
    const Eigen::MatrixXd inside = basis.transpose() * seen.columns;
    const auto gain = [&](std::size_t index) {
      double sum = 0.0;
      for (Eigen::Index j = now.at(index).first; j < now.at(index).first + now.at(index).width; ++j) {
        const double survives = 1.0 - inside.col(j).squaredNorm();
        if (survives > kSurvives) sum += along[j] * along[j] / survives;
      }
      return sum;
    };
    const double own = gain(set[out]);
    std::vector<std::pair<double, Set>> places;
    for (std::size_t f = 0; f < now.signatures().families.size(); ++f) {
      const Family& family = now.signatures().families[f];
      const bool there = std::any_of(set.begin(), set.end(), [&](std::size_t i) { return now.at(i).family == f; });
      if (there && now.at(set[out]).family != f) continue;
      std::size_t best = family.first;
      for (std::size_t i = family.first; i < family.first + family.count; ++i) {
        if (gain(i) > gain(best)) best = i;
      }
      if (!(gain(best) > 0.0) || gain(best) < kNearlyAsMuch * own - kWorthRefitting) continue;
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

std::vector<std::size_t> in_place_of(const SubsetFits& now, const SubsetFit& whole, std::size_t place,
                                     const MaxScoreNull& null) {
  SubsetFit without;
  try {
    without = now.without(whole, place);
  } catch (const Error&) {
    return {};
  }
  const LinearisedFit& linearised = without.noise_fit.linearised;
  const Whitening whitening(whole.noise_fit.noise, linearised.time_s, linearised.sigma_um);
  const Projected seen = projected(now.signatures(), linearised.residual_um, linearised.model, whitening);
  const Eigen::VectorXd score = scores(now.signatures(), seen, seen.residual);
  const auto net = [&](std::size_t index) {
    return score[static_cast<Eigen::Index>(index)] - null.threshold(*now.bound(index).effect);
  };
  std::vector<std::size_t> best;
  double own = 0.0;
  for (std::size_t f = 0; f < now.signatures().families.size(); ++f) {
    const Family& family = now.signatures().families[f];
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
  while (taken < std::min(best.size(), kMostInPlace) && net(best[taken]) > kNearlyAsMuch * own - kWorthRefitting)
    ++taken;
  best.resize(taken);
  return best;
}

bool has(const SubsetFits& now, const Set& set, const BoundEffect& bound) {
  return std::any_of(set.begin(), set.end(), [&](std::size_t index) { return now.bound(index) == bound; });
}

bool is_without(const SubsetFits& now, const Set& set, const Set& whole, std::size_t place) {
  if (set.size() + 1 != whole.size()) return false;
  for (std::size_t k = 0; k < whole.size(); ++k) {
    if (k != place && !has(now, set, now.bound(whole[k]))) return false;
  }
  return true;
}

}  // namespace ballbar
