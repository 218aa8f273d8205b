#include "diagnosis/next_test/test_plan_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <vector>

#include "diagnosis/thresholds.hpp"

namespace ballbar {
namespace {

std::string percent(double p) { return fmt::format("{:.0f} %", 100.0 * p); }

std::string inseparable_text(const std::vector<std::vector<BoundEffect>>& groups) {
  std::string text;
  for (const std::vector<BoundEffect>& group : groups) {
    std::vector<std::string> labels;
    labels.reserve(group.size());
    for (const BoundEffect& one : group) labels.push_back(label_of(one));
    const bool is_twin = group[0].effect == group[1].effect && group[0].columns.size() == 1;
    text += fmt::format("{}No test can tell {} apart: {}.", text.empty() ? "" : " ", fmt::join(labels, " and "),
                        is_twin ? "their columns read the same" : "beside this model they add the same");
  }
  return text;
}

}  // namespace

std::string sentence_of(const TestPlan& plan, const TestPlanOptions& options) {
  const std::string inseparable = inseparable_text(plan.inseparable);
  const std::string behind = inseparable.empty() ? "" : " " + inseparable;
  if (plan.is_decided) return "The data at hand decide: no further test is needed." + behind;
  const bool is_nothing = plan.verdict == Verdict::nothing;
  if (is_nothing && plan.p_nothing >= kSureOfNothing)
    return "By the data at hand nothing is missing: there is nothing to decide." + behind;
  if (plan.tests.empty()) {
    if (is_nothing) {
      return fmt::format(
                 "Nothing is found, P of nothing {:.2f}; no test of up to {:g} h on the menu would find what may be "
                 "there.",
                 plan.p_nothing, options.most_hours) +
             behind;
    }
    if (!inseparable.empty()) return inseparable + " No test is proposed.";
    return fmt::format("No test of up to {:g} h on the menu would decide; none is proposed.", options.most_hours);
  }
  const ExpectedTest& best = plan.tests.front();
  std::string text = is_nothing ? fmt::format("Nothing is found yet, P of nothing {:.2f}. ", plan.p_nothing) : "";
  text += fmt::format(
      "Run {:g} h from cold: {}. It would name all that is missing in {} of cases (± {:.0f}, {} "
      "simulated)",
      best.hours, best.doing, percent(best.p_right), 100.0 * best.p_right_sigma, best.truths);
  if (best.p_part > best.p_right) text += fmt::format(", at least some of it in {}", percent(best.p_part));
  text += fmt::format(", and something wrong in {}.", percent(best.p_wrong));
  if (best.p_right < kSureEnough) {
    text += fmt::format(" No test of up to {:g} h reaches {}.", options.most_hours, percent(kSureEnough));
  }
  for (const SensorToAdd& sensor : plan.sensors) {
    text += fmt::format(" A temperature sensor {} would raise it to {} in the same run.", sensor.place,
                        percent(sensor.p_right));
  }
  return text + behind;
}

}  // namespace ballbar
