#include "machine_errors/error_groups.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <utility>

#include "numerics/tails.hpp"

namespace ballbar {
namespace {

constexpr double kCorrelated = 0.9;  // gains of errors that the readings hardly separate

// Places of some columns among ascending ones.
Indices places_of(const Indices& some, const Indices& columns) {
  Indices places;
  for (const Eigen::Index k : some)
    places.push_back(std::lower_bound(columns.begin(), columns.end(), k) - columns.begin());
  return places;
}

// Largest correlation between the gains of an effect and those of others.
double correlation(const Eigen::MatrixXd& covariance, const Indices& one, const Indices& other) {
  const Eigen::VectorXd sigma = covariance.diagonal().cwiseMax(1e-300).cwiseSqrt();
  double largest = 0.0;
  for (const Eigen::Index i : one) {
    for (const Eigen::Index j : other) largest = std::max(largest, std::abs(covariance(i, j)) / (sigma[i] * sigma[j]));
  }
  return largest;
}

Indices columns_of(const ErrorDesign& design, const std::vector<std::size_t>& effects) {
  Indices columns;
  for (const std::size_t k : effects)
    columns.insert(columns.end(), design.effects[k].columns.begin(), design.effects[k].columns.end());
  return columns;
}

// Sets of two and more of these effects with correlated gains.
std::vector<std::vector<std::size_t>> correlated_sets(const ErrorDesign& design, const std::vector<std::size_t>& open,
                                                      const Gains& all, const Indices& whole) {
  std::vector<std::vector<std::size_t>> sets;
  for (const std::size_t k : open) {
    std::vector<std::size_t> set{k};
    const Indices own = places_of(design.effects[k].columns, whole);
    std::erase_if(sets, [&](const std::vector<std::size_t>& other) {
      if (correlation(all.covariance, own, places_of(columns_of(design, other), whole)) < kCorrelated) return false;
      set.insert(set.end(), other.begin(), other.end());
      return true;
    });
    std::sort(set.begin(), set.end());
    sets.push_back(std::move(set));
  }
  std::erase_if(sets, [](const std::vector<std::size_t>& set) { return set.size() < 2; });
  return sets;
}

}  // namespace

double p_of(const Eigen::VectorXd& values, const Eigen::MatrixXd& covariance) {
  const auto number = static_cast<std::size_t>(values.size());
  const double together = chi2_upper_tail(values.dot(covariance.ldlt().solve(values)), number);
  const double clearest = values.cwiseAbs2().cwiseQuotient(covariance.diagonal().cwiseMax(1e-300)).maxCoeff();
  const double alone = static_cast<double>(number) * chi2_upper_tail(clearest, 1);
  return std::min(1.0, std::min(together, alone));
}

double corrected_p(const FittedEffect& effect, const Gains& gains, const Indices& columns) {
  const Indices own = places_of(effect.columns, columns);
  return effect.searched * effect.looked_at * p_of(gains.values(own), gains.covariance(own, own));
}

std::vector<FittedGroup> inseparable(const ErrorDesign& design, const Gains& all, const Indices& whole,
                                     const Indices& chosen,
                                     const std::function<std::vector<Gains>(const Indices&)>& gains_of) {
  std::vector<std::size_t> open;
  for (std::size_t k = 0; k < design.effects.size(); ++k) {
    const ErrorFit kind = design.effects[k].effect->rules.error_fit;
    const bool is_one = kind == ErrorFit::together || kind == ErrorFit::where_it_shows;
    if (is_one && corrected_p(design.effects[k], all, whole) >= kFalseErrors) open.push_back(k);
  }
  // Without what is no member the others may be other sets.
  std::vector<FittedGroup> groups;
  for (bool is_smaller = true; is_smaller;) {
    groups.clear();
    is_smaller = false;
    for (const std::vector<std::size_t>& set : correlated_sets(design, open, all, whole)) {
      Indices others = columns_of(design, set);
      std::sort(others.begin(), others.end());
      FittedGroup group;
      for (const std::size_t k : set) {
        const FittedEffect& effect = design.effects[k];
        Indices columns = effect.columns;
        std::set_difference(chosen.begin(), chosen.end(), others.begin(), others.end(), std::back_inserter(columns));
        std::sort(columns.begin(), columns.end());
        const std::vector<Gains> fits = gains_of(columns);
        double p = 0.0;
        for (const Gains& fit : fits) p = std::max(p, corrected_p(effect, fit, columns));
        if (p >= kFalseErrors) {
          std::erase(open, k);
          is_smaller = true;
          continue;
        }
        const double of_one = p / (effect.searched * effect.looked_at);
        group.p = std::min(1.0, std::min(group.p, of_one * static_cast<double>(set.size())));
        const Indices own = places_of(effect.columns, columns);
        group.effects.push_back(k);
        group.alone.emplace_back(fits.front().values(own));
        group.covariance.emplace_back(fits.front().covariance(own, own));
      }
      if (group.effects.size() > 1) groups.push_back(std::move(group));
    }
  }
  return groups;
}

}  // namespace ballbar
