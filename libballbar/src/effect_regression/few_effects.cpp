#include "effect_regression/few_effects.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <vector>

#include "ballbar/numerics/parallel.hpp"
#include "effect_regression/forward_selection.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kMostEffects = 12;

// One selection: gains of b and of its own predictors, and the discrepancy in the last row.
struct Variant {
  std::vector<std::size_t> columns;  // of the problem
  SelectedFit fit;
  double log_likelihood = 0.0, length_s = 0.0;
};

}  // namespace

RidgeFit few_effects(const RidgeProblem& problem) {
  std::vector<std::size_t> moving;
  for (Eigen::Index k = 0; k < problem.sd.size(); ++k) {
    if (problem.sd[k] > 0.0) moving.push_back(static_cast<std::size_t>(k));
  }
  SelectionProblem selected;
  selected.fixed = Eigen::MatrixXd::Ones(problem.columns.rows(), 1);
  selected.columns = problem.columns(Eigen::all, moving);
  selected.target_um = problem.target_um;
  selected.time_s = problem.time_s;
  selected.run = problem.run;
  selected.end_s = problem.end_s;
  std::vector<SelectionState> states;
  for (const double length_s : {0.0, 1800.0, 7200.0, 30'000.0}) {
    for (const double variance : {1.0, 3.0, 10.0}) states.push_back({length_s, variance});
  }
  std::vector<Variant> variants(states.size());
  in_parallel(states.size(), [&](std::size_t s) {
    const PredictorSelection selection = forward_selection(selected, {&states[s], 1}, kMostEffects);
    Variant& of = variants[s];
    of.length_s = states[s].length_s;
    of.log_likelihood = selection.log_likelihood;
    while (of.columns.size() < selection.joined.size() && selection.joined[of.columns.size()].p_none <= 0.5) {
      of.log_likelihood += selection.joined[of.columns.size()].log_bayes;
      of.columns.push_back(moving[selection.joined[of.columns.size()].column]);
    }
    of.fit = selection.fits[of.columns.size()];
  });
  const Variant likeliest = *std::max_element(variants.begin(), variants.end(), [](const auto& a, const auto& b) {
    return a.log_likelihood < b.log_likelihood;
  });
  // What has no memory is no matter of those that have one, and the other way round.
  const bool is_white = likeliest.length_s == 0.0;
  std::erase_if(variants, [&](const Variant& of) { return (of.length_s == 0.0) != is_white; });
  RidgeFit result;
  for (const Variant& of : variants) {
    for (const std::size_t column : of.columns) {
      if (std::find(result.used.begin(), result.used.end(), column) == result.used.end()) result.used.push_back(column);
    }
  }
  const auto m = static_cast<Eigen::Index>(result.used.size());
  const double share = 1.0 / static_cast<double>(variants.size());
  Eigen::MatrixXd gains = Eigen::MatrixXd::Zero(m + 2, static_cast<Eigen::Index>(variants.size()));
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(m + 2, m + 2);
  for (std::size_t s = 0; s < variants.size(); ++s) {
    const Variant& of = variants[s];
    std::vector<Eigen::Index> place{0};  // of b, its own predictors, the discrepancy
    for (const std::size_t column : of.columns)
      place.push_back(std::find(result.used.begin(), result.used.end(), column) - result.used.begin() + 1);
    place.push_back(m + 1);
    for (std::size_t i = 0; i < place.size(); ++i) {
      const auto at = static_cast<Eigen::Index>(i);
      gains(place[i], static_cast<Eigen::Index>(s)) = i + 1 < place.size() ? of.fit.gains[at] : of.fit.end_um;
      for (std::size_t j = 0; j < place.size(); ++j)
        covariance(place[i], place[j]) += share * of.fit.covariance_um2(at, static_cast<Eigen::Index>(j));
    }
  }
  result.setting.length_s = likeliest.length_s;
  result.sigma_um = likeliest.fit.sigma_um;
  result.gains_um = gains.rowwise().mean();
  const Eigen::MatrixXd apart = gains.colwise() - result.gains_um;
  covariance += share * apart * apart.transpose();
  covariance.diagonal().array() += 1e-12 * covariance.diagonal().cwiseAbs().maxCoeff();
  result.factor_um = covariance.llt().matrixL();
  return result;
}

}  // namespace ballbar
