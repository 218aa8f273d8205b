#include "batches/train_effects.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "ballbar/formats/models/effect_regression_json.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "ballbar/number_text.hpp"
#include "batches/train_result.hpp"
#include "model/model_options.hpp"
#include "terminal/caller.hpp"
#include "terminal/output_guard.hpp"
#include "terminal/progress.hpp"
#include "terminal/stderr_line.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kShownDrivers = 8;
constexpr double kNoBetter = 0.95;           // of the error of the last value held
constexpr double kHardlyBetter = 2.0 / 3.0;  // random walks reach this by chance
constexpr std::size_t kHead = 1 << 16;

bool is_predicted(const EffectRegression& regression) {
  const Forecasts& of = *regression.forecasts;
  return !regression.model.terms.empty() && of.rmse_um < (regression.runs > 1 ? kNoBetter : kHardlyBetter) * of.held_um;
}

// The conclusion: what may be expected of rows that the training did not have.
std::string expectation(const EffectRegression& regression) {
  const std::string& target = regression.model.targets.front();
  if (!regression.forecasts) {
    return fmt::format("{}: too few rows to test forecasts; what it predicts elsewhere is not known.", target);
  }
  const Forecasts& of = *regression.forecasts;
  const bool several = regression.runs > 1;
  const std::string tested = several ? fmt::format("runs left out (each of {})", of.count)
                                     : fmt::format("forecasts from {} origins", of.count);
  const std::string without = several ? "0 um is taken" : "the last value, or the mean, is held";
  if (regression.model.terms.empty() || !(of.rmse_um < kNoBetter * of.held_um)) {
    return fmt::format(
        "{} is not predicted: in {} the error is {:.2f} um RMSE, and {:.2f} um where {}. What moves it is in none of "
        "these columns.",
        target, tested, of.rmse_um, of.held_um, without);
  }
  return fmt::format(
      "{} is {}predicted to {:.2f} um on rows that the training did not have (mean of |error| in {}; RMSE {:.2f} um, "
      "and {:.2f} um where {}). The interval of 95 % held {:.0f} % of them{}.{}",
      target, is_predicted(regression) ? "" : "hardly ", of.error_um, tested, of.rmse_um, of.held_um, without,
      100.0 * of.within_share,
      regression.interval_scale > 1.005
          ? fmt::format(" and is {:.2f} times as wide in the model's file, so that it holds 95 %",
                        regression.interval_scale)
          : "",
      is_predicted(regression) ? "" : " A random walk that no column drives comes as near by chance.");
}

std::string memory_text(const EffectRegression& regression) {
  return regression.length_s > 0.0
             ? fmt::format("What no column drives is a curve of {:.2f} um (standard deviation) with a memory of {}.",
                           regression.sigma_um, duration_text(regression.length_s))
             : fmt::format("What is left scatters by {:.2f} um, without a memory.", regression.sigma_um);
}

Table driver_table(const DriverReport& report) {
  Table table({"column", "role", "share um", "parts left out", "what may be said"});
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
               : one.flips ? "its sign flips"
                           : "not stable"});
  }
  if (more > 0) table.add({fmt::format("{} more", more), "", fixed(others, 2), "", ""});
  return table;
}

std::vector<std::string> remarks_of(const DriverReport& report) {
  std::vector<std::string> remarks;
  for (const std::vector<std::string>& names : report.interchangeable) {
    remarks.push_back(fmt::format("Interchangeable, any of them will do: {}.", fmt::join(names, ", ")));
  }
  if (!report.not_needed.empty()) {
    remarks.push_back(fmt::format("Without any one of these nothing changes: {}.", fmt::join(report.not_needed, ", ")));
  }
  for (const CancellingColumns& pair : report.cancelling) {
    remarks.push_back(
        fmt::format("{} ({:.1f} um) and {} ({:.1f} um) nearly cancel, to {:.1f} um: neither is a cause by itself.",
                    pair.first, pair.first_um, pair.second, pair.second_um, pair.sum_um));
  }
  return remarks;
}

Table contest(const TrainedRegression& trained, const std::vector<OtherMethod>& others,
              const std::vector<std::filesystem::path>& files) {
  const EffectRegression& regression = trained.regression;
  Table table({"method", "left out um", "worst um", "worst batch", "trained um"});
  for (const OtherMethod& other : others) {
    table.add(
        {other.label, fixed(other.left_out_um, 2), fixed(other.worst_um, 2), other.worst, fixed(other.trained_um, 2)});
  }
  const auto worst = std::max_element(trained.left_out.begin(), trained.left_out.end(),
                                      [](const auto& a, const auto& b) { return a.second < b.second; });
  const bool known = worst != trained.left_out.end();
  table.add({"effects *", fixed(regression.forecasts->rmse_um, 2), known ? fixed(worst->second, 2) : "-",
             known ? files[worst->first].stem().string() : "-", fixed(regression.rmse_um, 2)});
  return table;
}

std::vector<Series> runs_of(const TrainEffectsOptions& options, const std::vector<std::filesystem::path>& files) {
  std::vector<Series> runs;
  if (files.empty()) {
    ModelData opened = open_drift(options.data, options.max_gap_s);
    expect_no_input({options.out}, opened.files);
    for (const std::string& name : options.without_sensor) {
      if (find_column(*opened.series, name) != nullptr) continue;
      throw Error(fmt::format("--without-sensor {}: expected a column of {}, found none of that name.", name,
                              options.data.name()));
    }
    runs.push_back(*opened.series);
  }
  for (const std::filesystem::path& file : files) runs.push_back(read_batch(file));
  for (Series& run : runs) {
    std::erase_if(run.columns, [&](const Column& column) {
      return std::find(options.without_sensor.begin(), options.without_sensor.end(), column.name) !=
             options.without_sensor.end();
    });
  }
  return runs;
}

}  // namespace

bool is_run_list(const Source& source) {
  if (source.series() || (source.is_path() && std::filesystem::is_directory(source.path()))) return false;
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

void train_effects(const TrainEffectsOptions& options, const std::vector<std::filesystem::path>& files,
                   const std::vector<OtherMethod>& others, const std::vector<std::string>& remarks) {
  const std::vector<Series> runs = runs_of(options, files);
  EffectRegressionOptions how;
  how.few = options.few;
  how.progress = [](const std::string& what) { show_progress(what); };
  const TrainedRegression trained = [&] {
    const ProgressLine progress;
    return with_source(options.data.name(), [&] { return trained_regression(runs, options.target, how); });
  }();
  const EffectRegression& of = trained.regression;
  const bool is_model = !of.model.terms.empty();
  if (is_model) write_bytes(options.out, write_effect_regression(of));
  std::vector<std::string> said = remarks_of(trained.drivers);
  if (!of.left_out.empty()) {
    said.push_back(fmt::format("Not used, for they stand still or have gaps: {}.", fmt::join(of.left_out, ", ")));
  }
  said.insert(said.end(), remarks.begin(), remarks.end());
  if (options.json) {
    TrainedOnEffects result{of, std::nullopt, trained.drivers, others, said, expectation(of)};
    if (of.forecasts) result.forecasts = {*of.forecasts, is_predicted(of)};
    print_json(json_of(result));
  } else {
    fmt::print("{}\n{} from {} columns by {}; {} rows{}\n\n", options.data.name(), options.target,
               of.model.trained.size(), dictionary_text(of), of.rows,
               of.runs > 1 ? fmt::format(" of {} runs", of.runs) : "");
    fmt::print("{}{}\n", wrapped(expectation(of)), wrapped(memory_text(of)));
    if (!others.empty() && of.forecasts) {
      fmt::print("{}{}\n", contest(trained, others, files).text(table_width()),
                 wrapped("* is written. left out: RMSE where each batch in turn is predicted by all the others; the "
                         "settings are chosen by it, so that it is a little too good."));
    }
    fmt::print("{}{}", driver_table(trained.drivers).text(table_width()),
               wrapped(fmt::format("share: of {:.2f} um, the range of what is predicted. parts left out: least and "
                                   "largest in {} refits, each without a part of the record.",
                                   trained.drivers.range_um, trained.drivers.refits)));
    if (!said.empty()) fmt::print("\n");
    for (const std::string& remark : said) fmt::print("{}", wrapped(remark));
  }
  if (is_model) {
    wrote_line(options.out);
  } else {
    stderr_line("no effect is likelier than none, nothing written");
  }
}

}  // namespace ballbar
