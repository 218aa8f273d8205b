#include "metamorphic.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "cells.hpp"
#include "numerics/random_streams.hpp"

namespace ballbar::study {
namespace {

template <class Keeps>
Series kept_rows(const Series& data, Keeps keeps) {
  Series result;
  for (const Column& column : data.columns) result.columns.push_back({column.name, column.role, {}});
  for (std::size_t row = 0; row < data.time_s.size(); ++row) {
    if (!keeps(row)) continue;
    result.time_s.push_back(data.time_s[row]);
    for (std::size_t k = 0; k < data.columns.size(); ++k) {
      result.columns[k].values.push_back(data.columns[k].values[row]);
    }
  }
  return result;
}

using Names = std::map<std::string, std::string>;  // of the changed data, to those before

void rename(std::vector<std::string>& names, const Names& to) {
  for (std::string& name : names) {
    const auto at = to.find(name);
    if (at != to.end()) name = at->second;
  }
}

// "T_room_degC" becomes "c2_degC"; the target keeps its name.
Names renamed(DataSet& set) {
  Names back, forth;
  for (std::size_t k = 0; k + 1 < set.data.columns.size(); ++k) {
    std::string& name = set.data.columns[k].name;
    const std::string next = fmt::format("c{}_{}", set.data.columns.size() - k, unit_of(name));
    back[next] = name;
    forth[name] = next;
    name = next;
  }
  for (Term& term : set.model.terms) rename(term.columns, forth);
  return back;
}

std::vector<std::string> named_in(const Diagnosis& found, const Names& back) {
  std::vector<std::string> labels;
  for (BoundEffect bound : found.named) {
    rename(bound.columns, back);
    labels.push_back(label_of(bound));
  }
  std::sort(labels.begin(), labels.end());
  return labels;
}

}  // namespace

Outcome outcome_of_change(Change change, std::uint64_t seed) {
  const bool dense = change == Change::resampled;
  DataSet set = rich_set(seed, seed % 3 == 0 ? 0 : 1, 10.0, {}, dense ? 1 : 5);
  const Diagnosis before = diagnose(set.model, set.data, 0, set.options);
  const DataSet whole = set;
  Random random(seed + 991);
  Names back;
  switch (change) {
    case Change::fewer_rows:
      set.data = kept_rows(set.data, [&](std::size_t) { return simulation::uniform(random) >= 0.3; });
      break;
    case Change::resampled:
      set.data = kept_rows(set.data, [](std::size_t row) { return row % 4 == 0; });
      break;
    case Change::renamed:
      back = renamed(set);
      break;
    case Change::noise_input: {
      Column noise{"T_noise_degC", Role::structure, {}};
      while (noise.values.size() < set.data.time_s.size()) {
        noise.values.push_back(22.0 + 0.1 * simulation::normal(random));
      }
      log_also(set, std::move(noise));
      break;
    }
    case Change::turned:
      std::reverse(set.data.columns.begin(), set.data.columns.end());
      break;
  }
  const Diagnosis after = diagnose(set.model, set.data, 0, set.options);
  Outcome outcome = judged(whole, before, whole.hidden.empty() ? Expected::nothing : Expected::effects);
  outcome.right = before.verdict == after.verdict && named_in(before, {}) == named_in(after, back);
  if (is_verbose()) {
    fmt::print("{:4} {} {} [{}] -> {} [{}]\n", seed, outcome.right ? "same" : "OTHER", name_of(before.verdict),
               fmt::join(named_in(before, {}), " "), name_of(after.verdict), fmt::join(named_in(after, back), " "));
  }
  return outcome;
}

}  // namespace ballbar::study
