// Measured batches, each in turn the job at hand: what weights by likeness to it are worth.
//
//   study_batches RUNS.csv ROOM_COLUMN TARGET...
//
// For every method and kind of inputs the RMSE of prediction, over the batches each left out: by all the others, and by
// weights; how often weights do better, and the mean of the logarithm of the ratio, so that a batch counts as much as
// another. "cover" is the share of readings within the 95 % interval of the model of weights. Fails where the weighted
// model is worse than all batches by more than a tenth, over all of them.
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "ballbar/error.hpp"
#include "ballbar/formats/models/runs_csv.hpp"
#include "ballbar/formats/series/series_csv.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "ballbar/internal/predict/batch_weights.hpp"

namespace {

using namespace ballbar;

struct Ways {
  std::vector<double> all, weights, covered;
};

Ways ways_of(const std::vector<Series>& series, const BatchColumns& columns, const std::vector<Batch>& batches,
             RegressionMethod method) {
  Ways ways;
  for (std::size_t job = 0; job < batches.size(); ++job) {
    std::vector<Batch> others = batches;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(job));
    const BatchWeights found = batch_weights(others, batches[job].start, method);
    const auto um = [&](const std::vector<double>& weight, const RegressionSettings& settings) {
      return rmse_um(batches[job].moments, regress(merged(others, weight), settings));
    };
    ways.all.push_back(um({}, best_settings(others, method)));
    ways.weights.push_back(um(found.weight, found.settings));
    const TemperatureRegression model = temperature_regression(
        others, found.weight, columns, found.settings, [&](std::size_t k) { return series[k < job ? k : k + 1]; });
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
    fmt::print("{:17} {:>6}   {:^17}   {:>6}\n", "", "all", "weights", "cover");
    for (const InputKind kind : {InputKind::temperature, InputKind::rise, InputKind::both}) {
      BatchColumns columns = batch_columns(series.front(), kind, argv[t], argv[2]);
      std::vector<Batch> batches;
      for (std::size_t k = 0; k < series.size(); ++k) {
        batches.push_back(batch_of(list.runs[k].name, series[k], columns));
      }
      std::vector<std::string> broken;
      for (const BrokenSensor& sensor : broken_sensors(batches, columns)) broken.push_back(sensor.sensor);
      leave_out_sensors(batches, columns, broken);
      for (const RegressionMethod method : kRegressionMethods) {
        const Ways ways = ways_of(series, columns, batches, method);
        fmt::print("{:11} {:5} {:6.2f}   {}   {:5.1f}%\n", name_of(kind), name_of(method), mean(ways.all),
                   way_text(ways.weights, ways.all), 100.0 * mean(ways.covered));
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
