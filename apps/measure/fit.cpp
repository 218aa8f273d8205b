// `ballbar fit FILE...`: circle or axial fit of each recording, ISO 230-4 of a pair, stored results beside.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <memory>

#include "ballbar/error.hpp"
#include "ballbar/formats/recordings/test_folder.hpp"
#include "ballbar/formats/text/archive.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "ballbar/units.hpp"
#include "commands.hpp"
#include "measure/fit_result.hpp"
#include "terminal/caller.hpp"
#include "terminal/command_line.hpp"
#include "terminal/log_options.hpp"
#include "terminal/option_checks.hpp"
#include "terminal/stderr_line.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar::commands {
namespace {

struct FitArguments {
  StatedCircle circle;
  std::vector<Source> files;
  std::string out;
  bool polar = false;
  bool robust = false;
  bool details = false;
  bool json = false;
};

constexpr std::size_t kRows = 20, kRemarks = 5;  // without --details

// The file's name where there are several; with one file it stands in the title.
std::string name_of_row(const Fitted& fitted, const FittedRecording& one) {
  const bool one_file = fitted.recordings.front().file == fitted.recordings.back().file;
  const std::string_view what = one.circle ? name_of(one.recording.direction) : name_of(one.recording.kind);
  return one_file ? std::string(what) : fmt::format("{} {}", one.file, what);
}

std::string circles_text(const Fitted& fitted, bool details) {
  Table table(
      {"recording", "plane", "arc deg", "readings", "centre A um", "centre B um", "radius mm", "G um", "rms um"});
  bool any = false;
  for (const FittedRecording& one : fitted.recordings) {
    if (!one.circle) continue;
    any = true;
    const Circle& circle = *one.circle;
    table.add({name_of_row(fitted, one), std::string(name_of(one.recording.plane)),
               fmt::format("{:.1f}", circle.arc_deg), fmt::format("{}", circle.readings),
               with_sigma(circle.centre_a_um, circle.sigma_centre_a_um(), 2),
               with_sigma(circle.centre_b_um, circle.sigma_centre_b_um(), 2),
               with_sigma(circle.radius_mm, mm_from_um(circle.sigma_radius_um()), 5),
               with_sigma(one.circularity->circular_deviation_um, one.circularity->circular_deviation_sigma_um, 2),
               fmt::format("{:.2f}", circle.rms_um)});
  }
  if (!details) table.shorten(kRows);
  return any ? table.text() + '\n' : "";
}

std::string axial_text(const Fitted& fitted, bool details) {
  Table table({"recording", "readings", "length mm", "rms um"});
  bool any = false;
  for (const FittedRecording& one : fitted.recordings) {
    if (!one.axial) continue;
    any = true;
    table.add({name_of_row(fitted, one), fmt::format("{}", one.recording.length_mm.size()),
               with_sigma(one.axial->length_mm, mm_from_um(one.axial->sigma_um), 5),
               fmt::format("{:.2f}", one.axial->rms_um)});
  }
  if (!details) table.shorten(kRows);
  return any ? table.text() + '\n' : "";
}

// What the numbers of one recording need said with them.
std::string remarks_text(const FittedRecording& one, const std::string& name) {
  const Circle& circle = *one.circle;
  std::string text;
  const double sigma_um = std::max(circle.sigma_centre_a_um(), circle.sigma_centre_b_um());
  const double circularity_um = one.circularity->circular_deviation_um;
  const bool is_arc = circle.arc_deg < 359.0;
  if (is_arc && std::isfinite(sigma_um) && sigma_um > circularity_um) {
    const char* what = circle.model == CircleModel::polar ? "the polar circle of an arc" : "an arc";
    text +=
        wrapped(fmt::format("{}: {} of {:.0f} deg does not determine the centre: sigma {:.2g} um, circularity "
                            "{:.2g} um.",
                            name, what, circle.arc_deg, sigma_um, circularity_um));
  } else if (is_arc) {
    text +=
        wrapped(fmt::format("{}: on a partial arc the centre correlates with the radius, A by {:.2f} and B by {:.2f}.",
                            name, circle.correlation_a_radius(), circle.correlation_b_radius()));
  }
  if (one.least_squares && one.least_squares->radius_mm != circle.radius_mm && circle.model != CircleModel::polar) {
    const Circle& alone = *one.least_squares;
    text +=
        wrapped(fmt::format("{}: the least-squares circle, without an oval, has radius {:.5f} mm, centre A {:.2f} um "
                            "and centre B {:.2f} um.",
                            name, alone.radius_mm, alone.centre_a_um, alone.centre_b_um));
  }
  if (!std::isfinite(circle.sigma_radius_um())) {
    text += wrapped(name + ": the readings do not determine the circle. At least three different angles are needed.");
  }
  if (!circle.discounted.empty()) {
    text += fmt::format("{}: {} of {} readings discounted, numbered from 1:", name, circle.discounted.size(),
                        circle.readings);
    constexpr std::size_t kListed = 10;
    for (std::size_t i = 0; i < std::min(kListed, circle.discounted.size()); ++i) {
      text += fmt::format(" {}", circle.discounted[i] + 1);
    }
    text += circle.discounted.size() > kListed ? " ... (all with --json);" : ";";
    text += " G, F and rms include all readings.\n";
  }
  if (!circle.converged) text += fmt::format("{}: the fit did not converge: {}\n", name, circle.outcome);
  return text;
}

std::string sigma_text(const Fitted& fitted, bool is_polar) {
  double fewest = std::numeric_limits<double>::infinity();
  double phi = 0.0, oval_um = 0.0;
  for (const FittedRecording& one : fitted.recordings) {
    if (one.circle) oval_um = std::max(oval_um, one.circle->oval_um);
    if (one.circle && one.circle->autocorrelation > phi) {
      phi = one.circle->autocorrelation;
      fewest = std::min(fewest, one.circle->effective_readings);
    }
  }
  std::string text = "G is the circular deviation. ± is one sigma from the residual";
  if (phi > 0.0) {
    text += fmt::format(
        ", widened because the residual is autocorrelated (up to {:.3f}): the readings of a recording count as {:.0f} "
        "independent one{}",
        phi, fewest, fewest < 1.5 ? "" : "s");
  }
  text += '.';
  if (oval_um > 0.0) {
    text += fmt::format(
        " On an arc an oval of the path looks like another centre. ± includes an oval of usual size, {:.1f} um.{}",
        oval_um, is_polar ? "" : " G is about the least-squares centre, without the oval.");
  }
  return wrapped(text);
}

// To the digits the instrument's software prints: one less than ours.
std::string stored_text(const Compared& result) {
  return result.stored ? fmt::format("{:.{}f}", *result.stored, result.decimals - 1) : "-";
}

bool has_stored(const std::vector<Compared>& results) {
  return std::any_of(results.begin(), results.end(), [](const Compared& result) { return result.stored.has_value(); });
}

// The runs of one `.b5r` side by side, ours and what the file stores.
std::string runs_text(const std::vector<const FittedRecording*>& runs) {
  std::vector<std::string> heading{fmt::format("stored in {}", runs.front()->file)};
  for (const FittedRecording* run : runs) {
    heading.push_back(fmt::format("{} computed", name_of(run->recording.direction)));
    heading.emplace_back("stored");
  }
  Table table(heading);
  for (std::size_t k = 0; k < runs.front()->results.size(); ++k) {
    std::vector<std::string> row{runs.front()->results[k].label};
    for (const FittedRecording* run : runs) {
      const Compared& result = run->results[k];
      row.push_back(fmt::format("{:.{}f}", result.ours, result.decimals));
      row.push_back(stored_text(result));
    }
    table.add(row);
  }
  return table.text() + '\n';
}

std::string pair_text(const FittedPair& pair) {
  const bool with_stored = has_stored(pair.results);
  std::vector<std::string> heading{fmt::format("ISO 230-4, {}", pair.file), "computed"};
  if (with_stored) heading.emplace_back("stored");
  Table table(heading);
  for (const Compared& result : pair.results) {
    std::vector<std::string> row{result.label, fmt::format("{:.{}f}", result.ours, result.decimals)};
    if (with_stored) row.push_back(stored_text(result));
    table.add(row);
  }
  std::string text = table.text() + '\n';
  for (const std::string& remark : pair.remarks) text += wrapped(remark);
  return text;
}

std::string stored_runs_text(const Fitted& fitted) {
  std::string text;
  std::vector<const FittedRecording*> runs;
  for (const FittedRecording& one : fitted.recordings) {
    if (!has_stored(one.results)) continue;
    if (!runs.empty() && runs.front()->file != one.file) {
      text += runs_text(runs);
      runs.clear();
    }
    runs.push_back(&one);
  }
  return runs.empty() ? text : text + runs_text(runs);
}

std::string fits_text(const Fitted& fitted, const FitArguments& options) {
  const std::string circles = circles_text(fitted, options.details);
  std::string text;
  if (fitted.recordings.front().file == fitted.recordings.back().file) text += fitted.recordings.front().file + '\n';
  if (!circles.empty()) {
    text += fmt::format("Circles by {}{}\n", options.polar ? "the polar points" : "the length equation",
                        options.robust ? ", robust" : "");
  }
  text += '\n' + circles + axial_text(fitted, options.details);
  const std::string stored = stored_runs_text(fitted);
  std::string compared = stored;
  for (const FittedPair& pair : fitted.pairs) compared += pair_text(pair);
  const bool is_too_long = !options.details && lines_in(text + compared) > kScreenLines;
  text += is_too_long ? more_text(lines_in(compared), "line") + " of ISO 230-4 and stored values\n\n" : compared;
  if (!circles.empty()) text += sigma_text(fitted, options.polar);
  std::size_t remarks = 0;
  for (const FittedRecording& one : fitted.recordings) {
    const std::string remark = one.circle ? remarks_text(one, name_of_row(fitted, one)) : "";
    if (!remark.empty() && (++remarks <= kRemarks || options.details)) text += remark;
  }
  if (remarks > kRemarks && !options.details) text += more_text(remarks - kRemarks, "remark") + '\n';
  const bool none_discounted =
      std::all_of(fitted.recordings.begin(), fitted.recordings.end(),
                  [](const FittedRecording& one) { return !one.circle || one.circle->discounted.empty(); });
  if (options.robust && none_discounted) text += "No reading was discounted.\n";
  if (!stored.empty() && !options.polar) {
    text += "The stored results belong to the circle through the polar points. Use --polar to fit that circle.\n";
  }
  return text;
}

std::string alone_text(const ResultsAlone& alone) {
  Table table({fmt::format("stored in {}", alone.file), "value", "unit", "of"});
  for (const StoredValue& one : alone.stored) table.add({one.name, fmt::format("{}", one.value), one.unit, one.of});
  return table.text(table_width(150)) + '\n' + wrapped(alone.file + ": no readings, so there is nothing to fit.");
}

std::string text_of(const Fitted& fitted, const FitArguments& options) {
  std::string text = fitted.recordings.empty() ? "" : fits_text(fitted, options);
  for (const ResultsAlone& alone : fitted.results_alone) {
    text += (text.empty() ? "" : "\n") + alone_text(alone);
  }
  return text;
}

// Archives stand for the files inside them.
void open_archives(std::vector<Source>& files) {
  if (std::none_of(files.begin(), files.end(),
                   [](const Source& file) { return file.is_path() && is_archive(file.path()); }))
    return;
  const FoundFiles found = put_recordings_below(files);
  if (!found.faults.empty()) throw Error(found.faults.front().why);
}

void run(FitArguments options) {
  open_archives(options.files);
  CircleOptions how;
  how.model = options.polar ? CircleModel::polar : CircleModel::length_equation;
  how.robust = options.robust;
  if (!options.out.empty()) expect_no_input({options.out}, paths_of(options.files));
  const Fitted fitted = fit_files(options.files, how, Faults::end_all, options.circle);
  for (const std::string& remark : fitted.remarks) warning_line(remark);
  if (!options.out.empty()) write_bytes(options.out, json_of(fitted).dump(2) + '\n');
  options.json ? print_json(json_of(fitted)) : fmt::print("{}", text_of(fitted, options));
  if (!options.out.empty()) wrote_line(options.out);
}

}  // namespace

void add_fit(CLI::App& app) {
  const auto options = std::make_shared<FitArguments>();
  CLI::App* command = app.add_subcommand("fit", "Fit a circle or an axial length to each recording (ISO 230-4)");
  add_data(*command, "FILE", options->files, ".b5r files, ballbar logs, or circles in tables of text or workbooks")
      ->required()
      ->type_name("");
  add_radius(*command, options->circle);
  command->add_flag("--polar", options->polar, "fit the circle to the polar points, as instrument software does");
  command->add_flag("--robust", options->robust, "discount outliers (Tukey's biweight) and list them");
  add_details(*command, options->details);
  command->add_flag("--json", options->json, "print the result as JSON");
  command->add_option("--out", options->out, "also write the JSON to FILE (.json)")
      ->type_name("FILE")
      ->check(name_that_ends_in({".json"}));
  command->footer("Example:\n  ballbar fit sample-runs/qc20-style-b5r/00.b5r");
  command->callback([options] { run(*options); });
}

}  // namespace ballbar::commands
