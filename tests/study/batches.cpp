// Measured batches, each in turn the job at hand: what choosing among the others is worth.
//
//   study_batches RUNS.csv ROOM_COLUMN TARGET...
//
// For every method and kind of inputs the RMSE of prediction, over the batches each left out: by all the others, the
// paper's rule, the number that is best for batches like the job, weights by likeness, and the median of 100 random
// choices as large as the paper's; how often each does better than all, and the mean of the logarithm of the ratio, so
// that a batch counts as much as another. "cover" is the share of readings within the 95 % interval of the model of
// weights; random worse: the share of random choices that do worse than the paper's rule, where it chooses. Fails where
// the weighted model is worse than all batches by more than a tenth, over all of them.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <string>
#include <vector>

#include "ballbar/error.hpp"
#include "ballbar/formats/models/runs_csv.hpp"
#include "ballbar/formats/series/series_csv.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "ballbar/predict/batch_choice.hpp"

namespace {

using namespace ballbar;

struct Ways {
  std::vector<double> all, paper, held_out, weights, random, random_worse, covered;
  std::size_t chosen = 0;  // times that the paper's rule finds a fall
};

struct Setting {
  const char* label;
  RegressionMethod method;
  std::optional<double> share;
};

constexpr std::array kSettings{Setting{"pcr, 95 % explained", RegressionMethod::pcr, 0.95},
                               Setting{"pcr, 99 % explained", RegressionMethod::pcr, 0.99},
                               Setting{"pcr, 99.9 % explained", RegressionMethod::pcr, 0.999},
                               Setting{"pcr, left out", RegressionMethod::pcr, std::nullopt},
                               Setting{"ridge, left out", RegressionMethod::ridge, std::nullopt}};

Ways ways_of(const std::vector<Series>& series, const BatchColumns& columns, const std::vector<Batch>& batches,
             const Setting& setting) {
  Ways ways;
  for (std::size_t job = 0; job < batches.size(); ++job) {
    std::vector<Batch> others = batches;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(job));
    ChoiceOptions options;
    options.method = setting.method;
    options.share = setting.share;
    const BatchRanking found = batch_ranking(others, batches[job].start, &batches[job].moments, options);
    const auto um = [&](Take take) { return *found.choice(take).predicted_rmse_um; };
    ways.all.push_back(um(Take::all));
    ways.paper.push_back(um(Take::paper));
    ways.held_out.push_back(um(Take::held_out));
    ways.weights.push_back(um(Take::weights));
    if (found.paper_found) {
      const RandomChoices random =
          random_choices(others, batches[job].moments, found.choice(Take::paper), setting.share);
      ++ways.chosen;
      ways.random.push_back(random.predicted_rmse_um[random.predicted_rmse_um.size() / 2]);
      ways.random_worse.push_back(random.share_worse);
    } else {
      ways.random.push_back(um(Take::all));
    }
    const BatchChoice& weighed = found.choice(Take::weights);
    const TemperatureRegression model = temperature_regression(
        others, weighed.weights, columns, weighed.settings, [&](std::size_t k) { return series[k < job ? k : k + 1]; });
    const std::vector<double>& measured_um = find_column(series[job], columns.target)->values;
    ways.covered.push_back(error_of(predict(model, series[job]), measured_um)->within_share);
  }
  return ways;
}

double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return values.empty() ? 0.0 : sum / static_cast<double>(values.size());
}

// Percent by which `way` is below all batches: of the geometric mean ratio.
double less(const std::vector<double>& way, const std::vector<double>& all) {
  double sum = 0.0;
  for (std::size_t i = 0; i < way.size(); ++i) sum += std::log(way[i] / all[i]);
  return 100.0 * (1.0 - std::exp(sum / static_cast<double>(way.size())));
}

std::string way_text(const std::vector<double>& way, const std::vector<double>& all) {
  std::size_t wins = 0;
  for (std::size_t i = 0; i < way.size(); ++i) wins += way[i] < all[i] ? 1 : 0;
  return fmt::format("{:6.2f} {:5.0f} {:4}", mean(way), less(way, all), wins);
}

int run(int argc, char** argv) {
  const RunList list = open_runs(argv[1]);
  std::vector<Series> series;
  for (const ListedRun& run : list.runs) {
    series.push_back(read_series(read_bytes(run.file, kLargestTable), run.file.string()));
  }
  bool fine = true;
  for (int t = 3; t < argc; ++t) {
    fmt::print("{} of {} batches, mean RMSE um, percent less than by all batches (geometric mean), batches better\n",
               argv[t], series.size());
    fmt::print("{:34} {:>6}   {:^17}   {:^17}   {:^17}   {:^17}  {:>6} {:>6} {:>6}\n", "", "all", "fall of RMSE_m",
               "best for alike", "weights", "random", "found", "worse", "cover");
    for (const InputKind kind : {InputKind::temperature, InputKind::rise, InputKind::both}) {
      BatchColumns columns = batch_columns(series.front(), kind, argv[t], argv[2]);
      std::vector<Batch> batches;
      for (std::size_t k = 0; k < series.size(); ++k) {
        batches.push_back(batch_of(list.runs[k].name, series[k], columns));
      }
      std::vector<std::string> broken;
      for (const BrokenSensor& sensor : broken_sensors(batches, columns)) broken.push_back(sensor.sensor);
      FewerSensors kept = without_sensors(std::move(batches), columns, broken);
      for (const Setting& setting : kSettings) {
        const Ways ways = ways_of(series, kept.columns, kept.batches, setting);
        fmt::print("{:11} {:22} {:6.2f}   {}   {}   {}   {}  {:6} {:5.0f}% {:5.1f}%\n", name_of(kind), setting.label,
                   mean(ways.all), way_text(ways.paper, ways.all), way_text(ways.held_out, ways.all),
                   way_text(ways.weights, ways.all), way_text(ways.random, ways.all), ways.chosen,
                   100.0 * mean(ways.random_worse), 100.0 * mean(ways.covered));
        std::fflush(stdout);
        fine = fine && less(ways.weights, ways.all) > -10.0;
      }
    }
    fmt::print("\n");
  }
  return fine ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) {
    fmt::print(stderr, "study_batches RUNS.csv ROOM_COLUMN TARGET...\n");
    return 2;
  }
  try {
    return run(argc, argv);
  } catch (const Error& error) {
    fmt::print(stderr, "study_batches: {}\n", error.what());
    return 1;
  }
}
