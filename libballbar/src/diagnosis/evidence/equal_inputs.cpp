#include "diagnosis/evidence/equal_inputs.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <utility>

#include "ballbar/internal/numerics/interruption.hpp"
#include "series/equal_columns.hpp"
#include "series/resolution.hpp"

namespace ballbar {
namespace {

// The variance of the readings about their curve; of a sensor without noise that of its rounding.
double variance_about(const std::vector<double>& curve, const std::vector<double>& read) {
  const auto count = static_cast<Eigen::Index>(read.size());
  const double resolution = resolution_of(read);
  return (Eigen::ArrayXd::Map(curve.data(), count) - Eigen::ArrayXd::Map(read.data(), count)).square().mean() +
         resolution * resolution / 12.0;
}

// The readings without those in which either sensor is saturated or stuck.
std::vector<double> read_by_both(const Series& data, const LoggedInput& input, const LoggedInput& other) {
  std::vector<double> values = find_column(data, input.column)->values;
  for (const LoggedInput* one : {&input, &other}) {
    for (const std::size_t row : one->at_end) values[row] = std::numeric_limits<double>::quiet_NaN();
  }
  return values;
}

// nullopt: they do not measure the same quantity.
std::optional<LinearRelation> relation_of(const Series& data, const LoggedInput& input, const LoggedInput& other) {
  expect_no_interruption();
  if (input.is_stepped != other.is_stepped || unit_of(input.column) != unit_of(other.column)) return std::nullopt;
  return equal_columns(read_by_both(data, input, other), read_by_both(data, other, input),
                       std::max(input.held, other.held));
}

}  // namespace

void take_means(const Series& data, LoggedInputs& logged) {
  std::set<std::string> taken;
  for (std::size_t i = 0; i < logged.inputs.size(); ++i) {
    const LoggedInput& first = logged.inputs[i];
    if (taken.contains(first.column)) continue;
    std::vector<std::pair<const LoggedInput*, LinearRelation>> group{{&first, {}}};
    for (std::size_t k = i + 1; k < logged.inputs.size(); ++k) {
      const LoggedInput& other = logged.inputs[k];
      if (taken.contains(other.column)) continue;
      const auto relation = relation_of(data, first, other);
      if (!relation) continue;
      if (std::all_of(group.begin() + 1, group.end(),
                      [&](const auto& one) { return relation_of(data, *one.first, other).has_value(); }))
        group.emplace_back(&other, *relation);
    }
    if (group.size() == 1) continue;
    const auto curve_of = [&](const LoggedInput& input) -> std::vector<double>& {
      return std::find_if(logged.series.columns.begin(), logged.series.columns.end(),
                          [&](const Column& column) { return column.name == input.column; })
          ->values;
    };
    std::vector<double> mean(data.time_s.size(), 0.0);
    double weights = 0.0;
    for (const auto& [input, relation] : group) {
      const std::vector<double>& curve = curve_of(*input);
      const double scale = relation.slope * relation.slope;
      const double weight = scale / std::max(variance_about(curve, find_column(data, input->column)->values), 1e-12);
      weights += weight;
      for (std::size_t row = 0; row < mean.size(); ++row)
        mean[row] += weight * (curve[row] - relation.offset) / relation.slope;
      taken.insert(input->column);
      if (input != &first) logged.equal.push_back({first.column, input->column});
    }
    if (first.is_stepped) continue;  // the same steps, each with its own jumps
    for (const auto& [input, relation] : group) {
      std::vector<double>& curve = curve_of(*input);
      for (std::size_t row = 0; row < mean.size(); ++row)
        curve[row] = relation.offset + relation.slope * mean[row] / weights;
    }
  }
}

}  // namespace ballbar
