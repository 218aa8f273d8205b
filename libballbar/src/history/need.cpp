#include "history/need.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>

#include "ballbar/message_catalogue.hpp"
#include "history/event_texts.hpp"

namespace ballbar {
namespace {

// How far beyond, over the tolerance's own size.
double excess_of(const ToleranceOutlook& one) {
  const double limit = one.date.limit.value_or(0.0);
  return std::abs(one.level - limit) / std::max(std::abs(limit), 1e-9);
}

const ToleranceOutlook* farthest_beyond(const MachineHistory& machine) {
  const ToleranceOutlook* worst = nullptr;
  for (const ToleranceOutlook& one : machine.tolerances) {
    if (one.date.outlook != Outlook::beyond) continue;
    if (worst == nullptr || excess_of(one) > excess_of(*worst)) worst = &one;
  }
  return worst;
}

const ToleranceOutlook* soonest(const MachineHistory& machine) {
  const ToleranceOutlook* first = nullptr;
  for (const ToleranceOutlook& one : machine.tolerances) {
    if (one.date.outlook != Outlook::expected) continue;
    if (first == nullptr || *one.date.at_s < *first->date.at_s) first = &one;
  }
  return first;
}

bool is_of_the_machine(const Finding& finding) {
  return finding.kind != FindingKind::season && finding.kind != FindingKind::instrument;
}

// By which machines of one need are sorted: less is sooner.
struct Urgency {
  int of_machine = 0;  // 0: a finding that is
  double number = 0.0;
};

Urgency urgency_of(const MachineHistory& machine) {
  switch (machine.need) {
    case Need::beyond:
      return {0, -excess_of(*farthest_beyond(machine))};
    case Need::expected:
      return {0, *soonest(machine)->date.at_s};
    case Need::finding: {
      const auto own = std::find_if(machine.findings.begin(), machine.findings.end(), is_of_the_machine);
      const bool any = own != machine.findings.end();
      return {any ? 0 : 1, any ? own->p_value : machine.findings.front().p_value};
    }
    case Need::nothing:
      break;
  }
  return {};
}

}  // namespace

std::string_view name_of(Need need) {
  constexpr std::array<std::string_view, 4> kNames{"beyond", "expected", "finding", "nothing"};
  return kNames[static_cast<std::size_t>(need)];
}

void say_need(MachineHistory& machine) {
  if (const ToleranceOutlook* worst = farthest_beyond(machine)) {
    machine.need = Need::beyond;
    machine.reason = messages::need_beyond(quantity_of(worst->name, worst->plane),
                                           amount_text(worst->level, worst->level_sigma, worst->unit),
                                           fmt::format("{:g}", *worst->date.limit), worst->unit);
    return;
  }
  if (const ToleranceOutlook* first = soonest(machine)) {
    machine.need = Need::expected;
    const MessageValue latest =
        first->date.latest_s ? MessageValue(day_text(*first->date.latest_s)) : MessageValue(messages::open());
    machine.reason =
        messages::need_expected(quantity_of(first->name, first->plane), fmt::format("{:g}", *first->date.limit),
                                first->unit, day_text(*first->date.at_s), day_text(*first->date.earliest_s), latest);
    return;
  }
  if (!machine.findings.empty()) {
    const auto own = std::find_if(machine.findings.begin(), machine.findings.end(), is_of_the_machine);
    machine.need = Need::finding;
    machine.reason_finding =
        own != machine.findings.end() ? static_cast<std::size_t>(own - machine.findings.begin()) : std::size_t{0};
    machine.reason = machine.findings[*machine.reason_finding].sentence;
    return;
  }
  machine.need = Need::nothing;
  for (const ToleranceOutlook& one : machine.tolerances) {
    if (!one.last_alone) continue;
    machine.reason = messages::need_last_alone(quantity_of(one.name, one.plane));
    return;
  }
  machine.reason = machine.judged == 0 ? messages::need_too_few_tests() : messages::need_nothing();
}

void rank(std::vector<MachineHistory>& machines) {
  std::stable_sort(machines.begin(), machines.end(), [](const MachineHistory& left, const MachineHistory& right) {
    const Urgency one = urgency_of(left), other = urgency_of(right);
    return std::tie(left.need, one.of_machine, one.number, left.name) <
           std::tie(right.need, other.of_machine, other.number, right.name);
  });
}

}  // namespace ballbar
