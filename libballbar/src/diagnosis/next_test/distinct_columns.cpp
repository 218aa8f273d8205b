#include "diagnosis/next_test/distinct_columns.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "series/resolution.hpp"

namespace ballbar {
namespace {

constexpr double kLeastP = 0.2;
constexpr double kOfAStep = 0.6;      // largest distance of two equal columns, in steps of the coarser
constexpr double kOfTheRange = 1e-9;  // the same without steps, relative to the range

bool is_input(const Column& column, const Model& model) {
  return std::find(model.targets.begin(), model.targets.end(), column.name) == model.targets.end() &&
         column.role != Role::measured && !unit_of(column.name).empty();
}

bool is_read(const Column& column, const Model& model) {
  return std::any_of(model.terms.begin(), model.terms.end(), [&](const Term& term) {
    return std::find(term.columns.begin(), term.columns.end(), column.name) != term.columns.end();
  });
}

bool are_one(const Column& a, const Column& b) {
  if (unit_of(a.name) != unit_of(b.name)) return false;
  std::vector<Eigen::Index> known;
  for (std::size_t i = 0; i < a.values.size(); ++i) {
    if (std::isfinite(a.values[i]) != std::isfinite(b.values[i])) return false;
    if (std::isfinite(a.values[i])) known.push_back(static_cast<Eigen::Index>(i));
  }
  if (known.size() < 3) return false;
  const auto centred = [&](const std::vector<double>& values) {
    const Eigen::VectorXd of = Eigen::VectorXd::Map(values.data(), static_cast<Eigen::Index>(values.size()))(known);
    return Eigen::VectorXd(of.array() - of.mean());
  };
  const Eigen::VectorXd x = centred(a.values), y = centred(b.values);
  if (!(x.squaredNorm() > 0.0) || !(y.squaredNorm() > 0.0)) return false;
  const double slope = x.dot(y) / x.squaredNorm();
  const double step = std::max(std::abs(slope) * resolution_of(a.values), resolution_of(b.values));
  const double range = y.norm() / std::sqrt(static_cast<double>(known.size()));
  return (y - slope * x).cwiseAbs().maxCoeff() <= std::max(kOfAStep * step, kOfTheRange * range);
}

}  // namespace

DistinctColumns distinct_columns_of(const Series& data, const Model& model) {
  DistinctColumns result;
  const auto is_taken = [&](const Column& column) {
    return std::any_of(result.twins.begin(), result.twins.end(),
                       [&](const Twin& one) { return one.other == column.name; });
  };
  for (std::size_t a = 0; a < data.columns.size(); ++a) {
    if (!is_input(data.columns[a], model)) continue;
    for (std::size_t b = 0; b < data.columns.size() && !is_taken(data.columns[a]); ++b) {
      const Column& other = data.columns[b];
      const bool is_later = b > a || is_read(data.columns[a], model);
      if (b == a || !is_later || !is_input(other, model) || is_read(other, model) || is_taken(other)) continue;
      if (are_one(data.columns[a], other)) result.twins.push_back({data.columns[a].name, other.name});
    }
  }
  result.data = data;
  std::erase_if(result.data.columns, is_taken);
  return result;
}

std::vector<std::vector<BoundEffect>> inseparable_effects(const Diagnosis& diagnosis, const DistinctColumns& distinct) {
  std::vector<std::vector<BoundEffect>> groups;
  for (const EffectProbability& effect : diagnosis.effects) {
    if (effect.p < kLeastP) continue;
    std::vector<BoundEffect> group{effect.bound};
    for (const Twin& twin : distinct.twins) {
      BoundEffect other = effect.bound;
      std::replace(other.columns.begin(), other.columns.end(), twin.kept, twin.other);
      if (!(other == effect.bound)) group.push_back(std::move(other));
    }
    if (group.size() > 1) groups.push_back(std::move(group));
  }
  return groups;
}

}  // namespace ballbar
