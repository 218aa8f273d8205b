#include "diagnosis/verdict/credible_set.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <string>

namespace ballbar {
std::vector<Driver> drivers_of(const Problem& problem, const Posterior& posterior) {
  std::map<std::string, double> all;
  for (const PosteriorMode& mode : posterior.modes) {
    std::map<std::string, double> without;
    for (const SinglePosterior& one : mode.effects) {
      std::map<std::string, double> with;
      for (std::size_t f = 0; f < problem.library.families.size(); ++f) {
        const std::vector<std::string>& columns = problem.library.families[f].bound.columns;
        for (const std::string& column : std::set<std::string>(columns.begin(), columns.end()))
          with[column] += one.alpha[f];
      }
      for (const auto& [column, p] : with) without.try_emplace(column, 1.0).first->second *= std::max(0.0, 1.0 - p);
    }
    for (const auto& [column, p] : without) all[column] += mode.p * (1.0 - p);
  }
  std::vector<Driver> drivers;
  for (const auto& [column, p] : all) {
    if (p >= 0.5) drivers.push_back({column, p});
  }
  std::stable_sort(drivers.begin(), drivers.end(), [](const Driver& a, const Driver& b) { return a.p > b.p; });
  return drivers;
}

std::vector<std::size_t> credible_set(const SinglePosterior& effect, double credible) {
  std::vector<std::size_t> order(effect.alpha.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return effect.alpha[a] > effect.alpha[b]; });
  const double all = effect.p_any();
  double sum = 0.0;
  std::vector<std::size_t> set;
  for (const std::size_t i : order) {
    if (sum >= credible * all || !(effect.alpha[i] > 0.0)) break;
    set.push_back(i);
    sum += effect.alpha[i];
  }
  return set;
}

}  // namespace ballbar
