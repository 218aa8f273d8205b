#include "diagnosis/posterior/search.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "ballbar/numerics/parallel.hpp"
#include "diagnosis/evidence/shape_fit.hpp"
#include "diagnosis/posterior/conditional_fit.hpp"
#include "diagnosis/posterior/hyperparameters.hpp"
#include "diagnosis/posterior/robust.hpp"
#include "diagnosis/posterior/sets.hpp"

namespace ballbar {
namespace {

constexpr int kRelinearised = 3;             // times
constexpr double kSameModel = 0.02;          // of a shape's reach
constexpr double kOtherStart = 0.3;          // of a shape's reach
constexpr double kUsualTime_s = 1500.0;      // for the time constants of a model whose fit has diverged
constexpr std::size_t kSharpenedRivals = 4;  // rivals of a single effect whose shapes are refined
constexpr double kFarRival = 7.0;            // ln: a rival so much weaker than the strongest is ignored
constexpr double kFarMode = 7.0;             // ln: a mode so much less likely than the best is ignored
constexpr double kOfGrid = 0.1;              // more, of the evidence gained: a coarse grid may cost so much
constexpr double kSearched = 1e-5;           // tolerance of a search
constexpr double kBetter = 0.01;             // ln: smallest improvement

class Search {
 public:
  Search(Problem& problem, std::size_t largest) : problem_(problem), largest_(largest) {}

  SearchResult run() {
    const std::vector<double> fit = fitted_parameters(problem_);
    note_outliers(fit);
    std::vector<Variant> starts{variant_at(problem_, 0, fit)};
    take_covariances(beside_any_forms(problem_, starts.front()));
    if (problem_.tuning.starts) add_starts(fit, starts);
    std::vector<Variant> of_own;
    for (OwnParameter& own : problem_.own) of_own.push_back(variant_with_own(own, fit, starts.front().times));
    const std::vector<Covariance> covariances = covariances_, pilots = pilots_;
    SearchResult best = found_from(std::move(starts));
    if (!problem_.tuning.starts_of_held_values) of_own.clear();
    // Where a held value is another one, the model has other parameters, too far for the linear model.
    for (Variant& variant : of_own) {
      covariances_ = covariances;
      pilots_ = pilots;
      SearchResult other = found_from({std::move(variant)});
      if (other.best.log_weight > best.best.log_weight + kBetter) best = std::move(other);
    }
    return best;
  }

 private:
  // The readings of all kinds of covariance, or the given ones, the likeliest first.
  void take_covariances(const Variant& beside) {
    if (!problem_.covariances.empty()) {
      std::vector<std::pair<double, Covariance>> given;
      for (const Covariance& one : problem_.covariances) {
        const Point point = point_at(problem_, one);
        const Gram gram = gram_of(point.filter, beside.pool);
        given.emplace_back(log_evidence(linear_solution(gram, beside.line, problem_.known)) + one.log_prior, one);
      }
      std::stable_sort(given.begin(), given.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
      covariances_.clear();
      for (const auto& [weight, one] : given) covariances_.push_back(one);
      pilots_.assign(covariances_.begin(),
                     covariances_.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(2, covariances_.size())));
      return;
    }
    const std::vector<Discrepancy> kinds = discrepancies_of(problem_);
    const std::vector<Covariance> before = std::exchange(covariances_, std::vector<Covariance>(kinds.size()));
    std::vector<double> weight(kinds.size());
    in_parallel(kinds.size(), [&](std::size_t k) {
      covariances_[k] = likeliest_covariance(problem_, beside, kinds[k], before.empty() ? nullptr : &before[k]);
      const Gram gram = gram_of(point_at(problem_, covariances_[k]).filter, beside.pool);
      weight[k] = log_evidence(linear_solution(gram, beside.line, problem_.known));
    });
    pilots_ = {covariances_.front()};
    if (kinds.size() > 1 && problem_.tuning.second_pilot) pilots_.push_back(covariances_[weight[1] > weight[2] ? 1 : 2]);
  }

  // Readings far from the others count less, and three or more jumps of the target are levels of their own. Both beside
  // the richest model: a missing effect would make its own readings outliers.
  void note_outliers(const std::vector<double>& fit) {
    if (!problem_.covariances.empty() || problem_.model.level != Level::series) return;
    Variant rich = beside_any_forms(problem_, variant_at(problem_, 0, fit));
    Covariance covariance = likeliest_covariance(problem_, rich, Discrepancy::none);
    problem_.level_jumps = level_jumps(problem_, residual_beside(problem_, rich, point_at(problem_, covariance)));
    if (!problem_.level_jumps.empty()) {
      rich = beside_any_forms(problem_, variant_at(problem_, 0, fit));
      covariance = likeliest_covariance(problem_, rich, Discrepancy::none);
    }
    weigh_down_outliers(problem_, rich, point_at(problem_, covariance));
  }

  // The covariances beside what the best sum explains.
  void settle() {
    if (!problem_.covariances.empty()) return;
    take_covariances(beside_mean_of(best_.ascent, identities_, *variant_));
    best_ = best_at_pilots(*variant_, identities_, likeliest_set(best_.ascent));
  }

  SearchResult found_from(std::vector<Variant> starts) {
    variant_.reset();
    open_ = {};
    for (Variant& variant : starts) {
      Identities identities = identities_of(problem_, variant);
      WeightedAscent found = best_at_pilots(variant, identities, {});
      if (variant_ && !(found.log_weight > best_.log_weight + kBetter)) continue;
      take(std::move(variant), std::move(identities), std::move(found));
    }
    settle();
    std::vector<Mode> modes;
    for (int round = 0; round < (problem_.tuning.relinearised ? kRelinearised : 1); ++round) {
      int step = 0;
      while (step < (problem_.tuning.relinearised ? kRelinearised : 1) && relinearise()) ++step;
      bool is_better = false;
      modes = other_modes(is_better);
      if (!is_better) break;
    }
    return {covariances_, std::move(*variant_), std::move(identities_), std::move(best_), std::move(modes)};
  }

  // The model about what noise with a memory makes of it.
  void add_starts(const std::vector<double>& fit, std::vector<Variant>& starts) const {
    const auto add = [&](const Point& point, std::vector<double> from, int rounds) {
      const ShapeFit there = shape_fit(*problem_.base_model, std::move(from), {}, starts.front().times,
                                                    point.filter, problem_.known, {rounds, kSearched});
      if (std::all_of(starts.begin(), starts.end(), [&](const Variant& other) {
            return is_elsewhere(problem_, other, there.parameters, kOtherStart);
          }))
        starts.push_back(variant_at(problem_, 0, there.parameters));
    };
    const std::vector<double> usual = with_times(problem_, fit, kUsualTime_s);
    for (const Covariance& one : pilots_) {
      const Point point = point_at(problem_, one);
      for (const std::vector<double>& from : {fit, usual}) add(point, from, 12);
    }
    // A missing effect biases the fitted time constants, so that one start uses typical ones.
    add(point_at(problem_, pilots_.front()), usual, 0);
  }

  // The model where a held value is another one, which is remembered; of the line it is held.
  Variant variant_with_own(OwnParameter& own, std::vector<double> from, const Eigen::MatrixXd& times) const {
    const ShapeFit refined_there =
        shape_fit(*problem_.base_model, std::move(from), {own.parameter}, times,
                         point_at(problem_, pilots_.front()).filter, problem_.known, {12, kSearched});
    std::vector<double> parameters = refined_there.parameters;
    own.fitted.push_back(parameters[own.parameter]);
    return variant_at(problem_, 0, held_again(own, std::move(parameters), times));
  }

  // The parameters with this one at the value that the model holds, the gains to it: what is not known of times is in
  // units of the gains.
  std::vector<double> held_again(const OwnParameter& own, std::vector<double> parameters,
                                 const Eigen::MatrixXd& times) const {
    parameters[own.parameter] = own.held;
    return shape_fit(*problem_.base_model, std::move(parameters), {}, times,
                            point_at(problem_, pilots_.front()).filter, problem_.known, {0})
        .parameters;
  }

  void take(Variant variant, Identities identities, WeightedAscent found) {
    variant_ = std::move(variant);
    identities_ = std::move(identities);
    best_ = std::move(found);
  }

  // At the likelier pilot; the ascent begins with a set, with nothing where there is none.
  WeightedAscent best_at_pilots(const Variant& variant, const Identities& identities,
                                const std::vector<std::size_t>& set) const {
    std::vector<WeightedAscent> found(pilots_.size());
    in_parallel(pilots_.size(), [&](std::size_t g) {
      found[g].point = point_at(problem_, pilots_[g]);
      ColumnsAt at(problem_, identities, variant, found[g].point);
      const AscentOptions options = ascent_options(problem_, identities, largest_, Forms::no);
      found[g].ascent = ascended_from(at, identities, options, set);
      found[g].log_weight = found[g].ascent.bound + pilots_[g].log_prior;
    });
    sort_by_weight(found);
    return std::move(found.front());
  }

  // Of one single effect the identities of the catalogue, the strongest first. Where an input of any form is stronger
  // the shapes of all are too coarse to tell which is near.
  std::vector<std::size_t> effects_of(const SingleEffect& one) const {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < problem_.effects; ++i) {
      if (one.strength[i] > kLogZero) order.push_back(i);
    }
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return one.strength[a] > one.strength[b]; });
    if (order.empty()) return order;
    const double strongest = one.strength[order.front()];
    const double far = strongest - kFarRival - kOfGrid * std::max(0.0, strongest);
    while (order.size() > 1 && one.strength[order.back()] < far) order.pop_back();
    return order;
  }

  // A set of effects, and for each place in it the rivals.
  struct Rivals {
    std::vector<std::size_t> signatures;
    std::vector<std::vector<std::size_t>> others;
  };

  Rivals rivals_of(const Ascent& ascent) {
    Rivals result;
    for (const SingleEffect& one : ascent.effects) {
      if (one.p_any() < 0.5) continue;
      if (identities_.is_own(likeliest_identity(one))) continue;
      const std::vector<std::size_t> order = effects_of(one);
      std::vector<std::size_t> shapes;
      for (std::size_t k = 0; k < std::min(order.size(), problem_.tuning.finer_rivals ? kSharpenedRivals : 1); ++k) {
        if (const auto shape = signature_of(problem_, identities_, one.likeliest[order[k]])) shapes.push_back(*shape);
      }
      if (shapes.empty()) continue;
      result.signatures.push_back(shapes.front());
      result.others.emplace_back(shapes.begin() + 1, shapes.end());
    }
    return result;
  }

  // The shapes of a set and of its rivals at their likeliest become signatures. In `open`, of all: what logs leave open
  // of the times of an input is open for each effect that reads it, or the one that needs no time would win.
  // `variant`: the model, with a held value free where it is another one.
  ConditionalFit sharpened_with_rivals(const Variant& variant, const Rivals& rivals, ConditionalFit conditional,
                                       ConditionalFit& open) {
    if (!rivals.signatures.empty()) conditional = sharpened(problem_, variant, std::move(conditional), best_.point);
    const auto add = [&](const ConditionalFit& from, std::size_t place) {
      const std::size_t signature = from.signatures[place];
      if (std::find(open.signatures.begin(), open.signatures.end(), signature) != open.signatures.end()) return;
      Eigen::Index first = 0;
      for (std::size_t m = 0; m < place; ++m) first += problem_.library.signatures[from.signatures[m]].width;
      const Eigen::Index width = problem_.library.signatures[signature].width, size = open.coefficients.size();
      open.signatures.push_back(signature);
      open.coefficients.conservativeResize(size + width);
      open.coefficients.tail(width) = from.coefficients.segment(first, width);
    };
    for (std::size_t m = 0; m < conditional.signatures.size(); ++m) add(conditional, m);
    for (std::size_t m = 0; m < rivals.others.size(); ++m) {
      for (const std::size_t rival : rivals.others[m]) {
        ConditionalFit other{conditional.signatures, conditional.parameters, {}};
        other.signatures[m] = rival;
        add(sharpened(problem_, variant, std::move(other), best_.point), m);
      }
    }
    return conditional;
  }

  // The held value that is more likely wrong than right.
  std::optional<std::size_t> likeliest_own(const Ascent& ascent) const {
    for (const std::size_t i : likeliest_set(ascent)) {
      if (identities_.is_own(i)) return i - identities_.families;
    }
    return std::nullopt;
  }

  // The model about where the best sum has its parameters, the shapes of its effects and of their rivals at their
  // likeliest. False: it is there already.
  bool relinearise() {
    const Ascent& ascent = best_.ascent;
    const std::size_t before = problem_.library.signatures.size();
    const std::vector<std::size_t> set = likeliest_set(ascent);
    const Rivals rivals = rivals_of(ascent);
    const std::optional<std::size_t> own = likeliest_own(ascent);
    bool is_new = false;
    ConditionalFit open{{}, {}, {}};
    ConditionalFit conditional;
    if (own) {
      OwnParameter& parameter = problem_.own[*own];
      std::vector<double> parameters = variant_->parameters;
      parameters[parameter.parameter] = parameter.fitted.back();
      const Variant freed = variant_at(problem_, *own + 1, std::move(parameters));
      conditional =
          sharpened_with_rivals(freed, rivals, conditional_fit(problem_, freed, rivals.signatures, best_.point), open);
      const double value = conditional.parameters[parameter.parameter];
      is_new = std::abs(value - parameter.fitted.back()) > kSameModel * std::abs(parameter.held);
      if (is_new) parameter.fitted.push_back(value);
      conditional.parameters = held_again(parameter, std::move(conditional.parameters), variant_->times);
    } else {
      conditional = sharpened_with_rivals(*variant_, rivals,
                                          conditional_fit(problem_, *variant_, rivals.signatures, best_.point), open);
    }
    open.parameters = conditional.parameters;
    is_new = is_new || problem_.library.signatures.size() > before || !are_open(open.signatures) ||
             is_elsewhere(problem_, *variant_, conditional.parameters, kSameModel);
    if (!is_new) return false;
    open_times(std::move(open), set);
    return true;
  }

  // The model at these parameters, the times of these signatures' inputs open; the best sum from a set on.
  void open_times(ConditionalFit open, const std::vector<std::size_t>& set) {
    open_ = std::move(open);
    Variant variant = variant_at(problem_, 0, open_.parameters, input_times_of(problem_, open_));
    Identities identities = identities_of(problem_, variant);
    WeightedAscent found = best_at_pilots(variant, identities, set);
    take(std::move(variant), std::move(identities), std::move(found));
  }

  bool are_open(const std::vector<std::size_t>& signatures) const {
    return std::all_of(signatures.begin(), signatures.end(), [&](std::size_t i) {
      return std::find(open_.signatures.begin(), open_.signatures.end(), i) != open_.signatures.end();
    });
  }

  double bound_without_effects() const {
    ColumnsAt at(problem_, identities_, *variant_, best_.point);
    return ascended(at, identities_, ascent_options(problem_, identities_, 0, Forms::no)).bound;
  }

  // Sums without one of the best sum's identities that are nearly as likely, the shapes of their effects at their
  // likeliest. A sum that proves likelier becomes the best one: is_better.
  std::vector<Mode> other_modes(bool& is_better) {
    std::vector<Mode> modes;
    std::vector<std::size_t> best_set = likeliest_set(best_.ascent);
    std::erase_if(best_set, [&](std::size_t i) { return identities_.is_own(i); });
    if (!problem_.tuning.other_modes) best_set.clear();
    std::vector<Ascent> others(best_set.size());
    in_parallel(best_set.size(), [&](std::size_t k) {
      ColumnsAt at(problem_, identities_, *variant_, best_.point);
      const AscentOptions options = ascent_options(problem_, identities_, largest_, Forms::no, best_set[k]);
      others[k] = ascended(at, identities_, options);
    });
    const double gained = best_.ascent.bound - bound_without_effects();
    ConditionalFit open = open_;
    const std::size_t before = problem_.library.signatures.size();
    for (std::size_t k = 0; k < others.size(); ++k) {
      if (others[k].bound < best_.ascent.bound - kFarMode - kOfGrid * gained) continue;
      modes.push_back({best_set[k], likeliest_set(others[k])});
      const Rivals rivals = rivals_of(others[k]);
      sharpened_with_rivals(*variant_, rivals, {rivals.signatures, variant_->parameters, {}}, open);
    }
    if (problem_.library.signatures.size() > before || !are_open(open.signatures)) {
      open.parameters = variant_->parameters;
      open_times(std::move(open), likeliest_set(best_.ascent));
    }
    is_better = false;
    if (modes.empty()) return modes;
    std::vector<Ascent> sharper(modes.size());
    in_parallel(modes.size(), [&](std::size_t m) {
      ColumnsAt at(problem_, identities_, *variant_, best_.point);
      const AscentOptions options = ascent_options(problem_, identities_, largest_, Forms::no, modes[m].without);
      sharper[m] = ascended_from(at, identities_, options, modes[m].set);
    });
    const double bound = best_.ascent.bound;
    for (std::size_t m = 0; m < modes.size(); ++m) {
      modes[m].set = likeliest_set(sharper[m]);
      if (!(sharper[m].bound > best_.ascent.bound + kBetter)) continue;
      best_.ascent = std::move(sharper[m]);
      is_better = true;
    }
    best_.log_weight += best_.ascent.bound - bound;
    return modes;
  }

  Problem& problem_;
  std::size_t largest_;
  std::vector<Covariance> covariances_, pilots_;
  std::optional<Variant> variant_;
  Identities identities_;
  WeightedAscent best_;
  ConditionalFit open_;  // whose input times are open
};

}  // namespace

SearchResult search_result(Problem& problem, std::size_t largest) { return Search(problem, largest).run(); }

}  // namespace ballbar
