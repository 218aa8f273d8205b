#include "report/report_data.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <set>

#include "ballbar/drift/compare.hpp"
#include "ballbar/error.hpp"
#include "ballbar/formats/models/batch_model_json.hpp"
#include "ballbar/formats/recordings/test_folder.hpp"
#include "ballbar/formats/sessions/drift_data.hpp"
#include "ballbar/formats/sessions/runs_toml.hpp"
#include "ballbar/formats/text/archive.hpp"
#include "ballbar/formats/text/reader.hpp"
#include "ballbar/message_catalogue.hpp"
#include "ballbar/series/series.hpp"
#include "errors/test_comparison_text.hpp"
#include "measure/compared_drifts.hpp"
#include "measure/drift_text.hpp"
#include "predict/predicted_job.hpp"
#include "report/report_results.hpp"
#include "terminal/command_line.hpp"
#include "terminal/log_options.hpp"
#include "terminal/stderr_line.hpp"

namespace ballbar {
namespace {

namespace fs = std::filesystem;

// Of several tests the page says each conclusion with its table.
void add_machine_errors(Report& made, const Fitted& fitted, const StatedCircle& stated) {
  MachineErrorsPart part = machine_errors_part(fitted, stated);
  for (const std::string& remark : part.remarks) made.page.fit->remarks.push_back(remark);
  if (part.tests.empty()) return;
  if (part.conclusions.size() == 1) made.conclude(part.conclusions.front());
  made.page.machine_errors = std::move(part.tests);
}

// Of files without readings the page has what they store.
void add_results_alone(Report& made, const Fitted& fitted) {
  for (const ResultsAlone& alone : fitted.results_alone) {
    made.conclude(messages::stores_results(file_name(alone.file)));
  }
}

// The page is mailed: a sentence has the file's name alone.
void add_skipped(Report& made, const std::vector<SkippedFile>& skipped) {
  for (const SkippedFile& one : skipped) {
    std::string why = one.why;
    if (why.starts_with(one.file)) why.replace(0, one.file.size(), file_name(one.file));
    made.page.fit->remarks.push_back("Left out: " + why);
    value_of(made.page.skipped).push_back({file_name(one.file), why});
  }
  made.skipped.insert(made.skipped.end(), skipped.begin(), skipped.end());
}

// Before and after: the errors of all tests, and those of a plane against each other.
void add_test_comparisons(Report& made, const Fitted& fitted, const ReportRequest& options) {
  MachineErrorsPart part = machine_errors_part(fitted, options.model.circle);
  for (const std::string& remark : part.remarks) made.page.fit->remarks.push_back(remark);
  std::vector<std::string> without;
  std::vector<ComparedTests> compared = compared_tests_of(fitted, part.tests, names_of(options.compare), without);
  for (const ComparedTests& one : compared) made.conclude(conclusion(one.comparison));
  for (const std::string& sentence : without) made.conclude(as_it_is(sentence));
  made.page.test_comparisons = std::move(compared);
  if (!part.tests.empty()) made.page.machine_errors = std::move(part.tests);
}

// "XY: before.b5r → after.b5r"
std::string title_of(const std::vector<ComparedTests>& compared) {
  std::string title;
  for (const ComparedTests& one : compared) {
    const TestComparison& pair = one.comparison;
    title += fmt::format("{}{}: {} → {}", title.empty() ? "" : "; ", name_of(pair.before.plane), pair.before.file,
                         pair.after.file);
  }
  return title;
}

// The name of the test where all recordings, or stored results, are of one.
std::string test_name_of(const Fitted& fitted) {
  std::set<std::string> names;
  for (const FittedRecording& one : fitted.recordings) names.insert(one.test_name);
  for (const ResultsAlone& one : fitted.results_alone) names.insert(one.b5r.test_name);
  return names.size() == 1 ? *names.begin() : std::string();
}

void add_recordings(Report& made, const ReportRequest& options) {
  std::vector<Source> files = options.model.data;
  files.insert(files.end(), options.compare.begin(), options.compare.end());
  const Fitted fitted = fit_files(files, {}, Faults::skip, options.model.circle);
  made.page.fit = recordings_part(fitted);
  if (options.compare.empty()) {
    add_machine_errors(made, fitted, options.model.circle);
    add_results_alone(made, fitted);
  } else {
    add_test_comparisons(made, fitted, options);
  }
  add_skipped(made, fitted.skipped);
  const std::string test_name = test_name_of(fitted);
  if (made.page.test_comparisons) {
    made.page.head.title = as_it_is(title_of(*made.page.test_comparisons));
  } else if (!test_name.empty()) {
    made.page.head.title = as_it_is(test_name);
  } else if (options.model.data.size() > 1) {
    made.page.head.title = messages::recordings_of_files(fitted.recordings.size(), options.model.data.size());
  } else {
    made.page.head.title = as_it_is(file_name(options.model.data.front().path()));
  }
  for (const Source& source : files) {
    if (source.is_path()) made.files.push_back(file_on_disk(source.path()));
  }
}

void add_session(Report& made, const SessionFiles& files, const ReportRequest& options) {
  const std::filesystem::path path = options.model.data.front().path();
  const Session& session = files.session;
  made.page.head.title = as_it_is(session.title.empty() ? file_name(path) : session.title);
  std::vector<std::string> recordings;
  for (const TestFile& one : files.recordings) recordings.push_back(one.file.string());
  const Fitted fitted = fit_files({recordings.begin(), recordings.end()}, {});
  made.page.fit = recordings_part(fitted, files);
  add_machine_errors(made, fitted, options.model.circle);
  add_results_alone(made, fitted);
  add_skipped(made, files.skipped);
  const DriftSeries drift = drift_of(session);
  made.page.drift = drift;
  for (const LargestDrift& largest : largest_drifts(drift)) made.conclude(largest_sentence(largest));
  if (options.model.model.empty() && drift.points.size() > 1) made.page.thermal = sheet_of_session(files, drift);
  if (files.five_probe) {
    const Series probes = open_series(*files.five_probe);
    made.page.five_probe =
        five_point_of(probes, place_of(probes, options.probes, files.ball), file_name(files.five_probe->path()));
  }
  for (const Source& signals : files.signals) {
    made.page.head.signals.push_back(signals_part(file_name(signals.path()), open_series(signals)));
  }
}

void add_series(Report& made, const Series& series, const ReportRequest& options) {
  const std::filesystem::path path = options.model.data.front().path();
  made.page.head.title = as_it_is(file_name(path));
  if (is_five_probe(series) || options.probes.any()) {
    const Series with = stated(series, options.probes);
    made.page.five_probe = five_point_of(with, place_of(with, options.probes), file_name(path));
    if (options.model.model.empty()) made.page.thermal = sheet_of_log(*made.page.five_probe, with);
  } else if (options.model.model.empty() && series.has_clock) {
    const MeasuredDrift drift = measured_drift_of(series, {}, file_name(path));
    if (!drift.axes.empty()) made.page.thermal = sheet_of_log(drift, series);
  }
  made.page.head.signals.push_back(signals_part(file_name(path), series));
}

// Each run's signals; the model is of them together.
void add_runs(Report& made, const ModelData& data) {
  made.page.head.title = as_it_is(data.title);
  made.files.insert(made.files.end(), data.files.begin(), data.files.end());
  const std::vector<RowRange> runs = runs_of(data.series->time_s);
  for (std::size_t run = 0; run < runs.size(); ++run) {
    const std::string name = run < data.series->runs.size() ? file_name(data.series->runs[run].name) : std::string();
    made.page.head.signals.push_back(signals_part(name, rows_of(*data.series, runs[run])));
  }
}

void add_comparison(Report& made, const ReportRequest& options) {
  if (options.compare.size() > 1) throw Error("--compare: expected one drift to compare with, found several files.");
  ComparedDriftOptions drifts{.a = options.model.data.front(),
                              .b = options.compare.empty() ? Source() : options.compare.front(),
                              .probes = options.probes};
  const ComparedDrifts both = compared_drifts_of(drifts);
  made.files.insert(made.files.end(), both.files.begin(), both.files.end());
  const Comparison comparison = compare(both.a, both.b);
  made.page.compare = comparison;
  made.conclude(messages::one_against_other(comparison.a, comparison.b, conclusion(comparison)));
}

void add_batch(Report& made, const ReportRequest& options) {
  made.page.batch = batch_job(options.model.data.front(), options.model.model, options.model.max_gap_s, options.anyway);
  const BatchJob& batch = *made.page.batch;
  if (options.model.model.is_path()) made.files.push_back(options.model.model.path());
  made.conclude(messages::batch_by(batch.job.target, label_of(batch.model.settings), batch.model.batches.size()));
  for (const std::string& warning : batch.job.warnings) made.conclude(as_it_is(warning));
}

std::shared_ptr<const ModelData> model_data(const ReportRequest& options) {
  return std::make_shared<const ModelData>(open_data(options.model));
}

// An option that would do nothing is a mistake.
void expect_use(const ReportRequest& options, bool of_recordings, bool of_batches) {
  const bool has_model = !options.model.model.empty();
  const bool fits = !of_batches && (has_model || options.diagnose);
  const auto expect = [](bool used, const char* option, const char* with) {
    if (!used) throw CLI::ValidationError(fmt::format("{}: expected {}", option, with));
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
FoundFiles expanded(ReportRequest& options, std::vector<std::string>& remarks) {
  std::vector<Source>& data = options.model.data;
  if (!any_folder_of_tests(data)) return {};
  if (data.size() == 1) {
    if (stands_for_runs(data.front())) return {};  // logs
    try {
      open_session(data.front());
      return {};
    } catch (const Error& error) {
      remarks.emplace_back(error.what());
    }
  }
  FoundFiles found = put_recordings_below(data);
  if (found.files.empty()) throw Error(remarks.empty() ? found.faults.front().why : remarks.front());
  return found;
}

}  // namespace

// A page is mailed: where its files lay stays at home.
std::string file_name(const fs::path& path) {
  const fs::path name = path.has_filename() ? path.filename() : path.parent_path().filename();
  return name.empty() || name == "." || name == ".." ? fs::absolute(path).lexically_normal().filename().string()
                                                     : name.string();
}

// open_model_data() distinguishes recordings, a session and a series.
ReportData report_data(ReportRequest& options) {
  ReportData result;
  Report& made = result.report;
  made.page.head = report_head("");
  std::vector<std::string> no_session;
  const FoundFiles found = expanded(options, no_session);
  const bool has_model = !options.model.model.empty();
  const bool of_batches = has_model && is_batch_model_json(options.model.model.head(kHeadBytes));
  const bool of_recordings = !found.files.empty() || is_recording_file(options.model.data.front());
  expect_use(options, of_recordings, of_batches);
  if (of_recordings) {
    if (any_folder_of_tests(options.compare)) put_recordings_below(options.compare);
    if (of_batches) throw Error(options.model.model.name() + ": expected a series to predict, found recordings.");
    add_recordings(made, options);
    add_skipped(made, found.faults);
    for (const std::string& why : no_session) made.conclude(messages::no_drift(why));
    if (has_model || options.diagnose) result.for_model = model_data(options);
    return result;
  }
  if (options.model.data.size() > 1 || stands_for_runs(options.model.data.front())) {
    if (!options.compare.empty())
      throw Error("--compare: expected one session or series to compare, found several runs.");
    if (of_batches) throw Error(options.model.model.name() + ": expected one series to predict, found several runs.");
    const std::shared_ptr<const ModelData> runs = model_data(options);
    add_runs(made, *runs);
    if (has_model || options.diagnose) result.for_model = runs;
    return result;
  }
  const DriftData data = open_drift_data(options.model.data.front());
  made.files = data.files;
  const bool fits = !of_batches && (has_model || options.diagnose);
  if (fits) {
    result.for_model = std::make_shared<const ModelData>(without_times(
        with_own_zeros(model_data_of(data, options.model.data.front().name(), {}, options.model.max_gap_s)),
        options.model.left_out));
  }
  tell(fits ? result.for_model->remarks : data.remarks);
  if (data.session) {
    add_session(made, *data.session, options);
  } else {
    add_series(made, *data.series, options);
  }
  if (!options.compare.empty() || (data.session && data.session->five_probe)) add_comparison(made, options);
  if (of_batches) add_batch(made, options);
  return result;
}

void add_report_options(CLI::App& command, ReportRequest& request) {
  add_model_options(command, request.model, false);
  add_also_input(command, request.model);
  add_fit_options(command, request.model);
  add_data(command, "--compare", request.compare,
           "another drift, or later ballbar tests, to compare DATA with; may be repeated")
      ->type_name("DATA")
      ->allow_extra_args(false);
  CLI::Option* diagnose =
      command.add_flag("--diagnose", request.diagnose, "also show which effect is missing, with or without a model");
  command.add_flag("--no-diagnosis", request.no_diagnosis, "with a model: omit the diagnosis")->excludes(diagnose);
  command.add_flag("--anyway", request.anyway, "model of `train`: predict even if a sensor seems broken");
  add_five_probe_options(command, request.probes);
}

}  // namespace ballbar
