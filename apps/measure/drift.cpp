// `ballbar drift SESSION`: the drift over time, one row per test.
#include "ballbar/drift/drift.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <memory>

#include "ballbar/drift/thermal_test.hpp"
#include "ballbar/error.hpp"
#include "ballbar/formats/series/drift_files.hpp"
#include "ballbar/formats/sessions/drift_data.hpp"
#include "ballbar/units.hpp"
#include "commands.hpp"
#include "measure/drift_result.hpp"
#include "measure/drift_text.hpp"
#include "measure/five_probe_drift.hpp"
#include "terminal/caller.hpp"
#include "terminal/command_line.hpp"
#include "terminal/log_options.hpp"
#include "terminal/option_checks.hpp"
#include "terminal/stderr_line.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar::commands {
namespace {

struct DriftArguments {
  Source session;
  std::vector<std::string> out;
  std::optional<double> reference_s;
  bool sequential = false;
  bool equal_radii = false;
  bool eq34 = false;
  bool polar = false;
  bool robust = false;
  bool json = false;
  bool details = false;
  bool five_probe = false;
  std::optional<double> stable_um;
  FiveProbeOptions probes;
};

// Where one test found the spindle's ball, set-up errors included.
std::string position_text(const Position& position) {
  std::string text;
  const auto add = [&](const char* name, const std::optional<Estimate>& part) {
    if (part) text += fmt::format("{}{} {} um", text.empty() ? "" : ", ", name, with_sigma(*part));
  };
  add("x", position.x);
  add("y", position.y);
  add("z", position.z);
  add("centre A", position.centre_a);
  add("centre B", position.centre_b);
  text += fmt::format(", radius {:.5f} mm", position.radius_mm);
  if (position.length_mm) text += fmt::format(", axial length {:.5f} mm", *position.length_mm);
  return text + " (with set-up errors).";
}

Table table_of(const DriftSeries& series) {
  std::vector<std::string> heading{"time min"};
  std::vector<DriftQuantity> columns(kDriftQuantities.begin(), kDriftQuantities.end());
  columns.push_back({"radius change", &DriftPoint::radius_change});
  columns.push_back({"radius change A", &DriftPoint::radius_change_a});
  std::erase_if(columns, [&](const DriftQuantity& one) { return !any_has(series, one.member); });
  for (const DriftQuantity& one : columns) heading.push_back(fmt::format("{} um", one.name));
  const bool corrected = series.method == Method::spindle_rotation;
  if (corrected) heading.emplace_back("elongation correction um");
  Table table(heading);
  for (const DriftPoint& point : series.points) {
    std::vector<std::string> row{fmt::format("{:8.1f}", min_from_s(point.time_s))};
    for (const auto& [name, member] : columns) row.push_back(point.*member ? with_sigma(*(point.*member)) : "-");
    if (corrected) row.push_back(fmt::format("{:.4f}", point.elongation_correction_um.value_or(0.0)));
    table.add(row);
  }
  return table;
}

std::string way_of(const DriftSeries& series, const DriftArguments& options) {
  std::string way(name_of(series.method));
  if (series.method == Method::two_arcs) {
    way += options.sequential    ? ", sequential"
           : options.equal_radii ? ", fitted together with R_C = R_A"
                                 : ", fitted together";
  }
  if (series.method == Method::spindle_rotation) {
    way += options.eq34 ? ", elongation corrected by eq. 34" : ", elongation corrected exactly";
  }
  if (options.polar) way += ", polar circles";
  if (options.robust) way += ", robust";
  return way;
}

void print_text(const Session& session, const DriftSeries& series, const DriftSheet& sheet,
                const DriftArguments& options) {
  const std::string title = session.title.empty() ? options.session.name() : session.title;
  fmt::print("{}\n{}; {} test{} over {:g} min, reference at {:g} min\n\n", title, way_of(series, options),
             series.points.size(), series.points.size() == 1 ? "" : "s",
             min_from_s(series.points.back().time_s - series.points.front().time_s), min_from_s(series.reference_s));
  if (series.points.size() == 1) {
    fmt::print("One test gives a position but no drift: {}\n", position_text(series.positions.front()));
    return;
  }
  fmt::print("Largest drift of the spindle relative to the table:\n");
  for (const std::string& largest : largest_texts(sheet.largest)) fmt::print("  {}\n", largest);
  if (!sheet.settling.empty()) fmt::print("\n");
  print_settling(sheet.settling, "test");
  fmt::print("\n");
  for (const std::string& text : thermal_test_texts(sheet.test)) fmt::print("{}", wrapped(text));
  constexpr std::size_t kRows = 21;
  Table table = table_of(series);
  if (!options.details) table.shorten(kRows);
  fmt::print("\n{}\n", table.text());
  for (const Position& position : series.positions) {
    if (position.time_s == series.reference_s) fmt::print("Reference: {}\n", position_text(position));
  }
  fmt::print("{}", wrapped("± is one sigma of the difference to the reference test. Its part from the reference is "
                           "common to all rows. " +
                           text_of(series.not_cancelled)));
  std::vector<std::string> stored;
  for (const SessionTest& test : session.tests) {
    if (!test.stored.empty()) stored.push_back(test.name);
  }
  if (!stored.empty()) {
    fmt::print("{}", wrapped(fmt::format("No readings, so the stored centres are used and their sigma is unknown: {}.",
                                         fmt::join(stored, ", "))));
  }
  for (const Position& position : series.positions) {
    if (position.discounted > 0) {
      fmt::print("At {:g} min {} {} discounted.\n", min_from_s(position.time_s), position.discounted,
                 position.discounted == 1 ? "reading was" : "readings were");
    }
  }
}

// The five probes of a series, or those of a session.
void run_five_probe(const DriftArguments& options, DriftData data) {
  const std::pair<bool, const char*> of_recordings[] = {{options.sequential, "--sequential"},
                                                        {options.equal_radii, "--equal-radii"},
                                                        {options.eq34, "--eq34"},
                                                        {options.polar, "--polar"},
                                                        {options.robust, "--robust"}};
  for (const auto& [given, name] : of_recordings) {
    if (given) throw Error(fmt::format("{}: expected recordings of a ballbar to fit, found five probes.", name));
  }
  FiveProbeReport report;
  report.title = options.session.name();
  BallPlace ball;
  if (data.session) {
    if (!data.session->five_probe) {
      throw Error(fmt::format("{}: expected [five_probe] in the session for --five-probe, found none.",
                              options.session.name()));
    }
    report.title = data.session->five_probe->name();
    data.series = opened_series(*data.session->five_probe).series;
    ball = data.session->ball;
  }
  report.details = options.details;
  report.series = stated(*data.series, options.probes);
  report.how = place_of(report.series, options.probes, ball);
  report.how.reference_s = options.reference_s;
  report.out = options.out;
  report.json = options.json;
  report.stable_um = options.stable_um;
  report_five_probe(report);
}

void run(const DriftArguments& options) {
  DriftData data = open_drift_data(options.session);
  tell(data.remarks);
  expect_no_input(options.out, data.files);
  if (data.series || options.five_probe) return run_five_probe(options, std::move(data));
  if (options.probes.any()) {
    throw Error(
        fmt::format("{}: expected five probes, a series .csv or a session with --five-probe, for the options of "
                    "five probes, found a session.",
                    options.session.name()));
  }
  const Session& session = data.session->session;
  if (session.method != Method::two_arcs && (options.sequential || options.equal_radii)) {
    throw Error(fmt::format("--{}: expected a session of method two_arcs, found {}.",
                            options.sequential ? "sequential" : "equal-radii", name_of(session.method)));
  }
  if (session.method != Method::spindle_rotation && options.eq34) {
    throw Error(
        fmt::format("--eq34: expected a session of method spindle_rotation, found {}.", name_of(session.method)));
  }
  if (session.method == Method::two_arcs && options.polar) {
    throw Error(
        "--polar: expected a session of method circles or spindle_rotation, found two_arcs, which is always "
        "fitted by the length equation.");
  }
  DriftOptions how;
  how.reference_s = options.reference_s;
  how.sequential = options.sequential;
  how.equal_radii = options.equal_radii;
  how.circle.model = options.polar ? CircleModel::polar : CircleModel::length_equation;
  how.circle.robust = options.robust;
  how.circle.elongation_form = options.eq34 ? ElongationForm::eq34 : ElongationForm::exact;
  const DriftSeries series = drift_of(session, how);
  for (const std::string& path : options.out) write_drift(series, path);
  const DriftSheet sheet = sheet_of_session(*data.session, series, options.stable_um);
  if (options.json) {
    DriftOfSession result{series, sheet, {}};
    if (!data.session->skipped.empty()) result.skipped = data.session->skipped;
    print_json(json_of(result));
  } else {
    print_text(session, series, sheet, options);
    fmt::print("{}", left_out_text(data.session->skipped));
  }
  for (const Position& position : series.positions) {
    if (!position.converged) {
      warning_line(fmt::format("the fit of the test at {:g} min did not converge.", min_from_s(position.time_s)));
    }
  }
  if (options.reference_s && *options.reference_s != series.reference_s) {
    warning_line(fmt::format("no test at {:g} s. The nearest one, at {:g} s, is the reference.", *options.reference_s,
                             series.reference_s));
  }
  for (const std::string& path : options.out) wrote_line(path);
}

}  // namespace

void add_drift(CLI::App& app) {
  const auto options = std::make_shared<DriftArguments>();
  CLI::App* command = app.add_subcommand("drift", "Compute the drift of the spindle over a session");
  add_data(*command, "SESSION", options->session,
           "session.toml or its folder, a folder of .b5r files, five probes, or a log of x, y, z")
      ->required()
      ->type_name("");
  command->add_option("--out", options->out, "write the series to FILE (.csv, .json or .mat); may be repeated")
      ->type_name("FILE")
      ->allow_extra_args(false)
      ->check(name_that_ends_in({".csv", ".json", ".mat"}));
  take_time(*command->add_option("--reference", options->reference_s,
                                 "time of the reference test: 3840, 3840s or 64min; default: the first"),
            false);
  CLI::Option* sequential = command->add_flag("--sequential", options->sequential,
                                              "two_arcs: fit path 1, then path 2 with its y, as in the paper");
  command->add_flag("--equal-radii", options->equal_radii, "two_arcs: fit one radius to both arcs")
      ->excludes(sequential);
  command->add_flag("--eq34", options->eq34, "spindle_rotation: correct the elongation by r / cos(dL / r) - r");
  command->add_flag("--polar", options->polar, "fit circles to the polar points, as instrument software does");
  command->add_flag("--robust", options->robust, "discount outliers (Tukey's biweight)");
  command
      ->add_option("--stable", options->stable_um,
                   "band in um about the final value; default: the larger of 2 um and 10 % of the range")
      ->type_name("UM")
      ->check(CLI::PositiveNumber);
  add_details(*command, options->details);
  command->add_flag("--json", options->json, "print the result as JSON");
  command->add_flag("--five-probe", options->five_probe, "use the session's five probes instead of its recordings");
  add_five_probe_options(*command, options->probes);
  command->footer(
      "Examples:\n"
      "  ballbar drift sample-runs/two-arcs-he2015/session.toml --out drift.csv\n"
      "  ballbar drift sample-runs/two-arcs-he2015/five-probe.csv --from-plane-1 25");
  command->callback([options] { run(*options); });
}

}  // namespace ballbar::commands
