// `ballbar compare A B`: how well two drift series agree; a session: its ballbar against its five probes.
#include "ballbar/drift/compare.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "ballbar/error.hpp"
#include "ballbar/formats/series/series_csv.hpp"
#include "ballbar/formats/sessions/drift_data.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "ballbar/units.hpp"
#include "commands.hpp"
#include "measure/compared_drifts.hpp"
#include "measure/comparison_result.hpp"
#include "page/report_page.hpp"
#include "terminal/caller.hpp"
#include "terminal/command_line.hpp"
#include "terminal/log_options.hpp"
#include "terminal/option_checks.hpp"
#include "terminal/stderr_line.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar::commands {
namespace {

struct CompareArguments {
  ComparedDriftOptions drifts;
  std::vector<std::string> match;
  std::vector<std::string> out;
  std::string plot;
  std::optional<double> max_gap_s;
  bool details = false;
  bool json = false;
};

std::string names_of(const MeasuredDrift& drift) {
  std::vector<std::string> names;
  for (const DriftAxis& axis : drift.axes) names.push_back(axis.name);
  return fmt::format("{}", fmt::join(names, ", "));
}

// "axial=-z": b's axis z, its sign changed, under the name that a has for it.
DriftAxis matched(const MeasuredDrift& a, const MeasuredDrift& b, const std::string& stated) {
  const std::size_t equals = std::min(stated.find('='), stated.size());
  std::string name = stated.substr(std::min(equals + 1, stated.size()));
  const bool minus = name.starts_with('-');
  if (minus) name.erase(0, 1);
  const DriftAxis* axis = find_axis(b, name);
  if (find_axis(a, stated.substr(0, equals)) == nullptr || axis == nullptr) {
    throw Error(fmt::format("--match {}: expected A=B or A=-B, A an axis of {} ({}) and B one of {} ({}), found {}.",
                            stated, a.what, names_of(a), b.what, names_of(b),
                            equals == stated.size() ? "no ="
                            : axis == nullptr       ? fmt::format("\"{}\" for B", name)
                                                    : fmt::format("\"{}\" for A", stated.substr(0, equals))));
  }
  DriftAxis renamed = *axis;
  renamed.name = stated.substr(0, equals);
  if (minus) {
    for (double& value : renamed.value) value = -value;
  }
  return renamed;
}

// All of --match at once, so that x=y with y=-x turns the axes.
void match(ComparedDrifts& drifts, const std::vector<std::string>& stated) {
  std::vector<DriftAxis> axes;
  axes.reserve(stated.size());
  for (const std::string& one : stated) axes.push_back(matched(drifts.a, drifts.b, one));
  for (DriftAxis& axis : axes) {
    std::erase_if(drifts.b.axes, [&](const DriftAxis& known) { return known.name == axis.name; });
    drifts.b.axes.push_back(std::move(axis));
  }
}

constexpr const char* kNone = "-";

std::string fixed(const std::optional<double>& value, int decimals, double scale = 1.0) {
  return value ? fmt::format("{:.{}f}", *value * scale, decimals) : kNone;
}

std::string lag_text(const AxisComparison& axis) {
  if (!axis.lag_s) return kNone;
  return with_sigma(min_from_s(*axis.lag_s), min_from_s(*axis.lag_sigma_s), 2);
}

// Of the values of all axes, " um"; empty where the axes differ: each value then has its own.
std::string common_unit(const Comparison& comparison) {
  const std::string& unit = comparison.axes.front().unit;
  const bool is_common = std::all_of(comparison.axes.begin(), comparison.axes.end(),
                                     [&](const AxisComparison& axis) { return axis.unit == unit; });
  return is_common && !unit.empty() ? " " + unit : "";
}

std::string with_unit(const std::string& value, const AxisComparison& axis, const std::string& common) {
  return common.empty() && !axis.unit.empty() && value != kNone ? value + " " + axis.unit : value;
}

Table statistics(const Comparison& comparison, bool all) {
  std::vector<std::string> heading{""};
  for (const AxisComparison& axis : comparison.axes) heading.push_back(axis.name);
  Table table(heading);
  const std::string unit = common_unit(comparison);
  const auto row = [&](const std::string& name, auto&& text_of) {
    std::vector<std::string> cells{name};
    for (const AxisComparison& axis : comparison.axes) cells.push_back(text_of(axis));
    table.add(cells);
  };
  using A = const AxisComparison&;
  row("agrees", [](A axis) -> std::string {
    return axis.agreement == Agreement::agrees ? "yes" : axis.agreement == Agreement::disagrees ? "NO" : "unknown";
  });
  row("samples within 2 sigma", [](A axis) -> std::string {
    return axis.counted == 0 ? kNone : fmt::format("{} of {}", axis.within, axis.counted);
  });
  row("mean relative deviation %", [](A axis) { return fixed(axis.mean_relative_deviation, 2, 100.0); });
  if (all) {
    row("  expected from uncertainty %", [](A axis) { return fixed(axis.expected_relative_deviation, 2, 100.0); });
    row("  explained by uncertainty %", [](A axis) { return fixed(axis.explained_share, 0, 100.0); });
    row("mean deviation, % of range", [](A axis) { return fixed(axis.range_deviation, 2, 100.0); });
  }
  const auto length_row = [&](const std::string& name, auto&& value_of) {
    row(name + unit, [&](A axis) { return with_unit(fixed(value_of(axis), 3), axis, unit); });
  };
  length_row("RMSE", [](A axis) { return axis.rmse; });
  length_row("largest deviation", [](A axis) { return axis.largest; });
  row("  at min", [](A axis) { return fmt::format("{:g}", min_from_s(axis.largest_s)); });
  length_row("bias", [](A axis) { return axis.bias; });
  if (all) {
    length_row("95 % limits of agreement, low", [](A axis) { return axis.limit_low; });
    length_row("95 % limits of agreement, high", [](A axis) { return axis.limit_high; });
  }
  row("correlation", [](A axis) { return fixed(axis.correlation, 4); });
  row("lag of best agreement min", lag_text);
  return table;
}

// One sigma of a difference by source: root mean square over the samples, and share of the variance. Empty where no
// source is known.
std::string budget_text(const Comparison& comparison) {
  const std::string unit = common_unit(comparison);
  std::vector<std::string> heading{"sigma of the difference" + unit}, sources;
  for (const AxisComparison& axis : comparison.axes) {
    heading.push_back(axis.name);
    for (const UncertaintyShare& share : axis.budget) {
      if (std::find(sources.begin(), sources.end(), share.source) == sources.end()) sources.push_back(share.source);
    }
  }
  if (sources.empty()) return {};
  Table table(heading);
  for (const std::string& source : sources) {
    std::vector<std::string> cells{source};
    for (const AxisComparison& axis : comparison.axes) {
      const auto share = std::find_if(axis.budget.begin(), axis.budget.end(),
                                      [&](const UncertaintyShare& s) { return s.source == source; });
      const bool known = share != axis.budget.end() && !std::isnan(share->sigma);
      cells.push_back(
          known ? fmt::format("{} ({:.0f} %)", with_unit(fixed(share->sigma, 3), axis, unit), 100.0 * share->variance)
                : kNone);
    }
    table.add(cells);
  }
  return table.text();
}

// What the difference is made of, each part with the others free; empty where no axis has samples enough.
std::string structure_text(const Comparison& comparison) {
  std::vector<std::string> heading{"B relative to A, fitted together"};
  bool any = false;
  for (const AxisComparison& axis : comparison.axes) {
    heading.push_back(axis.name);
    any = any || axis.structure.has_value();
  }
  if (!any) return {};
  Table table(heading);
  const std::string unit = common_unit(comparison);
  const auto row = [&](const std::string& name, DifferenceKind kind, double zero, double scale, int decimals) {
    std::vector<std::string> cells{name};
    for (const AxisComparison& axis : comparison.axes) {
      const auto part = axis.structure ? axis.structure->parts[static_cast<std::size_t>(kind)] : std::nullopt;
      const bool is_length = kind == DifferenceKind::offset || kind == DifferenceKind::drift;
      const std::string value = part ? with_sigma(scale * (part->value - zero), scale * part->sigma, decimals)
                                : axis.structure ? "not determined"
                                                 : kNone;
      cells.push_back(is_length && part ? with_unit(value, axis, unit) : value);
    }
    table.add(cells);
  };
  row("scale %", DifferenceKind::gain, 1.0, 100.0, 2);
  row("lag min", DifferenceKind::lag, 0.0, min_from_s(1.0), 2);
  row("offset" + unit, DifferenceKind::offset, 0.0, 1.0, 3);
  row(unit.empty() ? "drift per h" : "drift" + unit + "/h", DifferenceKind::drift, 0.0, 1.0, 3);
  return table.text();
}

void print_text(const ComparedDrifts& drifts, const Comparison& comparison, bool details) {
  const AxisComparison& axis = comparison.axes.front();
  if (!drifts.title.empty()) fmt::print("{}\n", drifts.title);
  fmt::print("{} against {}\n{} common samples, {:g} to {:g} min; changes since {:g} min\n\n", comparison.a,
             comparison.b, comparison.samples, min_from_s(axis.time_s.front()), min_from_s(axis.time_s.back()),
             min_from_s(comparison.reference_s));
  constexpr std::size_t kOtherLines = 12;  // of the heading, the legend and the empty lines
  const std::string structure = structure_text(comparison);
  const std::string concluded = wrapped(conclusion(comparison));
  std::string remarks;
  for (const Paragraph& remark : comparison.remarks) remarks += wrapped(remark);
  std::string budget = budget_text(comparison);
  const std::string tables = statistics(comparison, true).text() + structure + budget;
  const bool all = details || lines_in(concluded + tables + remarks) + kOtherLines <= kScreenLines;
  if (!all) budget = "--details prints all rows and the sources of sigma.\n";
  fmt::print("{}\n{}\n", concluded, statistics(comparison, all).text());
  if (!structure.empty()) fmt::print("{}\n", structure);
  std::string legend = "A is the first series, B the second. Lag: positive if A is late.";
  if (!budget.empty()) {
    fmt::print("{}\n", budget);
    legend =
        "Sigma: root mean square over the samples, with its share of the variance. A sample agrees if its difference "
        "is at most 2 sigma. " +
        legend;
  }
  fmt::print("{}", wrapped(legend));
  if (comparison.left_out > 0) {
    fmt::print("{} times lie in a gap and are omitted (--max-gap).\n", comparison.left_out);
  }
  fmt::print("{}", remarks);
}

// NAME_a, NAME_b, NAME_difference and its sigma over the common times; an axis without a value there has a gap.
Series differences(const Comparison& comparison) {
  constexpr double kGap = std::numeric_limits<double>::quiet_NaN();
  Series series;
  for (const AxisComparison& axis : comparison.axes) {
    std::vector<double> merged;
    std::set_union(series.time_s.begin(), series.time_s.end(), axis.time_s.begin(), axis.time_s.end(),
                   std::back_inserter(merged));
    series.time_s = std::move(merged);
  }
  for (const AxisComparison& axis : comparison.axes) {
    const auto add = [&](const char* part, const std::vector<double>& values) {
      Column column{fmt::format("{}_{}_{}", axis.name, part, axis.unit), Role::measured, {}};
      std::size_t i = 0;
      for (const double time_s : series.time_s) {
        const bool there = i < axis.time_s.size() && axis.time_s[i] == time_s;
        column.values.push_back(there ? values[i] : kGap);
        i += there ? 1 : 0;
      }
      series.columns.push_back(std::move(column));
    };
    add("a", axis.a);
    add("b", axis.b);
    add("difference", axis.difference);
    add("difference_sigma", axis.sigma);
  }
  return series;
}

void run(const CompareArguments& options) {
  if (!options.plot.empty()) expect_page("--plot");
  ComparedDrifts drifts = compared_drifts_of(options.drifts);
  std::vector<std::string> outputs = options.out;
  if (!options.plot.empty()) outputs.push_back(options.plot);
  expect_no_input(outputs, drifts.files);
  match(drifts, options.match);
  const Comparison comparison = compare(drifts.a, drifts.b, {options.drifts.reference_s, options.max_gap_s});
  for (const std::string& path : options.out) write_bytes(path, write_series(differences(comparison)));
  if (!options.plot.empty()) {
    write_bytes(options.plot, plot_of({{"compare", json_of(comparison)}}, text_of(conclusion(comparison))));
  }
  if (options.json) {
    print_json(json_of(comparison));
  } else {
    print_text(drifts, comparison, options.details);
  }
  for (const std::string& path : outputs) wrote_line(path);
}

}  // namespace

void add_compare(CLI::App& app) {
  const auto options = std::make_shared<CompareArguments>();
  CLI::App* command = app.add_subcommand("compare", "Compare two drift series");
  add_data(*command, "A", options->drifts.a, "session, folder, drift .csv or five-probe .csv")
      ->required()
      ->type_name("");
  add_data(*command, "B", options->drifts.b, "the same, to compare with A; default: the session's five probes")
      ->type_name("");
  command->add_option("--plot", options->plot, "write a picture of both and their difference to FILE (.svg)")
      ->type_name("FILE")
      ->check(name_that_ends_in({".svg"}));
  command->add_option("--out", options->out, "write both and their difference to FILE (.csv); may be repeated")
      ->type_name("FILE")
      ->allow_extra_args(false)
      ->check(name_that_ends_in({".csv"}));
  take_time(
      *command->add_option("--reference", options->drifts.reference_s, "time of the reference; default: the first"),
      false);
  take_time(*command->add_option("--max-gap", options->max_gap_s,
                                 "longest gap to interpolate over; default: 4 times the usual step"),
            true);
  command
      ->add_option("--match", options->match, "axis of A and the matching axis of B, such as axial=-z; may be repeated")
      ->type_name("A=B")
      ->allow_extra_args(false);
  add_five_probe_options(*command, options->drifts.probes);
  add_details(*command, options->details);
  command->add_flag("--json", options->json, "print the result as JSON");
  command->footer(
      "Examples:\n"
      "  ballbar compare sample-runs/two-arcs-he2015/session.toml --plot agreement.svg\n"
      "  ballbar compare sample-runs/two-arcs-he2015 sample-runs/two-arcs-he2015/five-probe.csv --from-plane-1 0");
  command->callback([options] { run(*options); });
}

}  // namespace ballbar::commands
