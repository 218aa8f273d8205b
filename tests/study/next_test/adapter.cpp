#include "next_test/adapter.hpp"

#include <fmt/format.h>

#include <string>

#include "ballbar/diagnosis/next_test/plan.hpp"
#include "ballbar/internal/model/run_terms.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar::next_test {

Joined joined(const Model& model, const std::vector<Series>& runs) {
  std::vector<std::string> names;
  for (std::size_t run = 0; run < runs.size(); ++run) names.push_back(fmt::format("run {}", run + 1));
  Series data = stacked(runs, names).series;
  Model with = with_run_terms(without_run_terms(model), data);
  return {std::move(data), std::move(with)};
}

std::optional<Design> plan_of(const Joined& joined, const Diagnosis&, double hours, double max_rpm,
                              std::uint64_t seed) {
  TestPlanOptions options;
  options.most_hours = hours;
  options.max_rpm = max_rpm;
  options.seed = seed;
  const TestPlan plan = test_plan(joined.model, joined.data, 0, options);
  if (plan.tests.empty()) return std::nullopt;
  return Design{plan.tests.front().schedule, plan.tests.front().p_right};
}

}  // namespace ballbar::next_test
