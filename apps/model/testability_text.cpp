#include "model/testability_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "ballbar/internal/number_text.hpp"

namespace ballbar {
namespace {

std::string missing_inputs_text(const Deficiency& deficiency) {
  std::vector<std::string> texts;
  texts.reserve(deficiency.missing_inputs.size());
  for (const MissingInput& input : deficiency.missing_inputs) {
    texts.push_back(fmt::format("{} ({})", input.role,
                                input.units.empty() ? "any unit" : fmt::format("{}", fmt::join(input.units, " or "))));
  }
  if (!texts.empty()) return fmt::format("no column for {}", fmt::join(texts, ", "));
  return deficiency.none_accepted.empty() ? "there are too few columns of the kind" : deficiency.none_accepted;
}

}  // namespace

std::string_view name_of(Testability testability) {
  constexpr std::string_view kNames[] = {"testable",     "input missing", "input constant", "absorbed by the model",
                                         "in the model", "other motion",  "no clock",       "rows too far apart"};
  return kNames[static_cast<std::size_t>(testability)];
}

std::string reason_text(const Detectability& untestable) {
  const Deficiency& deficiency = untestable.deficiency;
  switch (untestable.testability) {
    case Testability::testable:
      break;
    case Testability::input_missing:
      return missing_inputs_text(deficiency);
    case Testability::input_constant:
      return deficiency.has_gaps ? "its input has gaps" : "its input does not change";
    case Testability::absorbed:
      return "what it adds is made by the model already";
    case Testability::in_the_model:
      return "it is in the model";
    case Testability::other_motion:
      return deficiency.motion ? fmt::format("it is not one of circles driven by {}", name_of(*deficiency.motion)) : "";
    case Testability::no_clock:
      return "it needs a clock, and the rows are numbered";
    case Testability::rows_too_far_apart:
      return fmt::format("rows {} apart do not show a period of {}", duration_text(deficiency.step_s),
                         duration_text(deficiency.period_s));
  }
  return "";
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
