#include "plan/plan_sentence.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

#include "ballbar/diagnosis/signatures/search.hpp"
#include "ballbar/internal/number_text.hpp"
#include "ballbar/message_catalogue.hpp"
#include "plan/plan_result.hpp"

namespace ballbar {
namespace {

std::string short_text(double value) { return fmt::format("{:g}", value); }

// "the room 3 K warmer and back", "2 times the load and back"; empty: only the speed changes.
std::vector<MessageValue> moves_of(const ExpectedTest& test) {
  const auto largest = [&](double Dwell::*member) {
    double most = 0.0;
    for (const Dwell& dwell : test.schedule.dwells) most = std::max(most, dwell.*member);
    return most;
  };
  std::vector<MessageValue> moves;
  const double room_K = largest(&Dwell::room_K), coolant_K = largest(&Dwell::coolant_K), load = largest(&Dwell::load);
  if (room_K > 0.0) moves.emplace_back(messages::plan_room(short_text(room_K)));
  if (coolant_K > 0.0) moves.emplace_back(messages::plan_coolant(short_text(coolant_K)));
  if (load > 1.0 && test.speeds != SpeedProgram::rest) moves.emplace_back(messages::plan_load(short_text(load)));
  return moves;
}

// "speeds that change every 10 min to 2 h, up to 9500 rpm"
Message speeds_of(const ExpectedTest& test) {
  const std::string rpm = grouped_text(test.max_rpm);
  switch (test.speeds) {
    case SpeedProgram::random:
      return messages::plan_random(rpm);
    case SpeedProgram::staircase:
      return messages::plan_staircase(rpm);
    case SpeedProgram::stop_and_go:
      return messages::plan_stop_and_go(rpm);
    case SpeedProgram::rest:
      break;
  }
  return messages::plan_at_rest();
}

Message short_name_of(const ExpectedTest& test) {
  switch (test.speeds) {
    case SpeedProgram::random:
      return messages::plan_name_random();
    case SpeedProgram::staircase:
      return messages::plan_name_staircase();
    case SpeedProgram::stop_and_go:
      return messages::plan_name_stop_and_go();
    case SpeedProgram::rest:
      break;
  }
  return messages::plan_at_rest();
}

Message whole_percent(double p) { return messages::percent(fmt::format("{:.0f}", 100.0 * p)); }

Paragraph inseparable_sentences(const std::vector<std::vector<BoundEffect>>& groups) {
  Paragraph text;
  for (const std::vector<BoundEffect>& group : groups) {
    std::vector<MessageValue> labels;
    labels.reserve(group.size());
    for (const BoundEffect& one : group) labels.emplace_back(EffectLabel{label_of(one)});
    const bool is_twin = group[0].effect == group[1].effect && group[0].columns.size() == 1;
    text += is_twin ? messages::plan_same_quantity(enumerated(labels)) : messages::plan_same_curve(enumerated(labels));
  }
  return text;
}

Paragraph best_test_sentences(const TestPlan& plan, double most_hours) {
  const ExpectedTest& best = plan.tests.front();
  Paragraph doing = speeds_of(best), part;
  if (const std::vector<MessageValue> moves = moves_of(best); !moves.empty())
    doing = semicolon_list({doing, listed(moves)});
  Paragraph text = messages::plan_run(short_text(best.hours), doing);
  if (best.p_part > best.p_right) part = messages::plan_outcome_part(whole_percent(best.p_part));
  text += messages::plan_outcome(whole_percent(best.p_right), fmt::format("{:.0f}", 100.0 * best.p_right_sigma),
                                 best.truths, part, whole_percent(best.p_wrong));
  if (best.p_right < kSureEnough)
    text += messages::plan_not_sure_enough(short_text(most_hours), whole_percent(kSureEnough));
  if (plan.sensor) text += messages::plan_sensor(place_of(*plan.sensor), whole_percent(plan.sensor->p_right));
  return text;
}

}  // namespace

Paragraph name_of(const ExpectedTest& test) {
  std::vector<MessageValue> parts = moves_of(test);
  parts.insert(parts.begin(), short_name_of(test));
  return listed(parts);
}

std::string label_of(const ExpectedCurve& curve) {
  std::vector<std::string> labels;
  labels.reserve(curve.effects.size());
  for (const BoundEffect& one : curve.effects) labels.push_back(label_of(one));
  return labels.empty() ? "nothing of the catalogue" : fmt::format("{}", fmt::join(labels, " + "));
}

Message place_of(const SensorToAdd& sensor) {
  return messages::plan_sensor_place(EffectLabel{label_of(sensor.effect)});
}

Paragraph sentence_of(const TestPlan& plan, double most_hours) {
  if (plan.obstacle != Obstacle::none) return messages::plan_not_possible();
  const Paragraph inseparable = inseparable_sentences(plan.inseparable);
  const std::string hours = short_text(most_hours);
  const bool is_nothing = plan.verdict == Verdict::nothing;
  Paragraph text;
  if (plan.is_decided) {
    text = messages::plan_decided();
  } else if (is_nothing && plan.p_nothing >= kSureOfNothing) {
    text = messages::plan_nothing_to_decide();
  } else if (plan.tests.empty() && is_nothing) {
    text = messages::plan_nothing_found(sure_of(plan.p_nothing), hours);
  } else if (plan.tests.empty()) {
    if (inseparable.empty()) return messages::plan_none(hours);
    text = inseparable;
    text += messages::plan_no_test();
    return text;
  } else {
    if (is_nothing) text = messages::plan_nothing_found_yet(sure_of(plan.p_nothing));
    text += best_test_sentences(plan, most_hours);
  }
  text += inseparable;
  return text;
}

std::optional<Schedule> best_schedule(const std::vector<ExpectedTest>& tests) {
  return tests.empty() ? std::nullopt : std::optional(tests.front().schedule);
}

std::vector<std::vector<std::string>> labels_of(const std::vector<std::vector<BoundEffect>>& groups) {
  std::vector<std::vector<std::string>> labels;
  for (const std::vector<BoundEffect>& group : groups) {
    labels.emplace_back();
    for (const BoundEffect& one : group) labels.back().push_back(label_of(one));
  }
  return labels;
}

std::vector<SensorToAdd> sensors_of(const TestPlan& plan) {
  return plan.sensor ? std::vector{*plan.sensor} : std::vector<SensorToAdd>{};
}

}  // namespace ballbar
