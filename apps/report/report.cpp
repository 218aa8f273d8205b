// `ballbar report DATA --out page.html`: everything to look at, in one file.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "ballbar/drift/comparison.hpp"
#include "ballbar/error.hpp"
#include "ballbar/formats/models/model_history.hpp"
#include "ballbar/formats/recordings/recording_file.hpp"
#include "ballbar/formats/recordings/test_folder.hpp"
#include "ballbar/formats/results/drift_results.hpp"
#include "ballbar/formats/sessions/drift_data.hpp"
#include "ballbar/formats/sessions/runs_toml.hpp"
#include "ballbar/formats/text/archive.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "ballbar/series/runs.hpp"
#include "batches/batches.hpp"
#include "commands.hpp"
#include "diagnose/diagnosis_report.hpp"
#include "diagnose/revision_results.hpp"
#include "measure/compared_drifts.hpp"
#include "measure/comparison_result.hpp"
#include "measure/drift_text.hpp"
#include "measure/fit_result.hpp"
#include "model/model_options.hpp"
#include "page/pdf_file.hpp"
#include "page/report_page.hpp"
#include "predict/predict_batch.hpp"
#include "programs/child_process.hpp"
#include "report/report_inside.hpp"
#include "report/report_parts.hpp"
#include "terminal/caller.hpp"
#include "terminal/left_out.hpp"
#include "terminal/option_checks.hpp"
#include "terminal/output_guard.hpp"
#include "terminal/progress.hpp"
#include "terminal/stderr_line.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar::commands {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

enum class Format { html, svg, json, pdf };

struct ReportArguments {
  ModelOptions model;
  std::string compare;
  FiveProbeOptions probes;
  DiagnoseOptions how;
  bool diagnose = false;      // without a model too
  bool no_diagnosis = false;  // with one neither
  bool anyway = false;
  std::string out;
  std::optional<Format> chosen_format;
  Format format = Format::html;
  bool json = false;
  PictureOptions pictures;
  bool open = false;
  bool without_files = false;
};

// A report as it grows, with all files that it is made of.
struct Made {
  PageReport report;
  std::vector<fs::path> files;
  std::vector<SkippedFile> skipped;

  void conclude(const std::string& sentence) { report.head.summary.push_back(sentence); }
};

// Of a part that the first thing in it makes.
template <class Part>
Part& value_of(MayLack<Part>& part) {
  return part.value ? *part.value : part.value.emplace();
}

// A page is mailed: where its files lay stays at home.
std::string file_name(const fs::path& path) {
  const fs::path name = path.has_filename() ? path.filename() : path.parent_path().filename();
  return name.empty() || name == "." || name == ".." ? fs::absolute(path).lexically_normal().filename().string()
                                                     : name.string();
}

// Of several tests the page says each conclusion with its table.
void add_machine_errors(Made& made, const Fitted& fitted, const StatedCircle& stated) {
  MachineErrorsPart part = machine_errors_part(fitted, stated);
  for (const std::string& remark : part.remarks) made.report.fit.value->remarks.push_back(remark);
  if (part.tests.empty()) return;
  if (part.conclusions.size() == 1) made.conclude(part.conclusions.front());
  made.report.machine_errors.value = std::move(part.tests);
}

// Of files without readings the page has what they store.
void add_results_alone(Made& made, const Fitted& fitted) {
  for (const ResultsAlone& alone : fitted.results_alone) {
    made.conclude(fmt::format("{} stores results alone, no readings.", file_name(alone.file)));
  }
}

// The page is mailed: a sentence has the file's name alone.
void add_skipped(Made& made, const std::vector<SkippedFile>& skipped) {
  for (const SkippedFile& one : skipped) {
    std::string why = one.why;
    if (why.starts_with(one.file)) why.replace(0, one.file.size(), file_name(one.file));
    made.report.fit.value->remarks.push_back("Left out: " + why);
    value_of(made.report.skipped).push_back({file_name(one.file), why});
  }
  made.skipped.insert(made.skipped.end(), skipped.begin(), skipped.end());
}

// The name of the test where all recordings, or stored results, are of one.
std::string test_name_of(const Fitted& fitted) {
  std::set<std::string> names;
  for (const FittedRecording& one : fitted.recordings) names.insert(one.test_name);
  for (const ResultsAlone& one : fitted.results_alone) names.insert(one.b5r.test_name);
  return names.size() == 1 ? *names.begin() : std::string();
}

void add_recordings(Made& made, const ReportArguments& options) {
  const Fitted fitted = fit_files(options.model.data, {}, Faults::skip, options.model.circle);
  made.report.fit.value = recordings_part(fitted);
  add_machine_errors(made, fitted, options.model.circle);
  add_results_alone(made, fitted);
  add_skipped(made, fitted.skipped);
  const std::string test_name = test_name_of(fitted);
  if (!test_name.empty()) {
    made.report.head.title = test_name;
  } else if (options.model.data.size() > 1) {
    made.report.head.title = fmt::format("{} recordings of {} files", fitted.recordings.size(), options.model.data.size());
  } else {
    made.report.head.title = file_name(options.model.data.front());
  }
  for (const std::string& file : options.model.data) made.files.push_back(file_on_disk(file));
}

void add_session(Made& made, const SessionFiles& files, const ReportArguments& options) {
  const std::string& path = options.model.data.front();
  const Session& session = files.session;
  made.report.head.title = session.title.empty() ? file_name(path) : session.title;
  std::vector<std::string> recordings;
  for (const TestFile& one : files.recordings) recordings.push_back(one.file.string());
  const Fitted fitted = fit_files(recordings, {});
  made.report.fit.value = recordings_part(fitted, files);
  add_machine_errors(made, fitted, options.model.circle);
  add_results_alone(made, fitted);
  add_skipped(made, files.skipped);
  const DriftSeries drift = drift_of(session);
  made.report.drift.value = drift;
  for (const std::string& largest : largest_drifts(drift)) made.conclude(fmt::format("Largest drift: {}.", largest));
  if (files.five_probe) {
    const Series probes = open_series(*files.five_probe);
    made.report.five_probe.value =
        probes_part(five_point_of(probes, place_of(probes, options.probes, files.ball), file_name(*files.five_probe)));
  }
  for (const fs::path& signals : files.signals) {
    made.report.head.signals.push_back(signals_part(file_name(signals), open_series(signals)));
  }
}

void add_series(Made& made, const Series& series, const ReportArguments& options) {
  const std::string& path = options.model.data.front();
  made.report.head.title = file_name(path);
  if (is_five_probe(series) || options.probes.any()) {
    const Series with = stated(series, options.probes);
    made.report.five_probe.value =
        probes_part(five_point_of(with, place_of(with, options.probes), file_name(path)));
  }
  made.report.head.signals.push_back(signals_part(file_name(path), series));
}

// Each run's signals; the model is of them together.
void add_runs(Made& made, const ReportArguments& options) {
  const std::vector<fs::path> paths(options.model.data.begin(), options.model.data.end());
  const ModelData data = open_model_data(paths, {}, options.model.max_gap_s.value_or(kUsualGap_s));
  made.report.head.title = data.title;
  made.files.insert(made.files.end(), data.files.begin(), data.files.end());
  const std::vector<RowRange> runs = runs_of(data.series.time_s);
  for (std::size_t run = 0; run < runs.size(); ++run) {
    const std::string name = run < data.series.runs.size() ? file_name(data.series.runs[run].name) : std::string();
    made.report.head.signals.push_back(signals_part(name, rows_of(data.series, runs[run])));
  }
}

void add_comparison(Made& made, const ReportArguments& options) {
  ComparedDriftOptions drifts{.a = options.model.data.front(), .b = options.compare, .probes = options.probes};
  const ComparedDrifts both = compared_drifts_of(drifts);
  made.files.insert(made.files.end(), both.files.begin(), both.files.end());
  const Comparison comparison = compare(both.a, both.b);
  made.report.compare.value = comparison;
  made.conclude(fmt::format("{} against {}: {}", comparison.a, comparison.b, conclusion(comparison)));
}

void overlay_effects(Made& made, const Fit& fit, const Model& model, const ModelData& data) {
  if (data.level != Level::recording) return;
  for (std::size_t t = 0; t < model.terms.size(); ++t) {
    if (model.terms[t].effect->rules.is_base) continue;  // drawn as itself
    overlay(*made.report.fit.value, label_of(model.terms[t]), fit.contribution_um[t], fit, data.series);
  }
}

void overlay_candidates(Made& made, const DiagnosisReport& found, const ModelData& data) {
  if (data.level != Level::recording) return;
  for (const Candidate& candidate : found.diagnosis.candidates) {
    if (!candidate.in_best_set) continue;
    const std::vector<double> curve = curve_of(candidate, found.residual_report.fit, data.series);
    if (curve.empty()) continue;
    overlay(*made.report.fit.value, "candidate " + label_of(candidate.bound), curve, found.residual_report.fit,
            data.series);
  }
}

void add_target(Made& made, const ReportArguments& options, const Model& model, const ModelData& data) {
  const auto add_checked = [&](const ResidualReport& residual_report) {
    value_of(made.report.check).targets.push_back(check_part(residual_report, model, data));
    const auto said = sentences(residual_report.fit, residual_report.where, residual_report.whiteness);
    if (!said.empty()) made.conclude(fmt::format("{}: {}", model.targets.front(), said.front()));
    overlay_effects(made, residual_report.fit, model, data);
  };
  // What is missing from a model of the errors of the axes, their ranked table says.
  if (options.no_diagnosis || is_of_machine_errors(model, data.series)) {
    return add_checked(residual_report_of(options.model, model, data, 0));
  }
  const DiagnosisReport found = diagnosis_report_of(options.model, options.how, model, data);
  add_checked(found.residual_report);
  value_of(made.report.diagnose).targets.emplace_back(diagnosis_part(found, data));
  made.conclude(fmt::format("{}: {}", model.targets.front(), found.diagnosis.sentence));
  overlay_candidates(made, found, data);
}

// A target that cannot be fitted is said and left out.
void add_model(Made& made, const ReportArguments& options) {
  const ModelData data = open_data(options.model);
  const Model model = open_model(options.model, data);
  say_start(options.model, data);
  for (std::size_t target = 0; target < model.targets.size(); ++target) {
    try {
      add_target(made, options, of_one_target(model, options.model, target), data);
    } catch (const Error& error) {  // the rest of the report is worth having
      const std::string& name = model.targets[target];
      made.conclude(fmt::format("{}: not {}: {}", name, options.no_diagnosis ? "fitted" : "diagnosed", error.what()));
      if (options.no_diagnosis) continue;
      value_of(made.report.diagnose).targets.emplace_back(NotDiagnosed{name, error.what()});
    }
  }
  if (options.model.model.empty()) return;
  made.files.emplace_back(options.model.model);
  const auto rows = read_ledger(read_bytes(options.model.model, kLargestText), options.model.model);
  if (!rows.empty()) made.report.ledger.value = ledger_of(rows);
}

void add_batch(Made& made, const ReportArguments& options) {
  const BatchJob job = batch_job(options.model.data.front(), options.model.model, options.anyway);
  made.report.batch.value = batch_part(job);
  made.files.emplace_back(options.model.model);
  made.conclude(fmt::format("{} by {} of {} batches.", job.model.columns.target, label_of(job.model.settings),
                            job.model.batches.size()));
  for (const std::string& warning : job.warnings) made.conclude(warning);
}

// An option that would do nothing is a mistake.
void expect_use(const ReportArguments& options, bool of_recordings, bool of_batches) {
  const bool has_model = !options.model.model.empty();
  const bool fits = !of_batches && (has_model || options.diagnose);
  const auto expect = [](bool used, const char* option, const char* with) {
    if (!used) throw CLI::ValidationError(fmt::format("{}: expected {} with it", option, with));
  };
  expect(options.model.target.empty() || fits, "--target", "a model of effects or --diagnose");
  expect(options.model.also_input.empty() || fits, "--also-input", "a model of effects or --diagnose");
  expect(!options.model.robust || fits, "--robust", "a model of effects or --diagnose");
  expect(!options.model.white || fits, "--white", "a model of effects or --diagnose");
  expect(!options.no_diagnosis || fits, "--no-diagnosis", "a model of effects");
  expect(!options.diagnose || !of_batches, "--diagnose", "a model of effects, not one of train,");
  expect(!options.anyway || of_batches, "--anyway", "a model of train");
  expect(!options.probes.any() || !of_recordings, "options of five probes", "a session or a series");
}

// Of folders and archives that are no session, the recordings below them; why a folder is none goes to `remarks`.
FoundFiles expanded(ReportArguments& options, std::vector<std::string>& remarks) {
  std::vector<std::string>& data = options.model.data;
  if (std::none_of(data.begin(), data.end(), is_folder_of_tests)) return {};
  if (data.size() == 1) {
    try {
      open_session(data.front());
      return {};
    } catch (const Error& error) {
      remarks.emplace_back(error.what());
    }
  }
  FoundFiles found = recordings_below(data);
  if (found.files.empty()) throw Error(remarks.empty() ? found.faults.front().why : remarks.front());
  data.clear();
  for (const fs::path& file : found.files) data.push_back(file.string());
  return found;
}

// Recordings are told from a session and a series by what open_model_data() makes of them.
Made made_of(ReportArguments options) {
  Made made;
  made.report.head = report_head("");
  std::vector<std::string> no_session;
  const FoundFiles found = expanded(options, no_session);
  const bool has_model = !options.model.model.empty();
  const bool of_batches = has_model && is_batch_model(options.model.model);
  const bool of_recordings = !found.files.empty() || is_recording_file(options.model.data.front());
  expect_use(options, of_recordings, of_batches);
  if (of_recordings) {
    if (!options.compare.empty())
      throw Error("--compare: expected a session or a series to compare, found recordings.");
    if (of_batches) throw Error(options.model.model + ": expected a series to predict, found recordings.");
    add_recordings(made, options);
    add_skipped(made, found.faults);
    for (const std::string& why : no_session) made.conclude("No drift: " + why);
    if (has_model || options.diagnose) add_model(made, options);
    return made;
  }
  if (options.model.data.size() > 1 || lists_runs(options.model.data.front())) {
    if (!options.compare.empty())
      throw Error("--compare: expected one session or series to compare, found several runs.");
    if (of_batches) throw Error(options.model.model + ": expected one series to predict, found several runs.");
    add_runs(made, options);
    if (has_model || options.diagnose) add_model(made, options);
    return made;
  }
  const DriftData data = open_drift_data(options.model.data.front());
  made.files = data.files;
  tell(data.remarks);
  if (data.session) {
    add_session(made, *data.session, options);
  } else {
    add_series(made, *data.series, options);
  }
  if (!options.compare.empty() || (data.session && data.session->five_probe)) add_comparison(made, options);
  if (of_batches) {
    add_batch(made, options);
  } else if (has_model || options.diagnose) {
    add_model(made, options);
  }
  return made;
}

std::string ending_of(const fs::path& path) {
  std::string ending = path.extension().string();
  for (char& letter : ending) letter = letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
  return ending;
}

void write_pictures(const Json& report, const ReportArguments& options) {
  const std::vector<NamedPicture> pictures = pictures_of(report, options.pictures);
  const bool one_file = ending_of(options.out) == ".svg";
  if (one_file && pictures.size() != 1) {
    std::string names;
    for (const NamedPicture& picture : pictures) names += (names.empty() ? "" : ", ") + picture.name;
    throw Error(fmt::format("--out {}: expected --picture with one of {}, or a folder for all.", options.out, names));
  }
  if (one_file) {
    write_bytes(options.out, pictures.front().svg);
    print_for_people(fmt::format("{}  {}\n", options.out, pictures.front().title));
    return;
  }
  std::error_code error;
  fs::create_directories(options.out, error);
  if (error)
    throw Error(fmt::format("--out {}: expected a folder to write to, found: {}.", options.out, error.message()));
  for (const NamedPicture& picture : pictures) {
    const fs::path path = fs::path(options.out) / (picture.name + ".svg");
    write_bytes(path, picture.svg);
    print_for_people(fmt::format("{}  {}\n", path.string(), picture.title));
  }
}

// As --format says, or the ending of --out.
Format format_of(const ReportArguments& options) {
  if (options.chosen_format) return *options.chosen_format;
  const std::string ending = ending_of(options.out);
  if (ending == ".pdf") return Format::pdf;
  return ending == ".svg" ? Format::svg : ending == ".json" ? Format::json : Format::html;
}

void expect_fitting_options(const ReportArguments& options) {
  const auto expect = [](bool fits, const std::string& sentence) {
    if (!fits) throw CLI::ValidationError(sentence);
  };
  const PictureOptions& pictures = options.pictures;
  const bool sheet = options.format == Format::pdf && pictures.names.empty();  // its one picture may be chosen in
  expect(options.format == Format::svg || sheet || (pictures.names.empty() && pictures.choices.empty()),
         fmt::format("--{}: expected --format svg with it; the page has all pictures",
                     pictures.names.empty() ? "choose" : "picture"));
  expect(sheet || pictures.choices.empty() || pictures.names.size() == 1,
         "--choose: expected one --picture with it, whose choice it is");
  if (options.json) {
    expect(options.out.empty() && !options.chosen_format && !options.open,
           "--json: expected neither --out, --format nor --open with it; it prints the data of the page");
    return;
  }
  expect(!options.out.empty(), options.format == Format::svg
                                   ? "--format svg: expected --out with a folder, or a name that ends in .svg"
                                   : "expected --out with the name of the page, as in --out page.html");
  const std::string ending = ending_of(options.out);
  const std::string wanted = options.format == Format::html   ? ".html"
                             : options.format == Format::json ? ".json"
                             : options.format == Format::pdf  ? ".pdf"
                                                              : "";
  expect(wanted.empty() || ending == wanted, fmt::format("--out {}: expected a name that ends in {}, found {}",
                                                         options.out, wanted, ending.empty() ? "no ending" : ending));
  expect(!options.open || options.format == Format::html, "--open: expected a page to open, not --format");
}

void expect_out(const ReportArguments& options) {
  expect_fitting_options(options);
  if (options.json) return;
  // Before a long diagnosis rather than after it.
  const fs::path folder = fs::absolute(options.out).parent_path();
  std::error_code error;
  if (options.format != Format::svg && !fs::is_directory(folder, error)) {
    throw Error(fmt::format("--out {}: expected a folder to write to, found none of that name.", options.out));
  }
  if (options.format != Format::json) expect_page();
  if (options.format == Format::pdf) expect_pdf("--format pdf");
}

std::string text_of(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

std::string html_of(const Json& json, const Made& made, const ReportArguments& options) {
  if (options.without_files) return page_of(json, nullptr);
  const Json inside = files_inside(made.files, options.model.data, options.model.model);
  if (inside.is_null() && !made.files.empty()) {
    stderr_line(fmt::format("the files are not in the page: more than {} MB, or of a pipe", kMostInside >> 20));
  }
  return page_of(json, inside);
}

std::string bytes_of(const Json& json, const Made& made, const ReportArguments& options) {
  if (options.format == Format::json) return text_of(json) + "\n";
  if (options.format == Format::html) return html_of(json, made, options);
  return pdf_of(handover_of(json, options.pictures.choices), made.report.head.title);
}

void run(ReportArguments options) {
  options.format = format_of(options);
  expect_out(options);
  std::vector<fs::path> inputs(options.model.data.begin(), options.model.data.end());
  for (const std::string& other : {options.model.model, options.compare}) {
    if (!other.empty()) inputs.emplace_back(other);
  }
  if (!options.json) expect_no_input({options.out}, inputs);
  const Made made = [&] {
    const ProgressLine line;
    Made result = made_of(options);
    std::vector<std::string> names;
    for (const fs::path& file : result.files) names.push_back(file_name(file));
    std::sort(names.begin(), names.end());
    names.erase(std::unique(names.begin(), names.end()), names.end());
    result.report.head.files = names;
    return result;
  }();
  const Json json = json_of(made.report);
  if (options.json) return print_json(json, -1);
  expect_no_input({options.out}, made.files);
  if (options.format == Format::svg) return write_pictures(json, options);
  write_bytes(options.out, bytes_of(json, made, options));
  for (const std::string& sentence : made.report.head.summary) print_for_people(wrapped(sentence));
  print_for_people(left_out_text(made.skipped));
  stderr_line(fmt::format("wrote {}", options.out));
  if (options.open && !started({"xdg-open", fs::absolute(options.out).string()})) {
    warning_line(fmt::format("no program xdg-open to open it with; open {} in a browser.", options.out));
  }
}

}  // namespace

void add_report(CLI::App& app) {
  const auto options = std::make_shared<ReportArguments>();
  CLI::App* command = app.add_subcommand("report", "Everything to look at, in one page");
  add_model_options(*command, options->model, false);
  add_also_input(*command, options->model);
  add_fit_options(*command, options->model);
  command->add_option("--compare", options->compare, "another drift, or five probes, to compare DATA with")
      ->type_name("DATA");
  CLI::Option* diagnose =
      command->add_flag("--diagnose", options->diagnose, "which effect is missing, without a model as well");
  command->add_flag("--no-diagnosis", options->no_diagnosis, "with a model: where it fails, not what is missing")
      ->excludes(diagnose);
  command->add_flag("--anyway", options->anyway, "model of `train`: predict though a sensor looks broken");
  command
      ->add_option("--out", options->out,
                   "page.html; one picture .svg, or a folder with --format svg; .json: its data; .pdf: one sheet")
      ->type_name("FILE");
  add_choice(*command, "--format", {"html", "svg", "json", "pdf"}, "by the ending of --out",
             "html: the page; svg: its pictures, drawn by node; json: its data; pdf: one ballbar test on one sheet",
             [options](std::size_t at) { options->chosen_format = static_cast<Format>(at); });
  command->add_flag("--json", options->json, "the result for a program: the data of the page");
  command->add_option("--picture", options->pictures.names, "with --format svg: only this one; may be repeated")
      ->type_name("NAME")
      ->allow_extra_args(false);
  command
      ->add_option(
          "--choose", options->pictures.choices,
          "with --picture, or of the sheet: what the page would choose in it, such as \"recording=64 min, XY CCW\"")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command->add_option("--width", options->pictures.width_px, "of --format svg, in pixels; default 900")
      ->type_name("PX")
      ->check(CLI::Range(300, 4000).description(""));
  command->add_flag("--without-files", options->without_files,
                    "a page that does not hold the files it was made of, with which `ballbar page` goes on");
  command->add_flag("--open", options->open, "open the page in a browser");
  add_five_probe_options(*command, options->probes);
  command->footer(
      "Examples:\n"
      "  ballbar report sample-runs/two-arcs-he2015 --model sample-runs/two-arcs-he2015/model.toml --out page.html\n"
      "  ballbar report sample-runs/qc20-style-b5r/00.b5r --out page.html --open\n"
      "  ballbar report sample-runs/two-arcs-he2015 --format svg --picture drift --out drift.svg");
  command->callback([options] { run(*options); });
}

}  // namespace ballbar::commands
