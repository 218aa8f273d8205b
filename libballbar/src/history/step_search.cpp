#include "history/step_search.hpp"

#include <algorithm>
#include <cmath>

#include "history/robust_fit.hpp"
#include "numerics/tails.hpp"

namespace ballbar {

StepScores::StepScores(const Eigen::VectorXd& scores, double degrees, const FamilyScatter& family)
    : sums_{0.0}, degrees_(degrees), family_(family) {
  for (const double z : scores) sums_.push_back(sums_.back() + clipped(z, kShortRunClip));
}

double StepScores::p_value(std::size_t k) const {
  const std::size_t n = sums_.size() - 1;
  const std::size_t fewer = std::min(k, n - k);
  const auto before = static_cast<double>(k), after = static_cast<double>(n - k);
  const auto variance_of_mean = [&](double j) { return family_.memory(j) / j; };
  const double difference = (sums_[n] - sums_[k]) / after - sums_[k] / before;
  const double variance = variance_of_mean(before) + variance_of_mean(after);
  const double by_student = student_tails(difference / std::sqrt(family_.variance_of_score * variance), degrees_);
  if (fewer > kLongestShortRun) return by_student;
  const double of_fewer = variance_of_mean(static_cast<double>(fewer));
  const double as_if_rest_known = difference * std::sqrt(of_fewer / variance);
  return std::max(family_.chance_of_mean(fewer, as_if_rest_known), by_student);
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
