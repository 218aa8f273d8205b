// A regression of other machines, adapted by one warm-up of a machine that it has not seen.
//
//   study_adaptation [SPINDLES] [LATHE]     6 spindles unless given; LATHE: the folder of measured runs of a lathe
//
// Of each machine in turn one run is left out and predicted. Printed, root of the mean square over machines:
//   own      trained on all its other runs
//   warm-up  trained on one of them alone
//   others   trained on the runs of the other machines, not adapted
//   adapted  the same, adapted by that one run: what it still borrows, and its error over that of `own`
// Spindles are made, of one build whose numbers differ by a fifth (made.hpp), each with 5 runs of 6 h. Of the lathe a
// machine is a condition of its chamber. Fails (exit 1) where `adapted over own` of the spindles leaves its range.
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "ballbar/formats/models/runs_csv.hpp"
#include "ballbar/formats/series/series_csv.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "ballbar/predict/train.hpp"
#include "made.hpp"

namespace {

using namespace ballbar;

struct Machine {
  std::string name;
  std::vector<Series> runs;
};

double rmse_um(const EffectRegression& regression, const Series& run, const std::string& target) {
  return error_of(predict(regression, run), find_column(run, target)->values)->rmse_um;
}

EffectRegression trained(const std::vector<Series>& runs, const std::string& target,
                         const EffectRegression* start = nullptr) {
  EffectRegressionOptions options;
  options.forecasts = false;
  options.start = start;
  return effect_regression(runs, target, options);
}

// Over machines.
struct Sums {
  double own = 0.0, warm_up = 0.0, others = 0.0, adapted = 0.0;
  double count = 0.0;
};

double adapted_over_own(const std::vector<Machine>& machines, const std::string& target) {
  Sums sums;
  fmt::print("{:24} {:>8} {:>8} {:>8} {:>8} {:>9}\n", target, "own", "warm-up", "others", "adapted", "borrowed");
  for (const Machine& machine : machines) {
    if (machine.runs.size() < 3) continue;
    std::vector<Series> fleet;
    for (const Machine& other : machines) {
      if (&other != &machine) fleet.insert(fleet.end(), other.runs.begin(), other.runs.end());
    }
    const Series& left_out = machine.runs.back();
    const std::vector<Series> rest(machine.runs.begin(), machine.runs.end() - 1);
    const EffectRegression of_others = trained(fleet, target);
    EffectRegressionOptions options;
    options.report = false;
    options.start = &of_others;
    const TrainedRegression adapted = trained_regression({&rest.front(), 1}, target, options);
    const double own = rmse_um(trained(rest, target), left_out, target),
                 warm_up = rmse_um(trained({rest.front()}, target), left_out, target),
                 others = rmse_um(of_others, left_out, target),
                 of_adapted = rmse_um(adapted.regression, left_out, target);
    sums.own += own * own;
    sums.warm_up += warm_up * warm_up;
    sums.others += others * others;
    sums.adapted += of_adapted * of_adapted;
    sums.count += 1.0;
    fmt::print("{:24} {:8.2f} {:8.2f} {:8.2f} {:8.2f} {:8.0f}%\n", machine.name, own, warm_up, others, of_adapted,
               100.0 * adapted.start->borrowed);
    std::fflush(stdout);
  }
  const auto root = [&](double sum) { return std::sqrt(sum / sums.count); };
  const double ratio = root(sums.adapted) / root(sums.own);
  fmt::print("{:24} {:8.2f} {:8.2f} {:8.2f} {:8.2f}   adapted over own {:.2f}\n\n", "all", root(sums.own),
             root(sums.warm_up), root(sums.others), root(sums.adapted), ratio);
  return ratio;
}

std::vector<Machine> spindles(std::size_t count, const std::string& target) {
  std::vector<Machine> machines;
  for (std::size_t m = 0; m < count; ++m)
    machines.push_back({fmt::format("spindle {}", m + 1), predictions::runs_of(100 + m, 5, 6.0, target)});
  return machines;
}

// A condition is what the name of the chamber says.
std::vector<Machine> lathe(const std::filesystem::path& folder) {
  std::map<std::string, Machine> of;
  const std::string list = read_bytes(folder / "runs.csv", kLargestText);
  std::map<std::string, std::string> chamber;
  for (std::size_t at = 0; at < list.size();) {
    const std::size_t end = std::min(list.find('\n', at), list.size());
    const std::string line = list.substr(at, end - at);
    const std::size_t comma = line.find(','), second = line.find(',', comma + 1);
    if (line.front() != '#' && second != std::string::npos)
      chamber[line.substr(0, comma)] = line.substr(comma + 1, second - comma - 1);
    at = end + 1;
  }
  for (const ListedRun& run : open_runs(folder / "runs.csv").runs) {
    Machine& machine = of[chamber[run.name]];
    machine.name = chamber[run.name] + " degC";
    machine.runs.push_back(read_series(read_bytes(run.file, kLargestTable), run.name));
    std::erase_if(machine.runs.back().columns, [](const Column& column) { return column.name == "PT10_degC"; });
  }
  std::vector<Machine> machines;
  for (auto& [name, machine] : of) machines.push_back(std::move(machine));
  return machines;
}

}  // namespace

int main(int argc, char** argv) {
  const std::size_t count = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 6;
  if (count < 2) {
    fmt::print(stderr, "study_adaptation: expected how many spindles, 2 or more, found {}.\n", argv[1]);
    return 2;
  }
  bool succeeds = true;
  for (const char* const target : {"x_um", "z_um"}) {
    const double ratio = adapted_over_own(spindles(count, target), target);
    if (ratio > 1.15) {
      fmt::print("adapted over own: {:.2f}, expected 1.15 or less   FAILED\n", ratio);
      succeeds = false;
    }
  }
  if (argc > 2) {
    for (const char* const target : {"x_um", "z_um"}) adapted_over_own(lathe(argv[2]), target);
  }
  return succeeds ? 0 : 1;
}
