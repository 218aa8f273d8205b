#include "after_test.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "ballbar/diagnosis/next_test/next_test.hpp"
#include "diagnosis/next_test/planned_test.hpp"
#include "numerics/random_streams.hpp"
#include "outcome.hpp"

namespace ballbar::study {
namespace {

constexpr double kBetween_s = 12.0 * 3600.0;
constexpr double kOffset_um = 3.0;  // standard deviation of a new set-up

// Signals of the data, then those of the test; readings of both.
Record both(const DataSet& set, const PlannedTest& test) {
  Record record;
  record.inputs.time_s = set.data.time_s;
  record.readings = set.base.row;
  const std::size_t before = set.data.time_s.size();
  for (const double since_s : test.inputs.time_s) {
    record.inputs.time_s.push_back(set.data.time_s.back() + kBetween_s + since_s);
  }
  for (const std::size_t row : test.rows) record.readings.push_back(before + row);
  for (const Column& planned : test.inputs.columns) {
    Column column = *find_column(set.data, planned.name);
    column.values.insert(column.values.end(), planned.values.begin(), planned.values.end());
    record.inputs.columns.push_back(std::move(column));
  }
  return record;
}

}  // namespace

std::optional<DataSet> after_proposed_test(const DataSet& set, const Diagnosis& found, Random& random) {
  const std::vector<NextTest> proposed = next_tests(set.model, set.data, found);
  if (proposed.empty()) return std::nullopt;
  const std::vector<PlannedTest> planned = drift_tests(set.data, kTarget, set.base.row);
  const auto test = std::find_if(planned.begin(), planned.end(),
                                 [&](const PlannedTest& one) { return one.name == proposed.front().name; });
  if (test == planned.end()) return std::nullopt;
  if (is_verbose()) fmt::print("       {}\n", proposed.front().text);

  DataSet again = data_set(both(set, *test), set.believed, set.scatter);
  const std::size_t before = set.data.time_s.size();
  for (const Hidden& hidden : set.hidden) {
    again.hidden.push_back({hidden.injection, hidden.what, signal_of(*hidden.injection, again.data)});
  }
  finish(again, random);
  std::vector<double>& target = again.data.columns.back().values;
  const std::vector<double>& old = set.data.columns.back().values;
  std::copy(old.begin(), old.end(), target.begin());
  const double offset_um = kOffset_um * simulation::normal(random);
  for (std::size_t row = before; row < target.size(); ++row) target[row] += offset_um;

  Term new_set_up = term_of("step", {});
  for (std::size_t k = 0; k < new_set_up.settings.size(); ++k) {
    if (new_set_up.effect->parameters[k].name != "onset_s") continue;
    new_set_up.settings[k].start = 0.5 * (set.data.time_s.back() + again.data.time_s[before]);
    new_set_up.settings[k].held = true;
    new_set_up.settings[k].stated = true;
  }
  const auto added = set.model.terms.begin() + static_cast<std::ptrdiff_t>(set.believed.size());
  again.model.terms.insert(again.model.terms.end(), added, set.model.terms.end());  // of earlier tests
  again.model.terms.push_back(std::move(new_set_up));
  again.base = fit(again.model, again.data, 0, {.white = true});
  again.options = set.options;
  return again;
}

}  // namespace ballbar::study
