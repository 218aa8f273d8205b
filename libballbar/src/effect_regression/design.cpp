#include "effect_regression/design.hpp"

#include <fmt/format.h>

#include <cmath>

#include "ballbar/error.hpp"
#include "ballbar/model/model.hpp"
#include "ballbar/numerics/parallel.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kFewestValues = 40;

// Rows of a run at which the target is known.
std::vector<std::size_t> known_rows(const Series& run, const std::string& target) {
  const Column* column = find_column(run, target);
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < column->values.size(); ++i) {
    if (std::isfinite(column->values[i])) rows.push_back(i);
  }
  return rows;
}

}  // namespace

std::vector<std::size_t> thinned(const std::vector<std::size_t>& rows, std::size_t most) {
  const std::size_t step = (rows.size() + most - 1) / std::max<std::size_t>(1, most);
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < rows.size(); i += std::max<std::size_t>(1, step)) kept.push_back(rows[i]);
  return kept;
}

Design design_of(std::span<const Series> runs, const std::string& target, const Catalogue& catalogue) {
  Design design;
  design.runs = runs.size();
  std::vector<std::vector<std::size_t>> rows;
  std::size_t count = 0;
  for (const Series& run : runs) {
    expect_explainable({target}, run);
    rows.push_back(known_rows(run, target));
    count += rows.back().size();
  }
  if (count < kFewestValues) {
    throw Error(fmt::format("{}: expected at least {} values to train on, found {}.", target, kFewestValues, count));
  }
  const std::size_t step = (count + kMostDesignRows - 1) / kMostDesignRows;
  for (std::vector<std::size_t>& of_run : rows) of_run = thinned(of_run, (of_run.size() + step - 1) / step);
  design.predictors = predictors_of(runs, target, catalogue);
  std::vector<double> values;
  std::vector<Eigen::Index> first;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    first.push_back(static_cast<Eigen::Index>(design.time_s.size()));
    const Column& measured = *find_column(runs[r], target);
    for (const std::size_t i : rows[r]) {
      design.time_s.push_back(runs[r].time_s[i]);
      design.run.push_back(r);
      design.row.push_back(i);
      values.push_back(measured.values[i]);
    }
  }
  const auto n = static_cast<Eigen::Index>(values.size());
  design.target_um = Eigen::Map<const Eigen::VectorXd>(values.data(), n);
  design.values.resize(n, static_cast<Eigen::Index>(design.predictors.each.size()));
  in_parallel(design.predictors.each.size(), [&](std::size_t k) {
    const Predictor& predictor = design.predictors.each[k];
    std::vector<double> out;
    for (std::size_t r = 0; r < runs.size(); ++r) {
      EffectRows all{runs[r].time_s, {}};
      for (const std::string& name : predictor.columns) all.inputs.emplace_back(find_column(runs[r], name)->values);
      out.resize(runs[r].time_s.size());
      predictor.effect->evaluate(all, predictor.parameters.data(), out.data(), nullptr);
      for (std::size_t i = 0; i < rows[r].size(); ++i) {
        design.values(first[r] + static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) = out[rows[r][i]];
      }
    }
  });
  return design;
}

}  // namespace ballbar
