#include "diagnosis/posterior/set_prior.hpp"

#include <algorithm>
#include <cmath>

#include "ballbar/diagnosis/thresholds.hpp"

namespace ballbar {

double log_prior_of_size(std::size_t size) { return std::log(kPriorOfSize[std::min(size, kPriorOfSize.size() - 1)]); }

double log_prior_of_set(const Problem& problem, const std::vector<std::size_t>& families, std::size_t own) {
  double sum = log_prior_of_size(families.size());
  for (const std::size_t family : families) sum += problem.log_prior[family];
  for (std::size_t k = 2; k <= families.size(); ++k) sum += std::log(static_cast<double>(k));
  if (problem.own.empty()) return sum;
  return sum +
         (own == 0 ? std::log(1.0 - kPriorOfOwn) : std::log(kPriorOfOwn / static_cast<double>(problem.own.size())));
}

}  // namespace ballbar
