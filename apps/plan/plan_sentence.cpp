#include "plan/plan_sentence.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "ballbar/diagnosis/signatures/search.hpp"
#include "ballbar/internal/number_text.hpp"

namespace ballbar {
namespace {

// "the room 3 K warmer and back, 2 times the load and back"; empty: only the speed changes.
std::string moves_text(const ExpectedTest& test) {
  const auto largest = [&](double Dwell::*member) {
    double most = 0.0;
    for (const Dwell& dwell : test.schedule.dwells) most = std::max(most, dwell.*member);
    return most;
  };
  std::vector<std::string> moves;
  const double room_K = largest(&Dwell::room_K), coolant_K = largest(&Dwell::coolant_K), load = largest(&Dwell::load);
  if (room_K > 0.0) moves.push_back(fmt::format("the room {:g} K warmer and back", room_K));
  if (coolant_K > 0.0) moves.push_back(fmt::format("the coolant {:g} K warmer and back", coolant_K));
  if (load > 1.0 && test.speeds != SpeedProgram::rest)
    moves.push_back(fmt::format("{:g} times the load and back", load));
  return fmt::format("{}", fmt::join(moves, ", "));
}

// "speeds that change every 10 min to 2 h, up to 9500 rpm"
std::string doing_text(const ExpectedTest& test) {
  const std::string rpm = grouped_text(test.max_rpm), moves = moves_text(test);
  std::string text = "at rest";
  if (test.speeds == SpeedProgram::random)
    text = fmt::format("speeds that change every 10 min to 2 h, up to {} rpm", rpm);
  if (test.speeds == SpeedProgram::staircase) text = fmt::format("a staircase of speeds up to {} rpm", rpm);
  if (test.speeds == SpeedProgram::stop_and_go) text = fmt::format("{} rpm and rest by turns, 10 min to 2 h each", rpm);
  return moves.empty() ? text : text + "; " + moves;
}

std::string whole_percent(double p) { return fmt::format("{:.0f} %", 100.0 * p); }

std::string inseparable_text(const std::vector<std::vector<BoundEffect>>& groups) {
  std::string text;
  for (const std::vector<BoundEffect>& group : groups) {
    std::string labels = label_of(group.front());
    for (std::size_t k = 1; k < group.size(); ++k)
      labels += (k + 1 == group.size() ? " and " : ", ") + label_of(group[k]);
    const bool is_twin = group[0].effect == group[1].effect && group[0].columns.size() == 1;
    text += fmt::format("{}No test can distinguish {}: {}.", text.empty() ? "" : " ", labels,
                        is_twin ? "their columns hold the same values" : "beside this model they add the same curve");
  }
  return text;
}

std::string best_test_text(const TestPlan& plan, double most_hours) {
  const ExpectedTest& best = plan.tests.front();
  std::string text = fmt::format(
      "Run {:g} h from cold: {}. This run would name everything that is missing in {} of cases (± {:.0f} %, {} "
      "simulated)",
      best.hours, doing_text(best), whole_percent(best.p_right), 100.0 * best.p_right_sigma, best.truths);
  if (best.p_part > best.p_right) text += fmt::format(", a part of it in {}", whole_percent(best.p_part));
  text += fmt::format(", and something wrong in {}.", whole_percent(best.p_wrong));
  if (best.p_right < kSureEnough) {
    text += fmt::format(" No test of up to {:g} h reaches {}.", most_hours, whole_percent(kSureEnough));
  }
  if (plan.sensor) {
    text += fmt::format(" A temperature sensor {} would raise it to {} in the same run.", place_of(*plan.sensor),
                        whole_percent(plan.sensor->p_right));
  }
  return text;
}

}  // namespace

std::string name_of(const ExpectedTest& test) {
  constexpr std::string_view kNames[] = {"random speeds", "staircase", "stop and go", "at rest"};
  const std::string name(kNames[static_cast<std::size_t>(test.speeds)]), moves = moves_text(test);
  return moves.empty() ? name : name + ", " + moves;
}

std::string label_of(const ExpectedCurve& curve) {
  std::vector<std::string> labels;
  labels.reserve(curve.effects.size());
  for (const BoundEffect& one : curve.effects) labels.push_back(label_of(one));
  return labels.empty() ? "nothing of the catalogue" : fmt::format("{}", fmt::join(labels, " + "));
}

std::string place_of(const SensorToAdd& sensor) { return fmt::format("where {} heats", label_of(sensor.effect)); }

std::string sentence_of(const TestPlan& plan, double most_hours) {
  if (plan.obstacle != Obstacle::none)
    return "The data have too few values, or do not move: nothing can be planned from them.";
  const std::string inseparable = inseparable_text(plan.inseparable);
  const std::string behind = inseparable.empty() ? "" : " " + inseparable;
  const bool is_nothing = plan.verdict == Verdict::nothing;
  if (plan.is_decided) return "These data already decide: no further test is needed." + behind;
  if (is_nothing && plan.p_nothing >= kSureOfNothing)
    return "In these data nothing is missing: there is nothing to decide." + behind;
  if (plan.tests.empty() && is_nothing) {
    return fmt::format(
               "Nothing is found to be missing ({}). No test of up to {:g} h would find what may still be there.",
               sure_text(plan.p_nothing), most_hours) +
           behind;
  }
  if (plan.tests.empty() && !inseparable.empty()) return inseparable + " No test is proposed.";
  if (plan.tests.empty()) return fmt::format("No test of up to {:g} h would decide. None is proposed.", most_hours);
  const std::string before =
      is_nothing ? fmt::format("Nothing is found to be missing yet ({}). ", sure_text(plan.p_nothing)) : "";
  return before + best_test_text(plan, most_hours) + behind;
}

}  // namespace ballbar
