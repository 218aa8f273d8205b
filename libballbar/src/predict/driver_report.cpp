#include "predict/driver_report.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "ballbar/internal/numerics/parallel.hpp"
#include "ballbar/internal/numerics/range.hpp"
#include "ballbar/internal/series/folds.hpp"

namespace ballbar {
namespace {

constexpr double kTogether = 0.98, kAgainst = -0.9;  // correlations
constexpr double kStable = 3.0, kMinor = 0.05, kSmallFall = 1.0;
constexpr std::size_t kMostRefits = 12, kMostCancelling = 5;

// A column and the predictors that count for it, places in `used` of the fit.
struct DriverColumn {
  std::string name;
  std::vector<Eigen::Index> used;
  std::vector<std::size_t> predictors;  // that read it at all
};

std::vector<DriverColumn> driver_columns(const Design& design, const RidgeFit& fit) {
  std::vector<DriverColumn> columns;
  const auto column_named = [&](const std::string& name) -> DriverColumn& {
    const auto known =
        std::find_if(columns.begin(), columns.end(), [&](const DriverColumn& one) { return one.name == name; });
    if (known != columns.end()) return *known;
    columns.push_back({name, {}, {}});
    return columns.back();
  };
  for (std::size_t k = 0; k < fit.used.size(); ++k) {
    const Predictor& predictor = design.predictors.each[fit.used[k]];
    column_named(predictor.columns.front()).used.push_back(static_cast<Eigen::Index>(k));
    for (const std::string& name : predictor.columns) column_named(name).predictors.push_back(fit.used[k]);
  }
  return columns;
}

// What each column adds: rows of the problem by columns.
Eigen::MatrixXd added_um(const RidgeProblem& problem, const RidgeFit& fit, const std::vector<DriverColumn>& columns,
                         const Eigen::VectorXd& gains) {
  Eigen::MatrixXd added = Eigen::MatrixXd::Zero(problem.columns.rows(), static_cast<Eigen::Index>(columns.size()));
  for (std::size_t c = 0; c < columns.size(); ++c) {
    for (const Eigen::Index k : columns[c].used) {
      const auto of = static_cast<Eigen::Index>(fit.used[static_cast<std::size_t>(k)]);
      added.col(static_cast<Eigen::Index>(c)) += gains[of] * problem.columns.col(of);
    }
  }
  return added;
}

double range_in(const Eigen::VectorXd& values) {
  return range_of({values.data(), static_cast<std::size_t>(values.size())});
}

double correlation(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  const Eigen::VectorXd x = a.array() - a.mean(), y = b.array() - b.mean();
  const double norm = x.norm() * y.norm();
  return norm > 0.0 ? x.dot(y) / norm : 0.0;
}

// Fold of every row of the problem: its run, or of one run its cycle.
std::vector<std::size_t> folds_of_rows(const Design& design, const Series& first_run, const RidgeProblem& problem) {
  if (design.runs > 1) return problem.run;
  const std::vector<std::size_t> fold = folds_of(first_run, design.row);
  std::vector<std::size_t> result;
  std::size_t at = 0;
  for (const double time_s : problem.time_s) {
    while (design.time_s[at] < time_s) ++at;
    result.push_back(fold[at]);
  }
  return result;
}

// Classes of columns that go together, of those that are not needed.
std::vector<std::vector<std::string>> classes_of(const std::vector<DriverColumn>& columns,
                                                 const std::vector<bool>& not_needed, const RidgeProblem& problem,
                                                 const RidgeFit& fit) {
  std::vector<std::size_t> of = rows_between(0, columns.size());
  // By the first predictor of each: it is nearest to the column itself.
  const auto itself = [&](std::size_t c) {
    return problem.columns.col(static_cast<Eigen::Index>(fit.used[static_cast<std::size_t>(columns[c].used.front())]));
  };
  for (std::size_t a = 0; a < columns.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      if (!not_needed[a] || !not_needed[b] || columns[a].used.empty() || columns[b].used.empty()) continue;
      if (std::abs(correlation(itself(a), itself(b))) < kTogether) continue;
      const std::size_t from = of[a], to = of[b];
      for (std::size_t& one : of) one = one == from ? to : one;
    }
  }
  std::map<std::size_t, std::vector<std::string>> classes;
  for (std::size_t c = 0; c < columns.size(); ++c) classes[of[c]].push_back(columns[c].name);
  std::vector<std::vector<std::string>> result;
  for (auto& [first, names] : classes) {
    if (names.size() > 1) result.push_back(std::move(names));
  }
  return result;
}

std::vector<CancellingColumns> cancelling(const std::vector<DriverColumn>& columns, const Eigen::MatrixXd& added) {
  std::vector<CancellingColumns> pairs;
  for (std::size_t a = 0; a < columns.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      const Eigen::VectorXd x = added.col(static_cast<Eigen::Index>(a)), y = added.col(static_cast<Eigen::Index>(b));
      const double sum_um = range_in(x + y);
      if (!(std::min(range_in(x), range_in(y)) > 2.0 * sum_um) || correlation(x, y) > kAgainst) continue;
      pairs.push_back({columns[b].name, columns[a].name, range_in(y), range_in(x), sum_um});
    }
  }
  std::sort(pairs.begin(), pairs.end(),
            [](const auto& a, const auto& b) { return a.first_um + a.second_um > b.first_um + b.second_um; });
  if (pairs.size() > kMostCancelling) pairs.resize(kMostCancelling);
  return pairs;
}

}  // namespace

Eigen::VectorXd shares_of(const Eigen::MatrixXd& columns, const Eigen::VectorXd& sum) {
  const Eigen::VectorXd centred = sum.array() - sum.mean();
  const double norm = centred.squaredNorm();
  if (!(norm > 0.0)) return Eigen::VectorXd::Zero(columns.cols());
  return range_in(sum) / norm * (columns.transpose() * centred);
}

DriverReport driver_report(const Design& design, const Series& first_run, const RidgeProblem& problem,
                           const RidgeFit& fit, bool refit) {
  const std::vector<DriverColumn> columns = driver_columns(design, fit);
  Eigen::VectorXd gains = Eigen::VectorXd::Zero(problem.columns.cols());
  for (std::size_t k = 0; k < fit.used.size(); ++k)
    gains[static_cast<Eigen::Index>(fit.used[k])] = fit.gains_um[static_cast<Eigen::Index>(k) + 1];
  const Eigen::MatrixXd added = added_um(problem, fit, columns, gains);
  const Eigen::VectorXd sum = added.rowwise().sum();
  const Eigen::VectorXd share = shares_of(added, sum);
  const std::vector<std::size_t> fold = folds_of_rows(design, first_run, problem);
  const std::size_t folds = *std::max_element(fold.begin(), fold.end()) + 1;
  DriverReport report;
  report.range_um = range_in(sum);
  report.refits = refit && folds > 1 ? std::min(folds, kMostRefits) : 0;
  std::vector<Eigen::VectorXd> refitted(report.refits);
  in_parallel(report.refits, [&](std::size_t i) {
    std::vector<std::size_t> rows;
    for (std::size_t row = 0; row < fold.size(); ++row) {
      if (fold[row] % report.refits != i) rows.push_back(row);
    }
    const Eigen::MatrixXd again = added_um(problem, fit, columns, gains_from(problem, fit.setting, rows));
    refitted[i] = shares_of(again, sum);
  });
  std::vector<double> falls(columns.size(), std::numeric_limits<double>::infinity());
  in_parallel(refit ? columns.size() : 0, [&](std::size_t c) {
    falls[c] = fit.log_likelihood - log_likelihood_without(problem, fit.setting, columns[c].predictors);
  });
  std::vector<bool> not_needed;
  for (std::size_t c = 0; c < columns.size(); ++c) {
    not_needed.push_back(falls[c] < kSmallFall);
    if (not_needed.back()) report.not_needed.push_back(columns[c].name);
    if (columns[c].used.empty()) continue;
    const auto at = static_cast<Eigen::Index>(c);
    DriverStability one{
        {columns[c].name, find_column(first_run, columns[c].name)->role, share[at]}, share[at], share[at]};
    for (const Eigen::VectorXd& other : refitted) {
      one.low_um = std::min(one.low_um, other[at]);
      one.high_um = std::max(one.high_um, other[at]);
    }
    const double least = std::min(std::abs(one.low_um), std::abs(one.high_um));
    const double most = std::max(std::abs(one.low_um), std::abs(one.high_um));
    const bool same_sign = one.low_um * one.high_um > 0.0;
    one.stable = !refitted.empty() && same_sign && most <= kStable * least;
    one.flips = !same_sign && most > kMinor * report.range_um;
    report.drivers.push_back(one);
  }
  std::stable_sort(report.drivers.begin(), report.drivers.end(), [](const auto& a, const auto& b) {
    return std::abs(a.share.share_um) > std::abs(b.share.share_um);
  });
  report.interchangeable = classes_of(columns, not_needed, problem, fit);
  report.cancelling = cancelling(columns, added);
  return report;
}

}  // namespace ballbar
