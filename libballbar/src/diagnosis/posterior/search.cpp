#include "diagnosis/posterior/search.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

#include "ballbar/diagnosis/thresholds.hpp"
#include "diagnosis/evidence/refined.hpp"
#include "diagnosis/posterior/beside.hpp"
#include "diagnosis/posterior/likely_points.hpp"
#include "diagnosis/posterior/pairs.hpp"
#include "diagnosis/posterior/singles.hpp"
#include "diagnosis/posterior/triples.hpp"
#include "diagnosis/posterior/wanted.hpp"

namespace ballbar {
namespace {

constexpr int kStepsOfOwn = 6;  // of Gauss and Newton

struct Search {
  Problem& problem;
  std::size_t largest = 0;
  SetKey wanted;
  SetTable table;
  std::vector<SetKey> relinearised;  // as often as it has been tried
};

std::vector<double> parameters_of_fit(const Problem& problem) {
  std::vector<double> parameters;
  parameters.reserve(problem.base.parameters.size());
  for (const FittedParameter& one : problem.base.parameters) parameters.push_back(one.value);
  parameters.front() -= problem.centre_um;
  return parameters;
}

void weigh_pairs_and_triples(Search& search, std::size_t variant) {
  if (search.largest < 2) return;
  const std::vector<std::size_t> points = weigh_pairs(search.problem, search.table, variant);
  if (search.largest >= 3 && !points.empty()) weigh_triples(search.problem, search.table, variant, points);
}

// Values of a held parameter to start from.
std::vector<double> starts_of(const OwnParameter& own, const Parameter& parameter) {
  std::vector<double> values{own.held};
  if (parameter.unit != "s") {
    std::copy_if(parameter.grid.begin(), parameter.grid.end(), std::back_inserter(values),
                 [&](double value) { return std::abs(value - own.held) > 1e-9; });
  } else if (own.held > 0.0) {
    for (const double factor : {0.3, 3.0}) values.push_back(own.held * factor);
  }
  const auto is_outside = [&](double value) { return value < parameter.lower || value > parameter.upper; };
  values.erase(std::remove_if(values.begin(), values.end(), is_outside), values.end());
  return values;
}

// Each held parameter free, where it is likeliest at the best covariance.
void add_own(Search& search) {
  const Problem& problem = search.problem;
  SetTable& table = search.table;
  const Variant settled = table.variants.back();
  for (std::size_t k = 0; k < problem.own.size(); ++k) {
    const std::size_t place = problem.own[k].parameter;
    const CovarianceFilter& filter = table.points[best_points(table, 0, 1).front()].filter;
    Refined best;
    best.log_evidence = kLogZero;
    for (const double value : starts_of(problem.own[k], problem.base_model->parameter(place))) {
      std::vector<double> start = settled.parameters;
      start[place] = value;
      Refined now = refined(*problem.base_model, start, {place}, settled.times, filter, problem.known, kStepsOfOwn);
      if (now.log_evidence > best.log_evidence) best = std::move(now);
    }
    if (best.log_evidence == kLogZero) continue;
    table.variants.push_back(variant_at(problem, k + 1, best.parameters));
    weigh_singles(problem, table, table.variants.size() - 1);
  }
}

// ln of the weight of the model alone where it is largest.
double most_without(const SetTable& table) {
  const auto none = table.sets.find(SetKey{});
  if (none == table.sets.end()) return kLogZero;
  const std::optional<std::size_t> g = likeliest_point(none->second);
  return g ? none->second[*g].most : kLogZero;
}

// The model about where this set has its parameters. all: whatever else is likely with the model there, too. False: it
// is there already.
bool relinearise_at(Search& search, const SetKey& key, bool all) {
  Problem& problem = search.problem;
  SetTable& table = search.table;
  search.relinearised.push_back(key);
  const auto there = table.sets.find(key);
  if (there == table.sets.end()) return false;
  const std::optional<std::size_t> g = likeliest_point(there->second);
  if (!g) return false;
  const FoundSet& found = there->second[*g];
  const Point& point = table.points[*g];
  const Variant& variant = table.variants[found.variant];
  Beside beside = parameters_beside(problem, variant, found.signatures, point);
  const bool is_strong = !found.signatures.empty() && found.most - most_without(table) > kStrong;
  if (is_strong) beside = sharpened(problem, variant, std::move(beside), point);
  const bool is_new =
      beside.signatures != found.signatures || is_elsewhere(problem, variant, beside.parameters, kSameModel);
  if (!is_new && (!all || found.signatures.empty())) return false;
  Eigen::MatrixXd times = all ? times_beside(problem, beside) : variant.times;
  table.variants.push_back(variant_at(problem, key.own, std::move(beside.parameters), std::move(times)));
  const std::size_t next = table.variants.size() - 1;
  if (all) {
    weigh_singles(problem, table, next);
    if (key.families.size() > 1 || is_strong) weigh_pairs_and_triples(search, next);
  } else if (key.families.size() == 2) {
    weigh_pair(problem, table, next, key);
  } else if (key.families.size() < 2) {
    weigh_singles(problem, table, next, key.families);
  }
  if (key == search.wanted) weigh_wanted(problem, table, next, search.wanted);
  return true;
}

// The best sets of effects first, but that which is wanted second at the latest.
std::vector<std::pair<double, SetKey>> in_turn(const Search& search) {
  std::vector<std::pair<double, SetKey>> order;
  for (const auto& [key, at] : search.table.sets) {
    if (key.families.empty() || key.families.back() < search.problem.effects)
      order.emplace_back(log_weight_of(at), key);
  }
  std::sort(order.rbegin(), order.rend());
  if (search.wanted.families.empty()) return order;
  const auto at =
      std::find_if(order.begin(), order.end(), [&](const auto& one) { return one.second == search.wanted; });
  if (at != order.end()) std::rotate(order.begin() + (at == order.begin() ? 0 : 1), at, at + 1);
  return order;
}

// The model beside its strongest effect, where that is strong and moves it: a line drawn from where the effect is
// missing tells nothing of sets with it.
void settle(Search& search) {
  Problem& problem = search.problem;
  SetTable& table = search.table;
  const bool is_lost = is_on_bound(problem, table.variants.front());
  if (is_lost) {
    for (const double time_s : kTimesOfModels_s) {
      table.variants.push_back(variant_at(problem, 0, with_times(problem, table.variants.front().parameters, time_s)));
      weigh_singles(problem, table, table.variants.size() - 1);
    }
  }
  const std::size_t before = table.variants.size();
  const std::vector<std::size_t> strongest =
      search.wanted.families.size() == 1 ? search.wanted.families : strongest_families(problem, table, 0, 1);
  if (strongest.empty()) return;
  const auto there = table.sets.find({0, strongest});
  if (there == table.sets.end()) return;
  const std::vector<FoundSet>& alone = there->second;
  const std::optional<std::size_t> g = likeliest_point(alone);
  if (!g || (!is_lost && alone[*g].most - most_without(table) < kMovesTheModel)) return;
  const std::size_t signature = alone[*g].signatures.front();
  Beside beside = settled_beside(problem, table.variants.front(), signature);
  if (!is_elsewhere(problem, table.variants.front(), beside.parameters, kFarModel)) return;
  Eigen::MatrixXd times = times_beside(problem, beside);
  table.variants.push_back(variant_at(problem, 0, std::move(beside.parameters), std::move(times)));
  // Where nothing more is likely stays likely.
  std::vector<Point> points = likely_points(problem, table.variants.back(), search.largest);
  for (const std::size_t k : likeliest_points(table.sets.at({}), kPointsOfNothing)) {
    if (std::none_of(points.begin(), points.end(),
                     [&](const Point& one) { return one.covariance == table.points[k].covariance; }))
      points.push_back(table.points[k]);
  }
  table.points = std::move(points);
  table.sets.clear();
  for (std::size_t v = 0; v < before; ++v) weigh_singles(problem, table, v);
  std::erase_if(table.sets, [&](const auto& one) { return one.first.families == strongest; });
  weigh_singles(problem, table, before);
}

// About where the best sets have the parameters of the model. False: it is there already.
bool relinearise(Search& search) {
  const std::vector<std::pair<double, SetKey>> order = in_turn(search);
  bool moved = false;
  std::size_t tried = 0;
  for (const auto& [weight, key] : order) {
    const bool is_wanted = !search.wanted.families.empty() && key == search.wanted;
    if (!is_wanted && (tried == kSetsRelinearised || weight < order.front().first - kFarFromBest)) break;
    if (key.families.size() > 2 && !is_wanted) continue;
    if (std::count(search.relinearised.begin(), search.relinearised.end(), key) == kRelinearised) continue;
    ++tried;
    moved = relinearise_at(search, key, tried == 1) || moved;
    // What is held to be another value is held against the model as it is on equal terms.
    if (key.own != 0) moved = relinearise_at(search, {0, key.families}, false) || moved;
  }
  return moved;
}

}  // namespace

Posterior posterior_of(Problem& problem, std::size_t largest_set, std::vector<std::size_t> wanted,
                       const std::function<void(const SetTable&)>& weighed) {
  std::sort(wanted.begin(), wanted.end());
  Search search{problem, largest_set, {0, std::move(wanted)}, {}, {}};
  SetTable& table = search.table;
  table.variants.push_back(variant_at(problem, 0, parameters_of_fit(problem)));
  table.points = likely_points(problem, table.variants.front(), largest_set);
  // The model about where it is most likely at the likeliest covariance, then about where the best sets have it.
  const auto tell = [&] {
    if (weighed) weighed(table);
  };
  weigh_singles(problem, table, 0);
  tell();
  settle(search);
  tell();
  const std::size_t settled = table.variants.size() - 1;
  weigh_pairs_and_triples(search, settled);
  weigh_wanted(problem, table, settled, search.wanted);
  tell();
  add_own(search);
  for (int round = 0; round < kRelinearised; ++round) {
    if (!relinearise(search)) break;
    tell();
  }
  return summed(problem, std::move(table));
}

}  // namespace ballbar
