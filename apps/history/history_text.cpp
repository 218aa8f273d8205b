#include "history/history_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>

#include "ballbar/history/history.hpp"
#include "ballbar/internal/number_text.hpp"
#include "ballbar/message_catalogue.hpp"
#include "errors/quantity_text.hpp"
#include "errors/test_table.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar {
namespace {

constexpr std::array kColumns{"quantity", "unit", "last", "change", "sigmas", "per year", "tolerance", "met"};

// Cells of a table; "-" where there is nothing to state. "± 5":
std::string tolerance_text(const Tolerance& tolerance) {
  const auto& [name, lower, upper] = tolerance;
  if (lower && upper && *lower == -*upper) return fmt::format("± {:g}", *upper);
  if (lower && upper) return fmt::format("{:g} to {:g}", *lower, *upper);
  return lower ? fmt::format("from {:g}", *lower) : fmt::format("to {:g}", upper.value_or(0.0));
}

// "2027-03-01 (2026-11-05 to 2027-10-20)"
std::string outlook_text(const ToleranceOutlook& one) {
  const ToleranceDate& date = one.date;
  switch (date.outlook) {
    case Outlook::beyond:
      return "beyond it";
    case Outlook::no_trend:
      return one.last_alone ? "the last test alone beyond it" : "no trend";
    case Outlook::away:
      return fmt::format("not within {:g} years", kForecast_years);
    case Outlook::expected:
      return fmt::format("{} ({} to {})", date_text(*date.at_s), date_text(*date.earliest_s),
                         date.latest_s ? date_text(*date.latest_s) : "open");
  }
  return "-";
}

// Whether its row is shown without --details.
bool has_something_to_state(const MachineHistory& machine, std::size_t place, const std::string& squareness) {
  const QuantityHistory& series = machine.series[place];
  if (series.name == "circularity") return true;
  if (outlook_for(machine, place) != nullptr) return true;
  if (is_found(machine, place, true) || is_found(machine, place, false)) return true;
  const bool is_scale_of_axis = series.name.starts_with("scale_") && series.name.size() == 7;  // scale_x
  // The table of squareness and scales has these.
  if (series.name == squareness || series.name == "global_scale" || is_scale_of_axis) return false;
  if (series.name == "residual_rms") return false;
  return series.significant || !std::isfinite(series.sigma.back());
}

std::string first_and_last(const std::vector<MachineTest>& tests) {
  const std::string dates = dates_text(tests);
  return dates.empty() ? "without a date" : dates;
}

// Rows without the columns in which no row has anything.
std::string table_of_rows(const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> columns;
  std::vector<std::string> heading;
  for (std::size_t k = 0; k < kColumns.size(); ++k) {
    const bool is_empty = std::all_of(rows.begin(), rows.end(), [&](const auto& row) { return row[k] == "-"; });
    if (is_empty) continue;
    columns.push_back(k);
    heading.emplace_back(kColumns[k]);
  }
  Table table(heading);
  for (const std::vector<std::string>& row : rows) {
    std::vector<std::string> cells;
    cells.reserve(columns.size());
    for (const std::size_t k : columns) cells.push_back(row[k]);
    table.add(cells);
  }
  return table.text();
}

// `left_out`: to which the rows without a finding are added.
std::string group_text(const TestFiles& files, const MachineHistory& machine, std::size_t group, bool all,
                       std::size_t& left_out) {
  const std::vector<std::size_t>& places = machine.groups[group].tests;
  std::vector<MachineTest> tests;
  tests.reserve(places.size());
  for (const std::size_t i : places) tests.push_back(files.tests[i]);
  const auto stored = std::count_if(tests.begin(), tests.end(), [](const MachineTest& one) { return one.stored; });
  std::string text =
      fmt::format("\n{}; {}, {}{}\n", group_text(machine.groups[group]), several(places.size(), "test"),
                  first_and_last(tests), stored == 0 ? "" : fmt::format(", {} of stored values", stored));
  const std::optional<MachineError>& out_of_square = tests.back().squareness;
  const std::string squareness = out_of_square ? out_of_square->name : "";
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < machine.series.size(); ++i) {
    if (machine.series[i].group != group) continue;
    if (all || has_something_to_state(machine, i, squareness)) {
      rows.push_back(quantity_row(machine, i));
    } else {
      ++left_out;
    }
  }
  if (!rows.empty()) text += table_of_rows(rows);
  return text;
}

// A quantity of one machine in each of its groups.
struct StoredRow {
  std::string name, unit;
  std::size_t rank =
      std::numeric_limits<std::size_t>::max();  // 0: circularity; else as the instrument's software ranks
  std::vector<std::string> last;                // of each group
};

std::vector<StoredRow> stored_rows(const TestFiles& files, const MachineHistory& machine) {
  std::vector<StoredRow> rows;
  for (const QuantityHistory& one : machine.series) {
    auto row = std::find_if(rows.begin(), rows.end(), [&](const StoredRow& known) { return known.name == one.name; });
    if (row == rows.end()) {
      rows.push_back({one.name, one.unit});
      row = std::prev(rows.end());
      row->last.resize(machine.groups.size(), "-");
    }
    row->last[one.group] = fixed(one.last, decimals_in(one.unit));
    if (one.name == "circularity") row->rank = 0;
    for (const TestQuantity& quantity : files.tests[one.tests.back()].quantities) {
      if (quantity.name == one.name && quantity.rank) row->rank = std::min(row->rank, *quantity.rank);
    }
  }
  std::stable_sort(rows.begin(), rows.end(), [](const StoredRow& a, const StoredRow& b) { return a.rank < b.rank; });
  return rows;
}

// Of several machines with stored values alone: one table of the last values for each.
std::string stored_machines_text(const TestFiles& files, const History& history, bool all) {
  constexpr std::size_t kMachines = 6, kRows = 8;
  std::string text;
  for (std::size_t i = 0; i < history.machines.size() && (all || i < kMachines); ++i) {
    const MachineHistory& machine = history.machines[i];
    text += fmt::format("\n{}: {}, stored values of the last\n",
                        machine.name.empty() ? "no name" : shortened(machine.name, 80), several(machine.tests, "test"));
    std::vector<std::string> heading{"quantity", "unit"};
    for (const TestGroup& group : machine.groups) heading.push_back(group_text(group));
    Table table(heading);
    const std::vector<StoredRow> rows = stored_rows(files, machine);
    const std::size_t shown = all ? rows.size() : std::min(kRows, rows.size());
    for (std::size_t k = 0; k < shown; ++k) {
      std::vector<std::string> cells{rows[k].name, rows[k].unit};
      cells.insert(cells.end(), rows[k].last.begin(), rows[k].last.end());
      table.add(cells);
    }
    text += table.text(table_width(100));
    if (shown < rows.size()) text += more_text(rows.size() - shown) + '\n';
  }
  const std::size_t machines = history.machines.size();
  return all || machines <= kMachines ? text : text + '\n' + more_text(machines - kMachines, "machine") + '\n';
}

std::string machine_text(const TestFiles& files, const History& history, const MachineGeometry& geometry, bool all) {
  const MachineHistory& machine = history.machines.front();
  std::string text = fmt::format("{}{}, {}, {}\n\n", machine.name.empty() ? "" : shortened(machine.name, 80) + ": ",
                                 several(files.tests.size(), "test"), several(machine.groups.size(), "group"),
                                 first_and_last(files.tests));
  for (const Paragraph& line : machine_conclusion(history)) text += wrapped(line);
  std::size_t left_out = 0;
  for (std::size_t group = 0; group < machine.groups.size(); ++group) {
    text += group_text(files, machine, group, all, left_out);
  }
  if (left_out > 0) text += '\n' + more_text(left_out) + '\n';
  text += geometry_text(files, geometry, all);
  if (!all) return text;
  return text + '\n' +
         wrapped(
             "± is one sigma of the fit; for a trend it includes the scatter of the tests. *: significant. ?: "
             "stored values have no sigma. Change: since the previous value, also in sigmas.");
}

// Names of some, then how many more.
template <class Names>
std::string list_text(const Names& names) {
  constexpr std::size_t kMost = 10;
  std::string text;
  for (std::size_t i = 0; i < std::min(kMost, names.size()); ++i) text += "  " + names[i] + '\n';
  if (names.size() > kMost) text += fmt::format("  ... {} more; --json prints all\n", names.size() - kMost);
  return text;
}

std::string axis_name(int axis) { return std::string(1, "XYZ"[axis]); }

std::string date_of(const MachineTest& test) {
  return test.started_s ? date_text(static_cast<double>(*test.started_s)) : "no date";
}

std::string dates_of(const TestFiles& files, const std::vector<std::size_t>& places) {
  std::vector<std::string> dates;
  for (const std::size_t i : places) {
    const std::string date = date_of(files.tests[i]);
    if (std::find(dates.begin(), dates.end(), date) == dates.end()) dates.push_back(date);
  }
  return fmt::format("{}", fmt::join(dates, ", "));
}

// Of one plane its name; empty: several tell.
std::string plane_of(const ScaleAgreement& agreement) {
  std::string_view plane;
  for (const ScalePull& pull : agreement.pulls) {
    if (!plane.empty() && plane != name_of(pull.plane)) return "";
    plane = name_of(pull.plane);
  }
  return std::string(plane);
}

Message chi2_of(const ScaleAgreement& agreement) {
  return messages::chi2(fmt::format("{:.1f}", agreement.chi2), agreement.degrees, p_equals_text(agreement.p_value));
}

// How the tests differ of which the axes that several planes tell say different things.
std::vector<Paragraph> disagreements_of(const MachineGeometry& geometry) {
  const ScaleAgreement& agreement = geometry.agreement;
  const std::string of_plane = plane_of(agreement);
  std::vector<Paragraph> sentences{of_plane.empty() ? messages::planes_disagree(chi2_of(agreement))
                                                    : messages::tests_disagree(of_plane, chi2_of(agreement))};
  sentences.front() += messages::scatter_added(fmt::format("{:.1f}", agreement.scatter_ppm));
  for (const AxisScale& scale : geometry.scales) {
    if (scale.planes < 2) continue;
    std::vector<MessageValue> tests;
    for (const ScalePull& pull : agreement.pulls) {
      if (pull.axis != scale.axis || !std::isfinite(pull.pull)) continue;
      tests.emplace_back(fmt::format("{} {} um/m ({}{:.1f} sigma)", name_of(pull.plane),
                                     with_sigma(pull.value_ppm, pull.sigma_ppm, 1), pull.pull < 0.0 ? "" : "+",
                                     pull.pull));
    }
    if (!tests.empty()) sentences.emplace_back(messages::scale_by_planes(axis_name(scale.axis), listed(tests)));
  }
  return sentences;
}

// all: what is usual as well.
std::vector<Paragraph> sentences_of(const MachineGeometry& geometry, bool all) {
  std::vector<Paragraph> sentences;
  for (const PlaneSquareness& plane : geometry.squareness) {
    if (plane.p_value < 0.01)
      sentences.emplace_back(messages::squareness_disagrees(name_of(plane.plane), p_equals_text(plane.p_value)));
  }
  const ScaleAgreement& agreement = geometry.agreement;
  if (agreement.degrees > 0 && agreement.scatter_ppm == 0.0) {
    if (!all) return sentences;
    const std::string plane = plane_of(agreement);
    sentences.emplace_back(plane.empty() ? messages::planes_agree(chi2_of(agreement))
                                         : messages::tests_agree(plane, chi2_of(agreement)));
  } else if (agreement.degrees > 0) {
    for (Paragraph& text : disagreements_of(geometry)) sentences.push_back(std::move(text));
  }
  if (all && !geometry.scales.empty()) sentences.emplace_back(messages::scales_by_the_bar());
  return sentences;
}

}  // namespace

std::string group_text(const TestGroup& group) {
  std::string text = fmt::format("{}, {:g} mm", name_of(group.plane), group.nominal_length_mm);
  if (group.feed_mm_per_min) text += fmt::format(", {:.0f} mm/min", *group.feed_mm_per_min);
  text += fmt::format(", {:.0f} deg", group.arc_deg);
  if (group.arc_deg < 359.0) text += fmt::format(" from {:.0f}", group.start_deg);
  return text;
}

const ToleranceOutlook* outlook_for(const MachineHistory& machine, std::size_t series) {
  const auto found = std::find_if(machine.tolerances.begin(), machine.tolerances.end(),
                                  [&](const ToleranceOutlook& one) { return one.series == series; });
  return found == machine.tolerances.end() ? nullptr : &*found;
}

bool is_found(const MachineHistory& machine, std::size_t series, bool lasting) {
  return std::any_of(machine.findings.begin(), machine.findings.end(), [&](const Finding& finding) {
    if (finding.kind == FindingKind::season || (finding.kind == FindingKind::trend) != lasting) return false;
    return std::any_of(finding.quantities.begin(), finding.quantities.end(),
                       [&](const FindingQuantity& one) { return one.series == series; });
  });
}

std::vector<Paragraph> machine_conclusion(const History& history) {
  const MachineHistory& machine = history.machines.front();
  std::vector<Paragraph> lines{machine.reason};
  for (std::size_t i = 0; i < machine.findings.size(); ++i) {
    const Finding& finding = machine.findings[i];
    lines.push_back(machine.reason_finding == i ? Paragraph() : finding.sentence);
    lines.back() += finding.remedy;
  }
  lines.emplace_back(quantities_tested(history));
  return lines;
}

std::vector<std::string> quantity_row(const MachineHistory& machine, std::size_t series) {
  const QuantityHistory& one = machine.series[series];
  const int decimals = decimals_in(one.unit);
  std::vector<std::string> row{one.name, one.unit, with_sigma(one.last, one.last_sigma, decimals)};
  if (one.value.size() > 1) {
    const std::size_t before = one.value.size() - 2;
    const double change = one.last - one.value[before];
    const double sigmas = std::abs(change) / std::hypot(one.last_sigma, one.sigma[before]);
    row.push_back(signed_text(change, decimals) + (is_found(machine, series, false) ? " *" : ""));
    row.push_back(std::isfinite(sigmas) ? fmt::format("{:.1f}", sigmas) : "-");
  } else {
    row.insert(row.end(), {"-", "-"});
  }
  row.push_back(one.trend ? with_sigma(one.trend->rate_per_year, one.trend->sigma_per_year, decimals) +
                                (is_found(machine, series, true) ? " *" : "")
                          : "-");
  const ToleranceOutlook* const outlook = outlook_for(machine, series);
  row.push_back(outlook == nullptr ? "-" : tolerance_text(outlook->tolerance));
  row.push_back(outlook == nullptr ? "-" : outlook_text(*outlook));
  return row;
}

std::string history_text(const FoundHistory& found, bool all) {
  const auto& [files, history, geometry] = found;
  std::string text = geometry ? machine_text(files, history, *geometry, all) : ranking_text(history, all);
  if (history.machines.size() > 1 && are_stored(files.tests)) text += stored_machines_text(files, history, all);
  if (!history.without_date.empty()) {
    text += "\nNo date, so not part of any change or trend:\n" + list_text(history.without_date);
  }
  std::vector<std::string> sentences;
  sentences.reserve(files.skipped.size());
  for (const SkippedTest& file : files.skipped) sentences.push_back(file.sentence);
  if (!sentences.empty()) {
    text += fmt::format("\nSkipped, {}:\n", several(sentences.size(), "file")) + list_text(sentences);
  }
  return text;
}

GeometryTexts geometry_texts(const TestFiles& files, const MachineGeometry& geometry, bool all) {
  GeometryTexts texts;
  if (geometry.squareness.empty() && geometry.scales.empty()) return texts;
  texts.heading = fmt::format(
      "Squareness and scales, {}{}",
      geometry.within_a_day ? "tests of " : "the newest test of each plane: ", dates_of(files, geometry.tests));
  for (const PlaneSquareness& plane : geometry.squareness) {
    texts.rows.push_back({fmt::format("squareness {}", name_of(plane.plane)), with_sigma(plane.value, plane.sigma, 1),
                          dates_of(files, plane.tests)});
  }
  for (const AxisScale& scale : geometry.scales) {
    std::string planes;
    for (const ScalePull& pull : geometry.agreement.pulls) {
      const std::string plane(name_of(pull.plane));
      if (pull.axis != scale.axis || planes.find(plane) != std::string::npos) continue;
      planes += (planes.empty() ? "" : ", ") + plane;
    }
    texts.rows.push_back(
        {fmt::format("scale {}", axis_name(scale.axis)), with_sigma(scale.value_ppm, scale.sigma_ppm, 1), planes});
  }
  texts.sentences = sentences_of(geometry, all);
  return texts;
}

std::string geometry_text(const TestFiles& files, const MachineGeometry& geometry, bool all) {
  const GeometryTexts texts = geometry_texts(files, geometry, all);
  if (texts.rows.empty()) return "";
  Table table({"", "um/m", "from"});
  for (const std::vector<std::string>& row : texts.rows) table.add(row);
  std::string text = '\n' + texts.heading + '\n' + table.text();
  for (const Paragraph& sentence : texts.sentences) text += wrapped(sentence);
  return text;
}

}  // namespace ballbar
