#include "history/step_search.hpp"

#include <algorithm>
#include <cmath>

#include "history/robust_fit.hpp"
#include "numerics/tails.hpp"

namespace ballbar {

StepScores::StepScores(const Eigen::VectorXd& scores, double degrees, const FamilyScatter& family)
    : short_sums_{0.0}, long_sums_{0.0}, degrees_(degrees), family_(family) {
  for (const double z : scores) {
    short_sums_.push_back(short_sums_.back() + clipped(z, kShortRunClip));
    long_sums_.push_back(long_sums_.back() + clipped(z, kHuberClip));
  }
}

double StepScores::mean(const std::vector<double>& sums, std::size_t from, std::size_t to) const {
  return (sums[to] - sums[from]) / static_cast<double>(to - from);
}

double StepScores::p_value(std::size_t k) const {
  const std::size_t n = long_sums_.size() - 1;
  const std::size_t fewer = std::min(k, n - k), more = n - fewer;
  const auto j = static_cast<double>(fewer), rest = static_cast<double>(more);
  const double variance = family_.memory(j) / j, variance_of_rest = family_.memory(rest) / rest;
  const double sigma = std::sqrt(variance + variance_of_rest);
  if (fewer > kLongestShortRun) {
    return student_tails((mean(long_sums_, k, n) - mean(long_sums_, 0, k)) / sigma, degrees_);
  }
  const bool after = n - k == fewer;
  const double mean_of_fewer = after ? mean(short_sums_, k, n) : mean(short_sums_, 0, k);
  const double mean_of_rest = after ? mean(long_sums_, 0, k) : mean(long_sums_, k, n);
  const double difference = mean_of_fewer - mean_of_rest;
  const double as_if_rest_known = difference * std::sqrt(variance) / sigma;
  return std::max(family_.chance_of_mean(fewer, as_if_rest_known), student_tails(difference / sigma, degrees_));
}

StepSearch step_search(const Eigen::VectorXd& scores, double degrees, const FamilyScatter& family) {
  constexpr double kAboutAsLikely = 20.0;  // e^3
  const auto n = static_cast<std::size_t>(scores.size());
  StepSearch search;
  if (n < kFewestOfStep) return search;
  const StepScores at(scores, degrees, family);
  std::vector<double> p(n, 1.0);
  for (std::size_t k = 2; k + 2 <= n; ++k) p[k] = at.p_value(k);
  const auto least = static_cast<std::size_t>(std::min_element(p.begin(), p.end()) - p.begin());
  search.place = {least, least, least};
  while (search.place.earliest > 2 && p[search.place.earliest - 1] < kAboutAsLikely * p[least]) --search.place.earliest;
  while (search.place.latest + 2 < n && p[search.place.latest + 1] < kAboutAsLikely * p[least]) ++search.place.latest;
  search.p_value = std::min(1.0, static_cast<double>(n - 3) * p[least]);
  return search;
}

}  // namespace ballbar
