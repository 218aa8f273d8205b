#include "diagnosis/posterior/posterior.hpp"

#include <cmath>
#include <numeric>
#include <utility>

#include "diagnosis/posterior/average.hpp"
#include "diagnosis/posterior/search.hpp"

namespace ballbar {

double SinglePosterior::p_any() const { return std::accumulate(p.begin(), p.end(), 0.0); }

double Posterior::p(const EffectSet& set) const { return std::exp(set.log_weight - log_total); }

Posterior posterior_of(Problem& problem, std::size_t largest,
                       const std::function<void(const std::vector<double>&)>& so_far) {
  const bool is_given = !problem.covariances.empty();
  const std::vector<Covariance> grid = is_given ? problem.covariances : noise_grid(problem.time_s);
  Searched best = searched(problem, largest, grid);
  Posterior result = averaged(problem, largest, std::move(best), grid, is_given);
  if (so_far) so_far(result.family);
  return result;
}

}  // namespace ballbar
