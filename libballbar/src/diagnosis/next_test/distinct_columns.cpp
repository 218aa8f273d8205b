#include "diagnosis/next_test/distinct_columns.hpp"

#include <algorithm>

#include "diagnosis/posterior/problem.hpp"

namespace ballbar {
namespace {

constexpr double kLeastP = 0.2;

bool is_read(const std::string& column, const Model& model) {
  return std::any_of(model.terms.begin(), model.terms.end(), [&](const Term& term) {
    return std::find(term.columns.begin(), term.columns.end(), column) != term.columns.end();
  });
}

}  // namespace

DistinctColumns distinct_columns_of(const Series& data, const Model& model, std::size_t target) {
  std::vector<std::vector<std::string>> classes;
  for (const EqualColumns& one : logged_inputs_of(model, data, target, {}).equal) {
    if (classes.empty() || classes.back().front() != one.column) classes.push_back({one.column});
    classes.back().push_back(one.other);
  }
  DistinctColumns result;
  result.data = data;
  const auto is_of_model = [&](const std::string& name) { return is_read(name, model); };
  for (const std::vector<std::string>& columns : classes) {
    const auto read = std::find_if(columns.begin(), columns.end(), is_of_model);
    const std::string& kept = read == columns.end() ? columns.front() : *read;
    for (const std::string& other : columns) {
      if (other == kept || is_of_model(other)) continue;
      result.equal.push_back({kept, other});
      std::erase_if(result.data.columns, [&](const Column& column) { return column.name == other; });
    }
  }
  return result;
}

std::vector<std::vector<BoundEffect>> inseparable_effects(const Diagnosis& diagnosis, const DistinctColumns& distinct) {
  std::vector<std::vector<BoundEffect>> groups;
  for (const EffectProbability& effect : diagnosis.effects) {
    if (effect.p < kLeastP) continue;
    std::vector<BoundEffect> group{effect.bound};
    for (const EqualColumns& equal : distinct.equal) {
      BoundEffect other = effect.bound;
      std::replace(other.columns.begin(), other.columns.end(), equal.column, equal.other);
      if (!(other == effect.bound)) group.push_back(std::move(other));
    }
    if (group.size() > 1) groups.push_back(std::move(group));
  }
  return groups;
}

}  // namespace ballbar
