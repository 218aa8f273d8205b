#include "diagnosis/verdict/few_readings.hpp"

#include <algorithm>
#include <cmath>

#include "ballbar/series/signal_kind.hpp"
#include "numerics/orthonormal.hpp"

namespace ballbar {
namespace {

constexpr double kClearLead = 6.0;  // strong evidence on the scale of Kass and Raftery

struct Subset {
  std::vector<std::string> columns;
  double criterion = 0.0;
};

struct InputColumn {
  std::string name;
  Eigen::VectorXd values;
};

std::vector<InputColumn> input_columns(const Problem& problem) {
  std::vector<InputColumn> found;
  for (const Column& column : problem.logged.series.columns) {
    const std::vector<std::string>& targets = problem.model.targets;
    if (column.role == Role::measured || std::find(targets.begin(), targets.end(), column.name) != targets.end())
      continue;
    if (!may_drive(column.values)) continue;
    InputColumn one{column.name, Eigen::VectorXd(problem.y.size())};
    for (Eigen::Index i = 0; i < one.values.size(); ++i)
      one.values[i] = column.values[problem.base.row[static_cast<std::size_t>(i)]];
    if (one.values.allFinite()) found.push_back(std::move(one));
  }
  return found;
}

}  // namespace

std::vector<std::string> clear_subset(const Problem& problem, const Variant& variant) {
  const std::vector<InputColumn> inputs = input_columns(problem);
  const auto n = static_cast<double>(problem.y.size());
  std::vector<Eigen::Index> free;
  for (std::size_t k = 0; k < variant.line.columns.size(); ++k) {
    if (variant.line.is_free[k] != 0) free.push_back(variant.line.columns[k]);
  }
  const Eigen::MatrixXd model = variant.pool(Eigen::all, free);
  const Eigen::VectorXd y = variant.pool.col(0);
  std::vector<Subset> subsets;
  const auto add = [&](const std::vector<std::size_t>& chosen) {
    Eigen::MatrixXd columns(model.rows(), model.cols() + static_cast<Eigen::Index>(chosen.size()));
    columns.leftCols(model.cols()) = model;
    Subset subset;
    for (std::size_t k = 0; k < chosen.size(); ++k) {
      columns.col(model.cols() + static_cast<Eigen::Index>(k)) = inputs[chosen[k]].values;
      subset.columns.push_back(inputs[chosen[k]].name);
    }
    const double left = orthogonal_part(y, orthonormal(columns)).squaredNorm();
    subset.criterion = n * std::log(std::max(left, 1e-300) / n) + static_cast<double>(columns.cols()) * std::log(n);
    subsets.push_back(std::move(subset));
  };
  for (std::size_t a = 0; a < inputs.size(); ++a) {
    add({a});
    for (std::size_t b = a + 1; b < inputs.size(); ++b) add({a, b});
  }
  if (subsets.empty()) return {};
  std::stable_sort(subsets.begin(), subsets.end(),
                   [](const Subset& a, const Subset& b) { return a.criterion < b.criterion; });
  const std::vector<std::string>& best = subsets.front().columns;
  const auto has_all = [&](const Subset& other) {
    return std::all_of(best.begin(), best.end(), [&](const std::string& name) {
      return std::find(other.columns.begin(), other.columns.end(), name) != other.columns.end();
    });
  };
  const bool is_clear = std::all_of(subsets.begin() + 1, subsets.end(), [&](const Subset& other) {
    return has_all(other) || other.criterion > subsets.front().criterion + kClearLead;
  });
  return is_clear ? best : std::vector<std::string>{};
}

}  // namespace ballbar
