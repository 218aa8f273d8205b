// The ranked errors of a machine on the terminal.
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <ctime>

#include "ballbar/internal/number_text.hpp"
#include "ballbar/units.hpp"
#include "errors/machine_errors_result.hpp"
#include "errors/quantity_text.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kRemedies = 3;
constexpr std::size_t kNoRank = static_cast<std::size_t>(-1);  // behind every rank
constexpr std::size_t kWidest = 100, kWidestDetails = 144;
constexpr std::size_t kErrorRows = 10, kStoredRows = 25, kDifferences = 3, kInseparable = 3;  // without details

std::string plain(double value, int decimals) { return fixed(value, decimals); }

int decimals_of_sigma(double sigma) { return decimals_showing(2, sigma, 4); }

std::string moment(std::int64_t started_s) {
  const std::time_t time = static_cast<std::time_t>(started_s);
  return fmt::format("{:%Y-%m-%d %H:%M}", fmt::gmtime(time));
}

// What the file says of itself, in one or two lines.
std::string head_text(const ErrorsReport& report) {
  std::string text;
  for (const std::string& file : report.files) text += shortened(file, kWidest) + '\n';
  const Recording& first = report.recordings.front();
  std::vector<std::string> parts;
  if (report.b5r) {
    const B5r& b5r = *report.b5r;
    if (!b5r.machine.empty()) parts.push_back("machine " + shortened(b5r.machine, 40));
    if (!b5r.operator_name.empty()) parts.push_back("operator " + shortened(b5r.operator_name, 40));
    if (b5r.started_s) parts.push_back(moment(*b5r.started_s));
    std::string bar = shortened(b5r.ballbar_model, 20);
    if (!b5r.serial_number.empty()) bar += " " + shortened(b5r.serial_number, 20);
    if (!b5r.last_calibrated.empty()) bar += ", calibrated " + shortened(b5r.last_calibrated, 20);
    if (!bar.empty()) parts.push_back(bar);
    if (!b5r.software_title.empty()) {
      parts.push_back(shortened(fmt::format("{} {}", b5r.software_title, b5r.software_version), 40));
    }
  }
  if (!parts.empty()) text += wrapped(fmt::format("{}", fmt::join(parts, "; ")));
  parts.clear();
  std::vector<std::string> runs;
  for (const Recording& recording : report.recordings) {
    runs.push_back(recording.feed_mm_per_min
                       ? fmt::format("{} {:.0f} mm/min", name_of(recording.direction), *recording.feed_mm_per_min)
                       : fmt::format("{} feed not stated", name_of(recording.direction)));
  }
  if (runs.size() > 6) runs = {fmt::format("{} recordings", runs.size())};
  text += wrapped(fmt::format("{}, bar of {:g} mm, {:.0f} deg: {}", name_of(first.plane), first.nominal_length_mm,
                              deg_from_rad(arc_rad(first)), fmt::join(runs, ", ")));
  return text;
}

bool has_stored(const ErrorsReport& report) {
  return report.b5r &&
         std::any_of(report.found.errors.begin(), report.found.errors.end(),
                     [&](const MachineError& error) { return stored_value_of(report, error).has_value(); });
}

// The value by the instrument's software; of an effect its share and rank there. stored: with what the file stores.
std::vector<std::string> instrument_cells(const ErrorsReport& report, const MachineError& error,
                                          const RankedError* ranked, bool stored) {
  const bool is_ranked = ranked != nullptr && ranked->as_instrument;
  std::vector<std::string> cells{error.as_instrument ? plain(*error.as_instrument, error.unit == "ms" ? 2 : 1) : "-",
                                 ranked == nullptr ? ""
                                 : is_ranked       ? fmt::format("{:.0f}", ranked->as_instrument->share_percent)
                                                   : "-",
                                 ranked == nullptr ? ""
                                 : is_ranked       ? fmt::format("{}", ranked->as_instrument->rank)
                                                   : "-"};
  if (!stored) return cells;
  const std::optional<double> value = stored_value_of(report, error);
  const std::optional<bool> same = same_as_stored(report, error);
  cells.emplace_back(!value ? "-" : same.value_or(false) ? "same" : fmt::format("{:g}", *value));
  const std::optional<int> rank = ranked == nullptr ? std::nullopt : stored_rank_of(report, *ranked);
  const bool same_rank = rank && is_ranked && *rank == static_cast<int>(ranked->as_instrument->rank);
  cells.emplace_back(ranked == nullptr ? "" : same_rank ? "same" : rank ? fmt::format("{}", *rank) : "-");
  return cells;
}

// details: every row, and the columns of the instrument.
std::string table_text(const ErrorsReport& report, bool details) {
  std::vector<std::string> heading{"error", "value", "unit", "rank", "gain um", "IC um"};
  const bool stored = has_stored(report);
  if (details) heading.insert(heading.end(), {"instrument", "share %", "instrument rank"});
  if (details && stored) heading.insert(heading.end(), {"stored", "stored rank"});
  heading.emplace_back("confirmed");
  Table table(heading);
  std::size_t rows = 0, hidden = 0;
  const auto cell_of_gain = [](double gain_um, double sigma_um) {
    return std::isnan(sigma_um) ? plain(gain_um, 1) : with_sigma(gain_um, sigma_um, decimals_of_sigma(sigma_um));
  };
  // A group, and below it the value that each member has alone.
  const auto add_group = [&](const ErrorGroup& group) {
    rows += 1 + group.alone.size();
    const int decimals = decimals_of_sigma(group.sigma_um);
    table.add({name_of(group), with_sigma(group.individual_circularity_um, group.sigma_um, decimals), "um",
               group.rank ? fmt::format("{}", *group.rank) : "none", cell_of_gain(group.gain_um, group.gain_sigma_um),
               plain(group.individual_circularity_um, 2)});
    for (const MachineError& alone : group.alone) {
      table.add(
          {"  only " + alone.name, with_sigma(alone.value, alone.sigma, decimals_of_sigma(alone.sigma)), alone.unit});
    }
  };
  const auto add = [&](const MachineError& error, const RankedError* ranked, bool first) {
    if (!error.determined && !details) return;  // in one line below
    if (++rows > kErrorRows && !details) {
      ++hidden;
      return;
    }
    const int decimals = decimals_of_sigma(error.sigma);
    const bool marked = ranked != nullptr && report.options.in_the_model.contains(ranked->effect->name);
    std::vector<std::string> row{(marked ? "+ " : "") + error.name,
                                 error.determined ? with_sigma(error.value, error.sigma, decimals) : "not determined",
                                 error.unit};
    const RankedError* const of_effect = first ? ranked : nullptr;
    const auto once = [&](const std::string& text) { row.push_back(of_effect == nullptr ? "" : text); };
    once(ranked == nullptr || !ranked->significant ? "-" : ranked->rank ? fmt::format("{}", *ranked->rank) : "none");
    once(ranked == nullptr || !ranked->significant ? "" : cell_of_gain(ranked->gain_um, ranked->gain_sigma_um));
    once(ranked == nullptr ? "" : plain(ranked->individual_circularity_um, 2));
    if (details) {
      const std::vector<std::string> instrument = instrument_cells(report, error, of_effect, stored);
      row.insert(row.end(), instrument.begin(), instrument.end());
    }
    once(ranked == nullptr || !ranked->significant || !ranked->predicts_other_run ? "-"
         : *ranked->predicts_other_run                                            ? "yes"
                                                                                  : "no");
    table.add(row);
  };
  const std::vector<ErrorRow> all = error_rows(report);
  const Effect* before = nullptr;
  std::size_t next = 0;  // group
  const auto add_groups_before = [&](std::size_t rank) {
    const std::vector<ErrorGroup>& groups = report.found.groups;
    while (next < groups.size() && groups[next].rank.value_or(kNoRank) <= rank) add_group(groups[next++]);
  };
  for (const ErrorRow& one : all) {
    const bool has_rank = one.ranked && one.ranked->rank;
    add_groups_before(has_rank ? *one.ranked->rank : kNoRank);
    if (one.ranked && one.ranked->group && !details) continue;  // shown with its group
    const Effect* const effect = one.ranked ? one.ranked->effect : nullptr;
    add(one.error, one.ranked ? &*one.ranked : nullptr, effect == nullptr || effect != before);
    before = effect;
  }
  std::string text = table.text(table_width(details ? kWidestDetails : kWidest));
  if (hidden > 0) text += more_text(hidden) + '\n';
  return text;
}

// Those whose sigma alone moves the readings by more than the circularity.
std::string undetermined_text(const ErrorsReport& report, bool details) {
  std::vector<std::string> names;
  for (const ErrorRow& row : error_rows(report)) {
    const bool is_of_group = row.ranked && row.ranked->group;
    if (!row.error.determined && !is_of_group) names.push_back(row.error.name);
  }
  if (names.empty() || details) return "";
  return wrapped(fmt::format("Not determined by these readings, ± above the circularity: {}.", fmt::join(names, ", ")));
}

// Combinations that look alike; some of many.
std::string inseparable_text(const ErrorsReport& report, bool details) {
  const std::vector<std::string>& all = report.found.undetermined;
  if (all.empty()) return "";
  const std::size_t shown = details ? all.size() : std::min(all.size(), kInseparable);
  const std::string more =
      shown < all.size() ? fmt::format("; {} more combinations, --details names them", all.size() - shown) : "";
  return wrapped(fmt::format("Not separable by these readings: {}{}.",
                             fmt::join(all.begin(), all.begin() + static_cast<long>(shown), "; "), more));
}

// What the columns shown hold.
std::string legend_text(const ErrorsReport& report, bool details) {
  const char* const instrument = details ? "Instrument: as the instrument's software would report it. " : "";
  const char* const stored =
      details && has_stored(report) ? "Stored: in the file; same: equal to the instrument's. " : "";
  return fmt::format(
      "Gain: reduction of the circularity by correcting this error alone; gains do not add up. Rank: by gain; "
      "-: not significant, none: no gain. IC: circularity of this error alone. ± is one sigma. {}{}{}Confirmed: found "
      "in one direction, the error lowers the residual of the other.",
      report.found.groups.empty() ? "" : "Only: the value if no other member of the group is there. ", instrument,
      stored);
}

std::string prior_text(const ErrorsReport& report) {
  if (!report.options.prior) return "No prior: curves and ranks from the readings alone.\n";
  std::vector<std::string> texts;
  texts.reserve(report.found.prior.size());
  for (const PriorOfError& prior : report.found.prior) {
    texts.push_back(fmt::format("{} 0 ± {} {}", prior.name, plain(prior.sigma, 2), prior.unit));
  }
  if (texts.empty()) return "";
  return wrapped(fmt::format("Prior in the instrument's column: {}.", fmt::join(texts, ", ")));
}

// Below an empty line.
void print_tolerances(const ToleranceCheck& check) {
  const std::vector<std::string> texts = texts_of(tolerance_lines(check));
  if (!texts.empty()) fmt::print("\n");
  for (const std::string& text : texts) fmt::print("{}", wrapped(one_line(text)));
}

void print_group(const ErrorsReport& report, bool details) {
  const MachineErrors& found = report.found;
  fmt::print("{}\n{}", head_text(report), wrapped(conclusion(report)));
  print_tolerances(check_of(report));
  if (const std::optional<FeedForecast> forecast = forecast_of(report)) {
    fmt::print("{}", wrapped(forecast_text(*forecast)));
  }
  const RankedError* const first = first_of(found);
  if (first != nullptr && (first->rank == std::size_t{1} || found.groups.empty()))
    fmt::print("\nballbar effects {}\n", first->effect->name);
  fmt::print("\n{}{}", table_text(report, details), undetermined_text(report, details));
  fmt::print("{}", wrapped(legend_text(report, details)));
  const std::vector<std::string> differences = difference_texts(report);
  for (std::size_t i = 0; i < differences.size() && (details || i < kDifferences); ++i) {
    fmt::print("{}", wrapped(differences[i]));
  }
  std::size_t shown = 0;
  for (const RankedError& ranked : found.ranked) {
    if (!ranked.significant || shown == kRemedies) continue;
    ++shown;
    fmt::print(
        "{}{}", shown == 1 ? "\n" : "",
        wrapped(fmt::format("{}. {}: {}", shown, plain_name(ranked.effect->name, report.recordings.front().plane),
                            ranked.effect->explanation.remedy)));
  }
  fmt::print("\n{}", wrapped(left_sentences(report)));
  fmt::print("{}", inseparable_text(report, details));
  if (found.next && found.groups.empty()) fmt::print("{}\n", text_of(message_of(*found.next)));
  if (details) fmt::print("{}", prior_text(report));
}

}  // namespace

void print_text(const ErrorsReports& reports, bool details) {
  bool first = true;
  for (const ErrorsReport& group : reports.groups) {
    if (!first) fmt::print("\n");
    first = false;
    print_group(group, details);
  }
  for (const StoredAlone& alone : reports.results_alone) {
    fmt::print("{}{}\nNo readings in this file. Results stored by the instrument software:\n\n", first ? "" : "\n",
               alone.of.file);
    first = false;
    Table table({"stored", "value", "unit", "run or analysis"});
    for (const StoredValue& one : alone.of.stored)
      table.add({one_line(one.name), fmt::format("{:g}", one.value), one.unit, one_line(one.of)});
    if (!details) table.shorten(kStoredRows);
    fmt::print("{}", table.text(table_width(kWidest)));
    print_tolerances(alone.check);
  }
  if (!reports.skipped.empty()) fmt::print("\n{}", left_out_text(reports.skipped));
}

}  // namespace ballbar
