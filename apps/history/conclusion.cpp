#include "history/conclusion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "history/quantity_text.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar {
namespace {

constexpr double kByChance = 0.0093;  // beyond 2.6 sigmas

bool is_a_date(const QuantityHistory& quantity, Outlook outlook) {
  return quantity.date && quantity.date->outlook == outlook;
}

struct Told {
  const GroupHistory* group = nullptr;
  const QuantityHistory* quantity = nullptr;
};

// Every quantity of the machine for which `tells` holds.
template <class Tells>
std::vector<Told> those(const MachineHistory& machine, const Tells& tells) {
  std::vector<Told> found;
  for (const GroupHistory& group : machine.groups) {
    for (const QuantityHistory& quantity : group.quantities) {
      if (tells(quantity)) found.push_back({&group, &quantity});
    }
  }
  return found;
}

// At most so many lines, then how many more.
template <class Line>
std::string lines_of(const std::vector<Told>& found, const Line& line) {
  constexpr std::size_t kMost = 6;
  std::string text;
  for (std::size_t i = 0; i < std::min(kMost, found.size()); ++i) {
    text += fmt::format("  {}: {}\n", group_text(found[i].group->group), line(*found[i].quantity));
  }
  if (found.size() > kMost) text += fmt::format("  and {} more, marked below\n", found.size() - kMost);
  return text;
}

double sigmas_of(const QuantityHistory& quantity) {
  return std::abs(quantity.change->value) / std::max(quantity.change->sigma, 1e-12);
}

std::string changed_lines(const MachineHistory& machine) {
  auto changed = those(machine, [](const QuantityHistory& one) { return one.change && one.change->significant; });
  std::stable_sort(changed.begin(), changed.end(), [](const Told& left, const Told& right) {
    return sigmas_of(*left.quantity) > sigmas_of(*right.quantity);
  });
  if (changed.empty()) {
    const auto any = those(machine, [](const QuantityHistory& one) { return one.change.has_value(); });
    if (any.empty()) return "Nothing to compare: no test was repeated.\n";
    if (machine.changes == 0) return "No change can be judged: of the last two tests one or both are stored values.\n";
    return fmt::format("Nothing changed since the test before by more than {:g} of both sigmas.\n", kSignificantSigmas);
  }
  return fmt::format("Changed since the test before, by more than {:g} of both sigmas:\n", kSignificantSigmas) +
         lines_of(changed, [](const QuantityHistory& one) {
           const int decimals = decimals_of(one.unit);
           return fmt::format("{}, {} ± {} since {}", value_text(one), signed_text(one.change->value, decimals),
                              fixed(one.change->sigma, decimals), date_text(static_cast<double>(one.change->since_s)));
         });
}

std::string tolerance_lines(const MachineHistory& machine) {
  const auto beyond = those(machine, [](const QuantityHistory& one) { return is_a_date(one, Outlook::beyond); });
  auto expected = those(machine, [](const QuantityHistory& one) { return is_a_date(one, Outlook::expected); });
  std::stable_sort(expected.begin(), expected.end(), [](const Told& left, const Told& right) {
    return *left.quantity->date->at_s < *right.quantity->date->at_s;
  });
  std::string text;
  if (!beyond.empty()) {
    text += "Beyond its tolerance:\n" + lines_of(beyond, [](const QuantityHistory& one) {
              return fmt::format("{}, tolerance {}", value_text(one), tolerance_text(one));
            });
  }
  if (!expected.empty()) {
    text += "Meets its tolerance if the trend goes on (95 % interval):\n" +
            lines_of(expected, [](const QuantityHistory& one) {
              return fmt::format("{}, tolerance {}: {}", one.name, tolerance_text(one), expected_text(*one.date));
            });
  }
  return text;
}

std::string trend_lines(const MachineHistory& machine) {
  if (machine.trends == 0) {
    return wrapped(fmt::format("No trend to tell: it takes {} tests of a group over more than a week.", kTestsOfTrend));
  }
  const auto trends = those(machine, [](const QuantityHistory& one) {
    return one.trend && one.trend->significant && !is_a_date(one, Outlook::expected);
  });
  if (trends.empty()) return "";
  return "Trend:\n" + lines_of(trends, [](const QuantityHistory& one) {
           return fmt::format("{} {} {} a year", one.name,
                              with_sigma(one.trend->rate_per_year, one.trend->sigma_per_year, decimals_of(one.unit)),
                              one.unit);
         });
}

}  // namespace

std::string conclusion(const MachineHistory& machine) {
  std::string text = changed_lines(machine) + tolerance_lines(machine) + trend_lines(machine);
  const std::size_t judged = machine.changes + machine.trends;
  if (judged > 0) {
    text += wrapped(fmt::format("{} and {} were judged; {:.1f} of them exceed {:g} sigmas by chance.",
                                several(machine.changes, "change"), several(machine.trends, "trend"),
                                kByChance * static_cast<double>(judged), kSignificantSigmas));
  }
  return text;
}

}  // namespace ballbar
