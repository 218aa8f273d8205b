#include "diagnosis/posterior/table.hpp"

#include <algorithm>
#include <utility>

namespace ballbar {
namespace {

// What stands beside the largest numbers, the largest first.
std::vector<std::size_t> of_largest(std::vector<std::pair<double, std::size_t>> order, std::size_t most) {
  std::sort(order.rbegin(), order.rend());
  order.resize(std::min(most, order.size()));
  std::vector<std::size_t> result;
  result.reserve(order.size());
  for (const auto& [value, place] : order) result.push_back(place);
  return result;
}

}  // namespace

void SetTable::add(const std::vector<std::size_t>& at, std::size_t variant,
                   std::vector<std::map<SetKey, FoundSet>> found) {
  for (std::size_t k = 0; k < at.size(); ++k) {
    for (auto& [key, one] : found[k]) {
      if (one.log_weight == kLogZero) continue;
      std::vector<FoundSet>& there = sets[key];
      there.resize(points.size());
      if (!(one.log_weight > there[at[k]].log_weight)) continue;
      there[at[k]] = std::move(one);
      there[at[k]].variant = variant;
    }
  }
}

double log_weight_of(const std::vector<FoundSet>& at) {
  std::vector<double> all;
  all.reserve(at.size());
  for (const FoundSet& one : at) all.push_back(one.log_weight);
  return log_sum(all);
}

std::optional<std::size_t> likeliest_point(const std::vector<FoundSet>& at) {
  std::optional<std::size_t> best;
  for (std::size_t g = 0; g < at.size(); ++g) {
    if (at[g].most > (best ? at[*best].most : kLogZero)) best = g;
  }
  return best;
}

std::vector<std::size_t> likeliest_points(const std::vector<FoundSet>& at, std::size_t most) {
  std::vector<std::pair<double, std::size_t>> order;
  order.reserve(at.size());
  for (std::size_t g = 0; g < at.size(); ++g) order.emplace_back(at[g].most, g);
  return of_largest(std::move(order), most);
}

std::vector<std::size_t> best_points(const SetTable& table, std::size_t own, std::size_t most) {
  std::vector<std::pair<double, std::size_t>> order;
  order.reserve(table.points.size());
  for (std::size_t g = 0; g < table.points.size(); ++g) order.emplace_back(kLogZero, g);
  for (const auto& [key, at] : table.sets) {
    if (key.own != own) continue;
    for (std::size_t g = 0; g < at.size(); ++g) order[g].first = std::max(order[g].first, at[g].log_weight);
  }
  return of_largest(std::move(order), most);
}

std::vector<std::size_t> strongest_families(const Problem& problem, const SetTable& table, std::size_t own,
                                            std::size_t most) {
  std::vector<std::pair<double, std::size_t>> order;
  order.reserve(problem.effects);
  for (std::size_t f = 0; f < problem.effects; ++f) {
    const auto alone = table.sets.find({own, {f}});
    if (alone == table.sets.end()) continue;
    const double weight = log_weight_of(alone->second);
    if (weight > kLogZero) order.emplace_back(weight, f);
  }
  return of_largest(std::move(order), most);
}

}  // namespace ballbar
