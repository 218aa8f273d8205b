// `ballbar train DATA --effects`: a regression on the effects of the catalogue (train.hpp).
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "ballbar/formats/logs/column_named.hpp"
#include "ballbar/formats/models/effect_regression_json.hpp"
#include "ballbar/formats/models/model_toml.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "ballbar/internal/number_text.hpp"
#include "ballbar/internal/series/far_readings.hpp"
#include "ballbar/predict/train.hpp"
#include "ballbar/series/series.hpp"
#include "model/model_options.hpp"
#include "predict/predict_results.hpp"
#include "predict/train.hpp"
#include "terminal/caller.hpp"
#include "terminal/option_checks.hpp"
#include "terminal/stderr_line.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kShownDrivers = 8;
constexpr double kNoBetter = 0.95;  // of the error of the last value held
constexpr std::size_t kHead = 1 << 16;

// The unit of the numbers of a regression.
std::string unit_text(const EffectRegression& regression) {
  const std::string_view unit = unit_of(regression.model.targets.front());
  return std::string(unit.empty() ? "units" : unit);
}

// The conclusion: the error to expect on new rows.
std::string expectation(const EffectRegression& regression) {
  const std::string& target = regression.model.targets.front();
  if (!regression.forecasts) {
    return fmt::format("{}: too few rows to test forecasts. The error on new rows is not known.", target);
  }
  const Forecasts& of = *regression.forecasts;
  const bool several = regression.runs > 1;
  const std::string tested = several ? fmt::format("{} runs, each left out in turn", of.count)
                                     : fmt::format("forecasts from {} origins", of.count);
  const std::string unit = unit_text(regression);
  const std::string without =
      several ? fmt::format("with a prediction of 0 {}", unit) : "with the last value or the mean";
  if (regression.model.terms.empty() || !(of.rmse_um < kNoBetter * of.held_um)) {
    return fmt::format("{} cannot be predicted from these columns. The error in {} is {:.2f} {} RMSE; {}, {:.2f} {}.",
                       target, tested, of.rmse_um, unit, without, of.held_um, unit);
  }
  return fmt::format(
      "{} is {}predicted to {:.2f} {} on new rows (mean absolute error in {}). The RMSE is {:.2f} {}; {}, {:.2f} {}. "
      "The 95 % interval contained {:.0f} % of the values{}.{}",
      target, is_predicted(regression) ? "" : "hardly ", of.error_um, unit, tested, of.rmse_um, unit, without,
      of.held_um, unit, 100.0 * of.within_share,
      regression.interval_scale > 1.005
          ? fmt::format("; the model's file widens it {:.2f} times, so that it contains 95 %",
                        regression.interval_scale)
          : "",
      is_predicted(regression) ? "" : " A random walk that no column drives would be predicted as well by chance.");
}

std::string memory_text(const EffectRegression& regression) {
  const std::string unit = unit_text(regression);
  return regression.length_s > 0.0
             ? fmt::format(
                   "The part that no column explains is {:.2f} {} (standard deviation) and changes slowly (about {}).",
                   regression.sigma_um, unit, duration_text(regression.length_s))
             : fmt::format("The part that no column explains is {:.2f} {} (standard deviation), white.",
                           regression.sigma_um, unit);
}

// The share of the model's effects in the prediction.
std::string named_text(const NamedEffects& named, const std::string& model, const std::string& unit) {
  std::string compared;
  if (named.with_um && named.without_um) {
    compared = fmt::format(" The error of forecasts is {:.2f} {} RMSE with them, {:.2f} {} without.", *named.with_um,
                           unit, *named.without_um, unit);
  }
  if (named.effects.empty())
    return fmt::format("The effects of {} are left out, because they do not improve the forecasts.{}", model, compared);
  std::vector<std::string> parts;
  for (const NamedEffect& one : named.effects)
    parts.push_back(fmt::format("{} {:.2f} ± {:.2f} {}", one.label, one.share_um, one.sigma_um, unit));
  return fmt::format("Named causes predict {}. The other {:.2f} {} of the prediction have no named cause.{}",
                     fmt::join(parts, ", "), named.rest_um, unit, compared);
}

std::string start_text(const Start& start, const std::string& file, const std::string& unit) {
  std::string text =
      start.used
          ? fmt::format(
                "{} is adapted to this machine. It predicts {:.2f} {}; {:.2f} {} are this machine's own correction. "
                "{:.0f} % of the information is from these rows, {:.0f} % is borrowed.",
                file, start.start_um, unit, start.own_um, unit, 100.0 * (1.0 - start.borrowed), 100.0 * start.borrowed)
          : fmt::format("{} does not improve the forecasts. The model is trained on this machine's rows alone.", file);
  if (start.adapted_um && start.alone_um) {
    text += fmt::format(" The error of forecasts is {:.2f} {} RMSE with it, {:.2f} {} without.", *start.adapted_um,
                        unit, *start.alone_um, unit);
  }
  return text;
}

Table driver_table(const DriverReport& report, const std::string& unit) {
  Table table({"column", "role", "contribution " + unit, "range in refits", "stability"});
  double others = 0.0;
  std::size_t shown = 0, more = 0;
  for (const DriverStability& one : report.drivers) {
    if (shown++ >= kShownDrivers) {
      others += one.share.share_um;
      ++more;
      continue;
    }
    table.add({one_line(one.share.column), std::string(name_of(one.share.role)), fixed(one.share.share_um, 2),
               fmt::format("{:.2f} to {:.2f}", one.low_um, one.high_um),
               one.stable  ? "stable"
               : one.flips ? "sign changes"
                           : "not stable"});
  }
  if (more > 0) table.add({fmt::format("{} more", more), "", fixed(others, 2), "", ""});
  return table;
}

std::vector<std::string> remarks_of(const DriverReport& report, const std::string& unit) {
  std::vector<std::string> remarks;
  for (const std::vector<std::string>& names : report.interchangeable) {
    remarks.push_back(fmt::format("Interchangeable; one of them is enough: {}.", fmt::join(names, ", ")));
  }
  if (!report.not_needed.empty()) {
    remarks.push_back(
        fmt::format("Any one of these can be left out without loss: {}.", fmt::join(report.not_needed, ", ")));
  }
  for (const CancellingColumns& pair : report.cancelling) {
    remarks.push_back(fmt::format(
        "{0} ({1:.1f} {5}) and {2} ({3:.1f} {5}) nearly cancel (sum {4:.1f} {5}). Neither is a cause by itself.",
        pair.first, pair.first_um, pair.second, pair.second_um, pair.sum_um, unit));
  }
  return remarks;
}

// With the models that are read beside the data.
std::vector<std::filesystem::path> with_models(const TrainOptions& options, std::vector<std::filesystem::path> files) {
  for (const std::string& file : {options.model, options.start}) {
    if (!file.empty()) files.emplace_back(file);
  }
  return files;
}

struct OpenedRuns {
  std::vector<Series> runs;
  std::vector<std::string> names;
};

// The runs of the data; of a list the batches that were opened, with the temperatures that were kept.
OpenedRuns opened_runs(const TrainOptions& options, const std::optional<OpenedBatches>& opened) {
  std::vector<std::string> without = options.without_sensor;
  OpenedRuns result;
  std::vector<Series>& runs = result.runs;
  if (opened) {
    for (std::size_t k = 0; k < opened->batches.size(); ++k) {
      runs.push_back(read_batch(options.batch(opened->files[k]), options.max_gap_s));
      result.names.push_back(opened->files[k].stem().string());
    }
    const std::vector<std::string>& kept = opened->columns.sensors;
    for (const Column& column : runs.front().columns) {
      if (is_sensor(column) && std::find(kept.begin(), kept.end(), column.name) == kept.end()) {
        without.push_back(column.name);
      }
    }
  } else {
    ModelOptions how;
    how.data = options.data;
    how.max_gap_s = options.max_gap_s;
    const ModelData data = open_data(how);
    if (data.level != Level::series) {
      throw Error(fmt::format("{}: expected series or sessions of drift, found recordings.", options.title()));
    }
    expect_no_input({options.out}, with_models(options, data.files));
    for (const RowRange& range : runs_of(data.series->time_s)) runs.push_back(rows_of(*data.series, range));
    for (const RunOrigin& run : data.series->runs) result.names.push_back(run.name);
    without = columns_named(runs.front(), without);
    for (const std::string& name : without) {
      if (find_column(runs.front(), name) != nullptr) continue;
      throw Error(
          fmt::format("--without-sensor {}: expected a column of {}, found none of that name.", name, options.title()));
    }
  }
  for (Series& run : runs) {
    std::erase_if(run.columns, [&](const Column& column) {
      return std::find(without.begin(), without.end(), column.name) != without.end();
    });
  }
  return result;
}

// Of a list of runs; nothing of one record.
std::optional<OpenedBatches> opened_list(const TrainOptions& options) {
  if (!lists_batches(options.data)) {
    if (options.room || options.inputs != InputKind::temperature || !options.without.empty() || options.keep_broken) {
      throw Error(fmt::format("{}: expected a list of runs for --room, --inputs, --without and --keep-broken.",
                              options.title()));
    }
    expect_no_input({options.out}, with_models(options, paths_of(options.data)));
    return std::nullopt;
  }
  OpenedBatches opened = open_batches(options);
  expect_no_input({options.out}, with_models(options, opened.files));
  return opened;
}

// Of all runs; of several the first that has it.
std::vector<ColumnFault> faults_of(const std::vector<Series>& runs, const std::string& target) {
  std::vector<ColumnFault> faults;
  for (const Series& run : runs) {
    for (ColumnFault& fault : faults_bearing_on(run, target)) {
      const auto same = std::find_if(faults.begin(), faults.end(), [&](const ColumnFault& one) {
        return one.column == fault.column && one.kind == fault.kind;
      });
      if (same == faults.end()) {
        faults.push_back(std::move(fault));
      } else {
        same->count += fault.count;
        same->long_s += fault.long_s;
      }
    }
  }
  return faults;
}

// Readings of the target that lie far off their neighbours are none to learn from, as in a fit.
void set_aside_far(std::vector<Series>& runs, const std::string& target) {
  for (Series& run : runs) {
    for (Column& column : run.columns) {
      if (column.name != target) continue;
      for (const std::size_t row : far_readings(column.values)) column.values[row] = std::nan("");
    }
  }
}

Contender effects_contender(const TrainedRegression& trained, const OpenedBatches& opened) {
  Contender effects{"effects", {}, trained.left_out.value_or(HeldOutErrors{}), {}, trained.regression.rmse_um, true};
  effects.held_out.rms_um = trained.regression.forecasts->rmse_um;
  if (trained.left_out) effects.worst = opened.files[trained.left_out->worst].stem().string();
  return effects;
}

}  // namespace

std::string TrainOptions::title() const {
  if (data.size() == 1) return data.front().name();
  return fmt::format("{} to {}", data.front().name(), data.back().name());
}

bool lists_batches(const std::vector<Source>& data) {
  const Source& source = data.front();
  if (data.size() > 1 || source.series() || (source.is_path() && std::filesystem::is_directory(source.path())))
    return false;
  const std::string head = source.head(kHead);
  std::size_t at = 0;
  while (at < head.size() && (head[at] == '#' || head[at] == '\n' || head[at] == '\r')) {
    at = head[at] == '#' ? head.find('\n', at) : at + 1;
    if (at == std::string::npos) return false;
  }
  const std::string_view rest = std::string_view(head).substr(at);
  const std::string_view first = rest.substr(0, rest.find_first_of(",\r\n"));
  return first == "run" || first == "file";
}

std::optional<ForecastTest> forecast_test(const EffectRegression& regression) {
  if (!regression.forecasts) return std::nullopt;
  return ForecastTest{*regression.forecasts, is_predicted(regression)};
}

void train_effects(const TrainOptions& options) {
  const std::optional<OpenedBatches> opened = opened_list(options);
  std::vector<Contender> contenders;
  for (const RegressionMethod method : kRegressionMethods) {
    if (!opened || options.sensors) break;
    contenders.push_back(
        with_source(options.title(), [&] { return contender_of(*opened, best_settings(opened->batches, method)); }));
  }
  OpenedRuns data = opened_runs(options, opened);
  std::vector<Series>& runs = data.runs;
  const std::string target = target_of(options, runs.front());
  const std::vector<ColumnFault> faults = faults_of(runs, target);
  set_aside_far(runs, target);
  std::optional<SensorChoice> choice;
  if (options.sensors) {
    choice = with_source(options.title(), [&] { return keep_chosen_sensors(runs, target, *options.sensors); });
  }
  EffectRegressionOptions how;
  how.few = options.few;
  how.forecasts = !choice;
  how.progress = [](const std::string& what) { show_progress(what); };
  if (!options.model.empty()) how.named = read_model(read_bytes(options.model, kLargestText), options.model);
  std::optional<EffectRegression> start;
  if (!options.start.empty()) {
    start = read_effect_regression(read_bytes(options.start, kLargestText), options.start);
    if (const std::string& of = start->model.targets.front(); of != target) {
      throw Error(fmt::format("{}: expected a model of {}, found one of {}.", options.start, target, of));
    }
    how.start = &*start;
  }
  TrainedRegression trained = [&] {
    const ProgressLine progress;
    return with_source(options.title(), [&] { return trained_regression(runs, target, how); });
  }();
  if (choice) take_tests_of(*choice, trained);
  const EffectRegression& of = trained.regression;
  const bool is_model = !of.model.terms.empty();
  if (is_model && !options.out.empty()) write_bytes(options.out, write_effect_regression(of));
  std::vector<std::string> said = remarks_of(trained.drivers, unit_text(of));
  if (!of.left_out.empty()) {
    said.push_back(fmt::format("Not used, because they are constant or have gaps: {}.", fmt::join(of.left_out, ", ")));
  }
  if (opened) said.insert(said.end(), opened->remarks.begin(), opened->remarks.end());
  std::optional<WorstRun> worst;
  if (trained.left_out && trained.left_out->worst < data.names.size())
    worst = WorstRun{data.names[trained.left_out->worst], trained.left_out->worst_um};
  if (options.json) {
    print_json(json_of(TrainedOnEffects{trained, worst, contenders, choice, faults, said, expectation(of)}));
  } else {
    std::vector<ScreenPart> parts{
        {fmt::format("{}\n{} from {} columns by {}; {} rows{}\n", options.title(), target, of.model.trained.size(),
                     dictionary_text(of), of.rows, of.runs > 1 ? fmt::format(" of {} runs", of.runs) : "")}};
    if (choice) {
      const auto of_sensors = sensor_choice_parts(*choice, target, unit_text(of), is_predicted(of), options.details);
      parts.insert(parts.end(), of_sensors.begin(), of_sensors.end());
    }
    std::string conclusion = wrapped(expectation(of));
    if (worst)
      conclusion +=
          wrapped(fmt::format("The worst run is {}: {:.2f} {} RMSE.", worst->run, worst->rmse_um, unit_text(of)));
    if (trained.start) conclusion += wrapped(start_text(*trained.start, options.start, unit_text(of)));
    if (how.named) conclusion += wrapped(named_text(trained.named, options.model, unit_text(of)));
    parts.push_back({lines_of(faults) + (faults.empty() ? "" : "\n") + conclusion + wrapped(memory_text(of))});
    if (opened && of.forecasts && !choice) {
      contenders.push_back(effects_contender(trained, *opened));
      parts.push_back({contest_text(contenders)});
    }
    parts.push_back({driver_table(trained.drivers, unit_text(of)).text(table_width()) +
                         wrapped(fmt::format(
                             "contribution: to the range of the prediction, {:.2f} {}; contributions add up to it. "
                             "range in refits: of the contribution in {} refits, each without a part of the record.",
                             trained.drivers.range_um, unit_text(of), trained.drivers.refits)),
                     "the contribution of each column"});
    parts.push_back(remarks_part(said));
    fmt::print("{}", on_a_screen(parts, options.details));
  }
  if (is_model) {
    if (!options.out.empty()) wrote_line(options.out);
  } else {
    stderr_line("no effect is more likely than none: nothing written");
  }
}

}  // namespace ballbar
