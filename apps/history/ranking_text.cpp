#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "ballbar/history/history.hpp"
#include "ballbar/internal/number_text.hpp"
#include "ballbar/message_catalogue.hpp"
#include "errors/quantity_text.hpp"
#include "history/history_text.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kRows = 12, kExplained = 6;
constexpr std::size_t kNameWidth = 24;

std::size_t count_of(const History& history, Need need) {
  return static_cast<std::size_t>(std::count_if(history.machines.begin(), history.machines.end(),
                                                [&](const MachineHistory& one) { return one.need == need; }));
}

std::string machines_text(std::size_t count) { return several(count, "machine"); }

const ToleranceOutlook* tolerance_with(const MachineHistory& machine, Outlook outlook) {
  const auto found = std::find_if(machine.tolerances.begin(), machine.tolerances.end(),
                                  [&](const ToleranceOutlook& one) { return one.date.outlook == outlook; });
  return found == machine.tolerances.end() ? nullptr : &*found;
}

std::string need_text(const MachineHistory& machine) {
  switch (machine.need) {
    case Need::beyond:
      return "beyond tolerance";
    case Need::expected:
      return "by " + date_text(*tolerance_with(machine, Outlook::expected)->date.at_s);
    case Need::finding:
      return "check";
    case Need::nothing:
      break;
  }
  return "nothing";
}

std::string kind_text(FindingKind kind) {
  std::string text(name_of(kind));
  std::replace(text.begin(), text.end(), '_', ' ');
  return text;
}

std::string size_text(const Finding& finding) {
  const FindingQuantity& quantity = finding.quantities.front();
  const int decimals = decimals_in(quantity.unit);
  const bool to_either_side = finding.kind == FindingKind::season;
  return fmt::format("{} ± {} {}{}",
                     to_either_side ? fixed(quantity.size, decimals) : signed_text(quantity.size, decimals),
                     fixed(quantity.sigma, decimals), quantity.unit, finding.kind == FindingKind::trend ? "/a" : "");
}

std::string q_text(double q) { return q < 1e-3 ? "< 0.001" : fmt::format("{:.3f}", q); }

// The machines that need something; of the rest how many.
std::string table_of(const History& history, std::size_t rows) {
  Table table(ranking_heading());
  std::size_t needing = 0;
  for (const MachineHistory& machine : history.machines) {
    if (machine.need == Need::nothing) continue;
    if (++needing <= rows) table.add(ranking_row(machine));
  }
  if (needing == 0) return "";
  std::string text = '\n' + table.text(table_width());
  if (needing > rows) text += more_text(needing - rows) + '\n';
  return text;
}

std::string what_to_do(const History& history, std::size_t most) {
  std::string text;
  for (const MachineHistory& machine : history.machines) {
    if (machine.need == Need::nothing || most-- == 0) break;
    text += '\n' + wrapped(shortened(machine.name, kNameWidth) + ": " + explanation(machine));
  }
  return text;
}

std::string bars_text(const History& history) {
  std::string text;
  for (const BarChange& change : history.bar_changes) {
    if (!(std::abs(change.size_ppm) > kSignificantSigmas * change.sigma_ppm)) continue;
    text += wrapped(fmt::format("Bar {} against {}: {} ± {} um/m, on {}.", change.to.empty() ? "?" : change.to,
                                change.from.empty() ? "?" : change.from, signed_text(change.size_ppm, 1),
                                fixed(change.sigma_ppm, 1), machines_text(change.machines.size())));
  }
  return text.empty() ? text : '\n' + text;
}

}  // namespace

std::vector<std::string> ranking_heading() {
  return {"machine", "status", "finding", "quantity", "size", "from", "to", "q"};
}

std::vector<std::string> ranking_row(const MachineHistory& machine) {
  const std::string name = shortened(machine.name, kNameWidth);
  if (machine.findings.empty()) {
    const ToleranceOutlook* beyond = tolerance_with(machine, Outlook::beyond);
    if (beyond == nullptr) return {name, need_text(machine), "-", "-", "-", "-", "-", "-"};
    return {name,
            need_text(machine),
            "-",
            fmt::format("{} {}", beyond->name, name_of(beyond->plane)),
            with_sigma(beyond->level, beyond->level_sigma, decimals_in(beyond->unit)) + ' ' + beyond->unit,
            "-",
            "-",
            "-"};
  }
  const Finding& finding = machine.findings.front();
  const FindingQuantity& quantity = finding.quantities.front();
  const std::size_t more = finding.quantities.size() - 1;
  return {name,
          need_text(machine),
          kind_text(finding.kind),
          fmt::format("{} {}{}", quantity.name, name_of(quantity.plane), more == 0 ? "" : fmt::format(" + {}", more)),
          size_text(finding),
          date_text(finding.from_s),
          date_text(finding.to_s),
          q_text(finding.q_value)};
}

std::string explanation(const MachineHistory& machine) {
  Paragraph text = machine.reason;
  for (std::size_t i = 0; i < std::min<std::size_t>(machine.findings.size(), 2); ++i) {
    if (machine.reason_finding != i) text += machine.findings[i].sentence;
    text += machine.findings[i].remedy;
  }
  const std::size_t more = machine.findings.size() - std::min<std::size_t>(machine.findings.size(), 2);
  return text_of(text) + (more > 0 ? fmt::format(" {}: --json prints all.", several(more, "more finding")) : "");
}

Message quantities_tested(const History& history) {
  return messages::quantities_tested(history.judged, history.found,
                                     fmt::format("{:g}", 100.0 * history.false_discovery_rate));
}

std::vector<Paragraph> conclusion(const History& history) {
  const std::size_t all = history.machines.size();
  const std::size_t nothing = count_of(history, Need::nothing);
  const auto untested = static_cast<std::size_t>(std::count_if(
      history.machines.begin(), history.machines.end(), [](const MachineHistory& one) { return one.judged == 0; }));
  if (nothing == all && untested == all) return {messages::machines_untested(all)};
  const Message first =
      nothing < all
          ? messages::machines_with_findings(all - nothing, all, count_of(history, Need::beyond),
                                             count_of(history, Need::expected), count_of(history, Need::finding))
          : messages::machines_unchanged(all,
                                         untested == 0 ? messages::full_stop() : messages::machines_too_few(untested));
  return {first, quantities_tested(history)};
}

std::string ranking_text(const History& history, bool all, const std::vector<std::string>& remarks) {
  std::string text;
  for (const Paragraph& line : conclusion(history)) text += wrapped(line);
  for (const std::string& line : remarks) text += wrapped(line);
  const std::size_t most = history.machines.size();
  text += table_of(history, all ? most : kRows);
  text += what_to_do(history, all ? most : kExplained);
  text += bars_text(history);
  return text;
}

}  // namespace ballbar
