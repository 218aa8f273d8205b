#include "baselines.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "additions.hpp"
#include "diagnosis/search/best_subset.hpp"
#include "f_test.hpp"
#include "lasso.hpp"
#include "numerics/orthonormal.hpp"

namespace ballbar::study {
namespace {

constexpr std::size_t kMostAdded = 6;

struct Columns {
  SignatureLibrary known;
  Projected seen;
  double n = 0.0;
  double fitted = 0.0;  // parameters of the base model

  BoundEffect bound(std::size_t signature) const {
    const Family& family = known.families[known.signatures[signature].family];
    return family.bound;
  }
  double freedom(std::size_t signature) const {
    return static_cast<double>(freedom_of(*known.families[known.signatures[signature].family].bound.effect));
  }
};

Columns columns_of(const DataSet& set) {
  const Fit base = fit(set.model, set.data, 0, {.white = true});
  Columns columns{signature_library_of(built_in_catalogue(), set.model, set.data, base,
                                       {.motion = {}, .every_onset = false, .without = {}}),
                  {},
                  0.0,
                  0.0};
  // RMSE of the base model as noise: falls are in its squares.
  const Noise noise{base.sigma_um.empty() ? base.rmse_um : 0.0, 0.0, 0.0, 0.0};
  const Eigen::MatrixXd model = model_columns(base);
  columns.n = static_cast<double>(base.row.size());
  columns.fitted = static_cast<double>(model.cols());
  columns.seen =
      projected(columns.known, Eigen::VectorXd::Map(base.residual_um.data(), static_cast<Eigen::Index>(columns.n)),
                model, Whitening(noise, base.time_s, base.sigma_um));
  return columns;
}

double criterion(double n, double rss, double parameters, double price) {
  return n * std::log(std::max(rss, 1e-300)) + price * parameters;
}

// Adds the signature that `worth` likes best, as long as it likes any: worth(RSS before, RSS after, parameters before,
// freedom) > 0.
template <class Worth>
std::vector<BoundEffect> greedy(const Columns& columns, Worth worth) {
  std::vector<BoundEffect> selected;
  Eigen::MatrixXd beside(columns.seen.columns.rows(), 0);
  Eigen::VectorXd left = columns.seen.residual;
  double parameters = columns.fitted;
  while (selected.size() < kMostAdded) {
    const std::vector<double> fall = falls(columns.known, columns.seen, beside, left);
    const double rss = left.squaredNorm();
    double most = 0.0;
    std::size_t best = fall.size();
    for (std::size_t k = 0; k < fall.size(); ++k) {
      if (columns.n - parameters - columns.freedom(k) < 2.0) continue;
      if (std::find(selected.begin(), selected.end(), columns.bound(k)) != selected.end()) continue;
      const double value = worth(rss, rss - fall[k], parameters, columns.freedom(k));
      if (value <= most) continue;
      most = value;
      best = k;
    }
    if (best == fall.size()) break;
    selected.push_back(columns.bound(best));
    parameters += columns.freedom(best);
    beside = with_signature(beside, columns.seen, columns.known.signatures[best]);
    left = freed(columns.seen.residual, beside);
  }
  return selected;
}

std::vector<BoundEffect> greedy_f(const Columns& columns) {
  return greedy(columns, [&](double before, double after, double parameters, double freedom) {
    const double rest = columns.n - parameters - freedom;
    const double f = (before - after) / freedom / (after / rest);
    return p_of_f(f, freedom, rest) < 0.01 ? before - after : 0.0;
  });
}

std::vector<BoundEffect> greedy_aic(const Columns& columns) {
  return greedy(columns, [&](double before, double after, double parameters, double freedom) {
    return criterion(columns.n, before, parameters, 2.0) - criterion(columns.n, after, parameters + freedom, 2.0);
  });
}

std::vector<BoundEffect> subset_bic(const Columns& columns) {
  const double price = std::log(columns.n), rss = columns.seen.residual.squaredNorm();
  double least = criterion(columns.n, rss, columns.fitted, price);
  std::vector<BoundEffect> selected;
  const auto largest = static_cast<std::size_t>(std::clamp((columns.n - columns.fitted) / 4.0, 1.0, 3.0));
  for (const Subset& subset : best_subsets(columns.known, columns.seen, nullptr, largest)) {
    double parameters = columns.fitted;
    std::vector<BoundEffect> bounds;
    for (const std::size_t k : subset.signatures) {
      parameters += columns.freedom(k);
      bounds.push_back(columns.bound(k));
    }
    const double value = criterion(columns.n, rss - subset.gain, parameters, price);
    if (value >= least) continue;
    least = value;
    selected = std::move(bounds);
  }
  return selected;
}

std::vector<BoundEffect> lasso(const Columns& columns) {
  std::vector<BoundEffect> selected;
  for (const Eigen::Index column : lasso_selection(columns.seen.columns, columns.seen.residual)) {
    const auto at = std::find_if(columns.known.signatures.begin(), columns.known.signatures.end(),
                                 [&](const Signature& one) { return column < one.first + one.width; });
    const BoundEffect bound = columns.bound(static_cast<std::size_t>(at - columns.known.signatures.begin()));
    if (std::find(selected.begin(), selected.end(), bound) == selected.end()) selected.push_back(bound);
  }
  return selected;
}

}  // namespace

std::array<std::vector<BoundEffect>, 4> baselines(const DataSet& set) {
  const Columns columns = columns_of(set);
  return {greedy_f(columns), subset_bic(columns), greedy_aic(columns), lasso(columns)};
}

}  // namespace ballbar::study
