#include "ballbar/diagnosis.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "bank.hpp"
#include "best_subset.hpp"
#include "bindings.hpp"
#include "confirmation.hpp"
#include "evidence.hpp"
#include "prospects.hpp"
#include "search_null.hpp"
#include "smooth_rival.hpp"
#include "thinned.hpp"

namespace ballbar {
namespace {

constexpr double kChance = 0.01;
constexpr double kNearlyAsGood = 6.0;  // 2 ln L
constexpr double kWorthRefitting = 12.0;
constexpr double kGridError = 0.1;  // share of the evidence that a point of a grid may lack
constexpr std::size_t kRefitted = 14;
constexpr double kFewestEvidence = 25.0;  // d = 5
constexpr double kSmoothEvidence = 18.0;  // of a smooth curve that is more than noise
constexpr double kSameGain = 0.001;
constexpr double kWhite = 0.001;
constexpr std::size_t kShown = 8;
constexpr std::size_t kSearchRounds = 3;
constexpr Eigen::Index kFewest = 30;  // rows, for a noise that is estimated

using Set = std::vector<std::size_t>;  // signatures

struct Refitted {
  Set set;
  Model model;
  Fit fit;
  Leftover leftover;
  Noise noise;  // most likely
  double log_likelihood = 0.0;
  double penalised = 0.0;  // 2 ln L less thresholds
};

// Everything the steps share: data flows in once, figures are looked up.
class Case {
 public:
  Case(const Model& model, const Series& data, const Fit& base, const DiagnosisOptions& options)
      : model_(model), data_(data), options_(options), leftover_(leftover_of(base)) {
    BankOptions bank_options;
    bank_options.motion = options.motion;
    bank_ = bank_of(model, data, base, bank_options);
  }

  const Bank& bank() const { return bank_; }
  const Leftover& leftover() const { return leftover_; }
  const Signature& at(std::size_t index) const { return bank_.signatures[index]; }
  const Family& family(std::size_t index) const { return bank_.families[at(index).family]; }
  BoundEffect bound(std::size_t index) const { return {family(index).effect, family(index).columns}; }
  const Series& data() const { return data_; }

  Eigen::MatrixXd columns(const Set& set) const {
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

  Projected projected_by(const Noise& noise) const {
    return projected(bank_, leftover_.residual_um, leftover_.model,
                     Whitening(noise, leftover_.time_s, leftover_.sigma_um));
  }

  // The noise from which an evaluation starts matters for few rows alone: then all that was evaluated before is
  // forgotten.
  void forget() { evaluated_.clear(); }

  const Explained& evaluated(const Set& set, const Noise& start) {
    Set key = set;
    std::sort(key.begin(), key.end());
    const auto known = evaluated_.find(key);
    if (known != evaluated_.end()) return known->second;
    return evaluated_.emplace(std::move(key), explained(leftover_, columns(set), start)).first->second;
  }

  // Without the effect at `place` of the set, by the noise with it: the shapes of the model start from where they are.
  Refitted without(const Refitted& whole, std::size_t place) const {
    Refitted result = whole;
    const std::size_t term = model_.terms.size() + place;
    result.set.erase(result.set.begin() + static_cast<std::ptrdiff_t>(place));
    std::size_t parameter = 1;
    for (Term& one : result.model.terms) {
      for (Setting& setting : one.settings) {
        setting.start = std::clamp(whole.fit.parameters[parameter++].value, setting.lower, setting.upper);
        setting.stated = true;
      }
    }
    result.model.terms.erase(result.model.terms.begin() + static_cast<std::ptrdiff_t>(term));
    FitOptions options;
    options.noise = whole.noise;
    result.fit = fit(result.model, data_, target_index(), options);
    result.leftover = leftover_of(result.fit);
    const Explained rest =
        explained(result.leftover, Eigen::MatrixXd(result.leftover.residual_um.size(), 0), result.fit.noise, 2);
    result.log_likelihood = rest.log_likelihood;
    return result;
  }

  // Terms of the set added to the model, shapes free from their grid point, held ones held there; fitted.
  Refitted refitted(const Set& set, const Noise& noise) const {
    Refitted result{set, model_, {}, {}, {}, 0.0, 0.0};
    for (const std::size_t index : set) {
      Term term = term_of(family(index).effect->name, family(index).columns, model_.level);
      for (std::size_t k = 0; k < term.settings.size(); ++k) {
        if (term.effect->parameters[k].kind != ParameterKind::shape) continue;
        Setting& setting = term.settings[k];
        setting.start = std::clamp(at(index).point[k], setting.lower, setting.upper);
        setting.stated = true;
      }
      result.model.terms.push_back(std::move(term));
    }
    FitOptions options;
    options.noise = noise;
    result.fit = fit(result.model, data_, target_index(), options);
    result.leftover = leftover_of(result.fit);
    const Explained rest =
        explained(result.leftover, Eigen::MatrixXd(result.leftover.residual_um.size(), 0), result.fit.noise, 2);
    result.noise = rest.noise;
    result.log_likelihood = rest.log_likelihood;
    return result;
  }

  std::size_t target_index() const { return target_; }
  void set_target(std::size_t target) { target_ = target; }
  const Model& model() const { return model_; }

 private:
  const Model& model_;
  const Series& data_;
  const DiagnosisOptions& options_;
  std::size_t target_ = 0;
  Leftover leftover_;
  Bank bank_;
  std::map<Set, Explained> evaluated_;
};

std::size_t largest_set(const Leftover& leftover) {
  const auto n = static_cast<std::size_t>(leftover.residual_um.size());
  const auto p = static_cast<std::size_t>(leftover.model.cols());
  return n <= p ? 0 : std::min<std::size_t>(3, (n - p) / 4);
}

// The noise under which the best set is judged: from the base residual and from the residual of the best sets found so
// far, whichever makes the data most likely.
Set best_set(Case& now, const Noise& base_noise, double base_log_likelihood, std::size_t largest, Noise& noise) {
  constexpr double kPrice = 14.0;  // of an effect, before its threshold is known
  Noise white = base_noise;
  white.white_um =
      std::sqrt(base_noise.white_um * base_noise.white_um + base_noise.correlated_um * base_noise.correlated_um);
  white.correlated_um = 0.0;
  std::vector<Noise> starts{base_noise};
  if (base_noise.correlated_um > 0.0) starts.push_back(white);
  Set best;
  double most = 2.0 * base_log_likelihood;
  noise = base_noise;
  if (now.leftover().residual_um.size() < kFewest && !now.leftover().sigma_um.empty()) {
    // What is stated, nothing more; all is judged by it.
    now.forget();
    noise = {};
    starts = {noise};
    most = 2.0 * now.evaluated({}, noise).log_likelihood;
  }
  std::vector<Set> tried;
  for (std::size_t round = 0; round < kSearchRounds && !starts.empty(); ++round) {
    const std::vector<Noise> from = std::move(starts);
    starts.clear();
    bool better = false;
    for (const Noise& start : from) {
      const Projected seen = now.projected_by(start);
      std::vector<Subset> subsets = best_subsets(now.bank(), seen, nullptr, largest);
      // The best few of every size.
      std::map<std::size_t, std::size_t> taken;
      for (const Subset& subset : subsets) {
        if (++taken[subset.signatures.size()] > 5) continue;
        const Explained& found = now.evaluated(subset.signatures, start);
        const double value = 2.0 * found.log_likelihood - kPrice * static_cast<double>(subset.signatures.size());
        if (value <= most + 0.5) continue;
        most = value;
        best = subset.signatures;
        noise = found.noise;
        better = true;
      }
    }
    if (better) starts.push_back(noise);
  }
  return best;
}

// The best shape of every family in the place of one of the set, those that explain nearly as much.
std::vector<Set> swaps(const Case& now, const Projected& seen, const Set& set) {
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
    for (std::size_t f = 0; f < now.bank().families.size(); ++f) {
      const Family& family = now.bank().families[f];
      const bool there = std::any_of(set.begin(), set.end(), [&](std::size_t i) { return now.at(i).family == f; });
      if (there && now.at(set[out]).family != f) continue;
      std::size_t best = family.first;
      for (std::size_t i = family.first; i < family.first + family.count; ++i) {
        if (gain(i) > gain(best)) best = i;
      }
      if (gain(best) < 0.8 * own - kWorthRefitting) continue;
      Set swapped = others;
      swapped.push_back(best);
      result.push_back(std::move(swapped));
    }
  }
  return result;
}

bool has(const Case& now, const Set& set, const BoundEffect& bound) {
  return std::any_of(set.begin(), set.end(), [&](std::size_t index) { return now.bound(index) == bound; });
}

double thresholds(const Case& now, const SearchNull& null, const Set& set) {
  double sum = 0.0;
  for (const std::size_t index : set) sum += null.threshold(*now.family(index).effect);
  return sum;
}

// Of the residual freed of the model's columns.
double chi2(const Leftover& leftover, const Noise& noise) {
  const Whitening whitening(noise, leftover.time_s, leftover.sigma_um);
  const auto whitened = [&](const Eigen::VectorXd& column) {
    Eigen::VectorXd out(column.size());
    whitening.apply(column.data(), 1, out.data(), 1);
    return out;
  };
  Eigen::MatrixXd x(leftover.model.rows(), leftover.model.cols());
  for (Eigen::Index k = 0; k < x.cols(); ++k) x.col(k) = whitened(leftover.model.col(k));
  const Eigen::MatrixXd basis = orthonormal(x);
  const Eigen::VectorXd r = whitened(leftover.residual_um);
  return r.squaredNorm() - (basis.transpose() * r).squaredNorm();
}

// Columns of the Jacobian that are gains of the term.
Eigen::MatrixXd gain_columns(const Fit& fit, const Model& model, std::size_t term) {
  Eigen::Index offset = 1;
  for (std::size_t t = 0; t < term; ++t) offset += static_cast<Eigen::Index>(model.terms[t].settings.size());
  std::vector<Eigen::Index> gains;
  const std::vector<Parameter>& parameters = model.terms[term].effect->parameters;
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    if (parameters[k].kind == ParameterKind::gain) gains.push_back(offset + static_cast<Eigen::Index>(k));
  }
  return fit.jacobian(Eigen::all, gains);
}

Candidate candidate_of(const Case& now, const Refitted& with, std::size_t place) {
  Candidate candidate;
  candidate.bound = now.bound(with.set[place]);
  const std::size_t term = now.model().terms.size() + place;
  std::size_t first = 1;
  for (std::size_t t = 0; t < term; ++t) first += with.model.terms[t].settings.size();
  const std::vector<Parameter>& parameters = candidate.bound.effect->parameters;
  double relative = 0.0;
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    const FittedParameter& fitted = with.fit.parameters[first + k];
    candidate.parameters.push_back(fitted);
    if (parameters[k].kind == ParameterKind::gain && fitted.value != 0.0) {
      const double one = std::abs(fitted.sigma / fitted.value);
      relative = relative == 0.0 ? one : std::min(relative, one);
    }
  }
  const auto [low, high] =
      std::minmax_element(with.fit.contribution_um[term].begin(), with.fit.contribution_um[term].end());
  candidate.amplitude_um = *high - *low;
  candidate.amplitude_sigma_um = relative * candidate.amplitude_um;
  candidate.rmse_after_um = with.fit.rmse_um;
  return candidate;
}

// Effects that stand in the place of one of the best set in a set that explains nearly as much, one group for each.
std::vector<std::vector<BoundEffect>> groups_of(const Case& now, const Projected& seen, const Refitted& best,
                                                const std::vector<const Refitted*>& rivals) {
  std::vector<std::vector<BoundEffect>> groups;
  for (const std::size_t index : best.set) groups.push_back({now.bound(index)});
  for (const Refitted* rival : rivals) {
    for (const std::size_t extra : rival->set) {
      if (has(now, best.set, now.bound(extra))) continue;
      // In the place of the one it is most like.
      double most = -1.0;
      std::size_t place = groups.size();
      for (std::size_t m = 0; m < best.set.size(); ++m) {
        if (has(now, rival->set, now.bound(best.set[m]))) continue;
        const double alike =
            std::abs(seen.columns.col(now.at(best.set[m]).first).dot(seen.columns.col(now.at(extra).first)));
        if (alike > most) {
          most = alike;
          place = m;
        }
      }
      if (place == groups.size()) continue;
      std::vector<BoundEffect>& group = groups[place];
      if (std::find(group.begin(), group.end(), now.bound(extra)) == group.end()) group.push_back(now.bound(extra));
    }
  }
  return groups;
}

}  // namespace

std::string_view name_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::named:
      return "named";
    case Verdict::equivalent:
      return "equivalent";
    case Verdict::unexplained:
      return "unexplained";
    case Verdict::untestable:
      return "untestable";
    case Verdict::nothing:
      return "nothing";
  }
  return "nothing";
}

std::string label_of(const BoundEffect& bound) {
  // On recordings the columns are the trace's own.
  if (bound.columns.empty() || bound.effect->level == Level::recording) return bound.effect->name;
  return fmt::format("{}({})", bound.effect->name, fmt::join(bound.columns, ", "));
}

Diagnosis diagnose(const Model& model, const Series& all, std::size_t target, const DiagnosisOptions& options) {
  const Series data = thinned(all, model.targets.at(target), options.most_rows);
  Diagnosis result;
  result.base = fit(model, data, target);
  result.target = result.base.target;
  result.base_whiteness = whiteness(result.base);
  Case now(model, data, result.base, options);
  now.set_target(target);
  result.searched_signatures = now.bank().signatures.size();
  std::set<const Effect*> searched;
  for (const Family& family : now.bank().families) searched.insert(family.effect);
  result.searched_effects = searched.size();
  const std::size_t largest = largest_set(now.leftover());
  if (now.bank().families.empty() || largest == 0) {
    result.verdict = Verdict::untestable;
    result.reasons.emplace_back(now.bank().families.empty() ? "No effect of the catalogue can be tested on these data."
                                                            : "There are too few values to test anything more.");
    return result;
  }

  const Noise base_noise = now.evaluated({}, result.base.noise).noise;
  double base_log_likelihood = now.evaluated({}, result.base.noise).log_likelihood;
  Noise noise;
  Set first = best_set(now, base_noise, base_log_likelihood, largest, noise);
  const Eigen::MatrixXd first_columns = now.columns(first);
  noise = restricted_noise(now.leftover(), first_columns, now.evaluated(first, noise).residual_um);
  if (now.leftover().residual_um.size() < kFewest) {
    now.forget();
    base_log_likelihood = now.evaluated({}, noise).log_likelihood;
  }
  const Projected seen = now.projected_by(noise);
  const SearchNull null = search_null(now.bank(), seen, now.leftover(), noise,
                                      plausible_noises(now.leftover(), first_columns, noise, 64, options.seed),
                                      options.draws, options.seed);
  result.prospects = prospects_of(now.bank(), seen, model, data, options.motion);
  const Eigen::VectorXd score = scores(now.bank(), seen, seen.residual);
  result.smallest_um = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < now.bank().signatures.size(); ++i) {
    const Effect& effect = *now.family(i).effect;
    result.p_anything = std::min(result.p_anything, null.p_search(effect, score[static_cast<Eigen::Index>(i)]));
    if (seen.share[i] < 0.05) continue;
    const double um = std::sqrt(null.threshold(effect)) * now.at(i).range_um / seen.norm[i];
    if (um >= result.smallest_um) continue;
    result.smallest_um = um;
    result.smallest = now.bound(i);
  }

  // Every set worth a look by its likelihood, the noise estimated anew for each.
  std::vector<Set> sets;
  for (const Subset& subset : best_subsets(now.bank(), seen, &null, largest)) {
    sets.push_back(subset.signatures);
    if (sets.size() == 20) break;
  }
  if (!first.empty()) sets.push_back(first);
  const auto penalised = [&](const Set& set) {
    return 2.0 * now.evaluated(set, noise).log_likelihood - thresholds(now, null, set);
  };
  const auto by_likelihood = [&](const Set& a, const Set& b) { return penalised(a) > penalised(b); };
  std::stable_sort(sets.begin(), sets.end(), by_likelihood);
  for (Set& swapped : swaps(now, seen, sets.front())) sets.push_back(std::move(swapped));
  std::stable_sort(sets.begin(), sets.end(), by_likelihood);

  const bool few = now.leftover().residual_um.size() < kFewest;
  const SmoothRival smooth = smooth_rival(now.leftover(), few ? noise : base_noise);
  result.smooth_evidence = 2.0 * (smooth.log_likelihood - base_log_likelihood);
  const bool something = result.p_anything < kChance && penalised(sets.front()) > 2.0 * base_log_likelihood;
  if (!something) {
    result.verdict = result.smooth_evidence > kSmoothEvidence ? Verdict::unexplained : Verdict::nothing;
    if (result.verdict == Verdict::unexplained) {
      result.reasons.emplace_back("Something slow is left, and no effect of the catalogue has its shape.");
    }
  }

  const double allowance =
      kWorthRefitting +
      kGridError * std::max(0.0, 2.0 * (now.evaluated(sets.front(), noise).log_likelihood - base_log_likelihood));
  std::vector<Refitted> refits;
  std::vector<std::vector<std::string>> done;
  const auto refit = [&](const Set& set) {
    std::vector<std::string> key;
    for (const std::size_t index : set) key.push_back(label_of(now.bound(index)));
    std::sort(key.begin(), key.end());
    if (std::find(done.begin(), done.end(), key) != done.end()) return;
    done.push_back(std::move(key));
    refits.push_back(now.refitted(set, noise));
    refits.back().penalised = 2.0 * refits.back().log_likelihood - thresholds(now, null, set);
  };
  const auto sort_refits = [&] {
    std::stable_sort(refits.begin(), refits.end(),
                     [](const Refitted& a, const Refitted& b) { return a.penalised > b.penalised; });
  };
  for (const Set& set : sets) {
    if (refits.size() == kRefitted || penalised(set) < penalised(sets.front()) - allowance) break;
    refit(set);
  }
  sort_refits();
  // What a point of the grid lacked another effect may have filled in: with free shapes it may not be needed.
  for (std::size_t before = 0; before != refits.size() && refits.front().set.size() > 1;) {
    before = refits.size();
    const Set whole = refits.front().set;
    for (std::size_t out = 0; out < whole.size(); ++out) {
      Set fewer = whole;
      fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(out));
      refit(fewer);
    }
    sort_refits();
  }
  const Refitted& best = refits.front();
  result.rmse_after_um = best.fit.rmse_um;

  // Every effect of the best set beside the rest of it.
  const std::vector<std::size_t> cycle = cycles_of(data, result.base.row);
  std::vector<bool> sound(best.set.size(), true);
  for (std::size_t m = 0; m < best.set.size(); ++m) {
    Candidate candidate = candidate_of(now, best, m);
    candidate.in_best_set = true;
    const Refitted without = now.without(best, m);
    const Effect& effect = *candidate.bound.effect;
    candidate.evidence = 2.0 * (best.log_likelihood - without.log_likelihood);
    candidate.threshold = null.threshold(effect);
    candidate.p_search = null.p_search(effect, candidate.evidence);
    const HeldOut before = held_out(without.leftover, best.noise, cycle),
                  after = held_out(best.leftover, best.noise, cycle);
    candidate.held_out_before_um = before.rmse_um;
    candidate.held_out_after_um = after.rmse_um;
    candidate.p_same_gain =
        p_same_gain(best.leftover, gain_columns(best.fit, best.model, model.terms.size() + m), best.noise, cycle);
    if (!effect.time_only && model.level == Level::series) {
      const BestFake fake = best_fake(now.family(best.set[m]), now.bank(), data, best.fit.row, without.leftover,
                                      best.noise, options.fakes, options.seed);
      candidate.best_fake_gain = fake.gain;
      candidate.beats_fakes = chi2(without.leftover, best.noise) - chi2(best.leftover, best.noise) > fake.gain;
      result.best_fake_fall = std::max(result.best_fake_fall, fake.fall);
    } else {
      candidate.beats_fakes = model.level == Level::recording;
    }
    candidate.minor = candidate.amplitude_um < std::max(0.05 * result.base.rmse_um, options.tolerance_um);
    const std::string name = label_of(candidate.bound);
    const auto fails = [&](const std::string& why) {
      sound[m] = false;
      result.reasons.push_back(name + ": " + why);
    };
    if (effect.time_only) {
      fails("it needs nothing but time, so that one run cannot name it as a cause.");
    } else {
      if (candidate.evidence < kFewestEvidence) fails("its evidence is below 25 (d = 5).");
      if (candidate.p_search >= kChance) fails("a search without any effect shows as much too often.");
      if (candidate.p_same_gain < kSameGain) fails("its gain differs from cycle to cycle.");
      if (!(candidate.held_out_after_um < candidate.held_out_before_um))
        fails("cycles left out are not predicted better.");
      if (!candidate.beats_fakes) fails("a fake of the same smoothness does as well.");
    }
    result.candidates.push_back(std::move(candidate));
  }

  const SmoothRival remainder = smooth_rival(best.leftover, best.noise);
  const double left_evidence = 2.0 * (remainder.log_likelihood - best.log_likelihood);
  const bool beats_smooth = best.log_likelihood > smooth.log_likelihood;
  const Whiteness white = whiteness(best.fit);
  const bool adequate = left_evidence < kSmoothEvidence && white.p >= kWhite;
  std::vector<const Refitted*> rivals;
  for (const Refitted& other : refits) {
    if (&other != &best && other.penalised > best.penalised - kNearlyAsGood) rivals.push_back(&other);
  }
  const std::vector<std::vector<BoundEffect>> groups = groups_of(now, seen, best, rivals);
  // Rivals as candidates too, then the strongest singles.
  for (const Refitted& other : refits) {
    for (std::size_t m = 0; m < other.set.size() && result.candidates.size() < kShown; ++m) {
      const BoundEffect bound = now.bound(other.set[m]);
      const bool there = std::any_of(result.candidates.begin(), result.candidates.end(),
                                     [&](const Candidate& candidate) { return candidate.bound == bound; });
      if (there) continue;
      Candidate candidate = candidate_of(now, other, m);
      candidate.threshold = null.threshold(*bound.effect);
      Set others = other.set;
      others.erase(others.begin() + static_cast<std::ptrdiff_t>(m));
      candidate.evidence = 2.0 * (other.log_likelihood - now.evaluated(others, noise).log_likelihood);
      candidate.p_search = null.p_search(*bound.effect, candidate.evidence);
      candidate.held_out_before_um = held_out(now.leftover(), noise, cycle).rmse_um;
      candidate.held_out_after_um = held_out(other.leftover, other.noise, cycle).rmse_um;
      result.candidates.push_back(std::move(candidate));
    }
  }
  for (const std::vector<BoundEffect>& group : groups) {
    for (Candidate& candidate : result.candidates) {
      if (std::find(group.begin(), group.end(), candidate.bound) == group.end()) continue;
      for (const BoundEffect& other : group) {
        if (!(other == candidate.bound)) candidate.inseparable_from.push_back(label_of(other));
      }
    }
  }
  if (!something) return result;

  if (!adequate) {
    result.verdict = Verdict::unexplained;
    result.reasons.emplace_back("What the best effects leave is not noise.");
    return result;
  }
  if (!beats_smooth) {
    result.verdict = Verdict::unexplained;
    result.reasons.emplace_back("A smooth curve without any cause explains the data better.");
    return result;
  }
  const bool varying =
      std::any_of(result.candidates.begin(), result.candidates.begin() + static_cast<std::ptrdiff_t>(best.set.size()),
                  [](const Candidate& candidate) { return candidate.p_same_gain < kSameGain; });
  if (varying) {
    result.verdict = Verdict::unexplained;
    return result;
  }
  for (std::size_t m = 0; m < groups.size(); ++m) {
    if (groups[m].size() == 1 && sound[m]) {
      result.named.push_back(groups[m].front());
    } else {
      result.equivalent.push_back(groups[m]);
    }
  }
  result.verdict = result.named.empty() ? Verdict::equivalent : Verdict::named;
  return result;
}

}  // namespace ballbar
