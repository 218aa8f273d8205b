#include "model/testability_text.hpp"

#include <algorithm>
#include <utility>

#include "ballbar/internal/number_text.hpp"
#include "ballbar/message_catalogue.hpp"

namespace ballbar {
namespace {

Message role_message(const std::string& role) {
  if (role == "load") return messages::role_load();
  if (role == "speed") return messages::role_speed();
  if (role == "temperature") return messages::role_temperature();
  return as_it_is(role);
}

Message units_message(const std::vector<std::string>& units) {
  if (units.empty()) return messages::units_any();
  Message all = as_it_is(units.front());
  for (std::size_t k = 1; k < units.size(); ++k) all = messages::units_or(std::move(all), units[k]);
  return all;
}

Message missing_inputs(const Detectability& untestable) {
  const Deficiency& deficiency = untestable.deficiency;
  std::vector<MessageValue> inputs;
  inputs.reserve(deficiency.missing_inputs.size());
  for (const MissingInput& input : deficiency.missing_inputs)
    inputs.emplace_back(messages::untestable_input(role_message(input.role), units_message(input.units)));
  if (!inputs.empty()) return messages::untestable_no_column(listed(inputs));
  if (deficiency.none_accepted.empty()) return messages::untestable_too_few_columns();
  return effect_text(name_of(untestable.effect->level), untestable.effect->name, "none_accepted",
                     deficiency.none_accepted);
}

}  // namespace

std::string_view name_of(Testability testability) {
  constexpr std::string_view kNames[] = {"testable",     "input missing", "input constant", "absorbed by the model",
                                         "in the model", "other motion",  "no clock",       "rows too far apart"};
  return kNames[static_cast<std::size_t>(testability)];
}

Paragraph reason_of(const Detectability& untestable) {
  const Deficiency& deficiency = untestable.deficiency;
  switch (untestable.testability) {
    case Testability::testable:
      break;
    case Testability::input_missing:
      return missing_inputs(untestable);
    case Testability::input_constant:
      return deficiency.has_gaps ? messages::untestable_gaps() : messages::untestable_constant();
    case Testability::absorbed:
      return messages::untestable_absorbed();
    case Testability::in_the_model:
      return messages::untestable_in_the_model();
    case Testability::other_motion:
      if (deficiency.motion) return messages::untestable_motion(name_of(*deficiency.motion));
      break;
    case Testability::no_clock:
      return messages::untestable_clock();
    case Testability::rows_too_far_apart:
      return messages::untestable_rows_apart(duration_text(deficiency.step_s), duration_text(deficiency.period_s));
  }
  return {};
}

std::vector<std::pair<const Detectability*, std::vector<std::string>>> by_reason(const std::vector<Detectability>& all,
                                                                                 bool (*is_meant)(Testability)) {
  std::vector<std::pair<const Detectability*, std::vector<std::string>>> reasons;
  for (const Detectability& one : all) {
    if (!is_meant(one.testability)) continue;
    auto reason = std::find_if(reasons.begin(), reasons.end(), [&](const auto& known) {
      return known.first->testability == one.testability && known.first->deficiency == one.deficiency;
    });
    if (reason == reasons.end()) reason = reasons.insert(reasons.end(), {&one, {}});
    reason->second.push_back(one.effect->name);
  }
  return reasons;
}

}  // namespace ballbar
