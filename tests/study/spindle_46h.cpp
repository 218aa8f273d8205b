// Measured drift: the models of sample-runs/spindle-46h beside a linear regression on all temperatures, each speed
// cycle (a speed and the rest after it) left out in turn and predicted.
//
//   study_spindle_46h SAMPLE_RUNS
//
// Prints the mean absolute error on what was left out. The last cycle runs at 5000 rpm, above every speed in training:
// there a regression extrapolates in all its columns, a physical model in the speed alone. Fails where a model leaves
// more than half of what the regression does on that cycle.
#include <fmt/format.h>

#include <Eigen/QR>
#include <cmath>
#include <filesystem>
#include <limits>

#include "ballbar/fit/fit.hpp"
#include "ballbar/formats/models/model_toml.hpp"
#include "ballbar/formats/sessions/data_file.hpp"
#include "ballbar/formats/text/file_bytes.hpp"

namespace {

using namespace ballbar;

struct Cycle {
  const char* name;
  double from_s, to_s;
};
constexpr Cycle kCycles[] = {{"1250 rpm", 465.0, 29250.0},
                             {"2500 rpm", 29265.0, 58050.0},
                             {"3750 rpm", 58065.0, 86850.0},
                             {"5000 rpm", 86865.0, 1e9}};

bool within(const Cycle& cycle, double time_s) { return time_s >= cycle.from_s && time_s <= cycle.to_s; }

Series without(const Series& data, const std::string& target, const Cycle& cycle) {
  Series rest = data;
  for (Column& column : rest.columns) {
    if (column.name != target) continue;
    for (std::size_t row = 0; row < rest.time_s.size(); ++row) {
      if (within(cycle, rest.time_s[row])) column.values[row] = std::numeric_limits<double>::quiet_NaN();
    }
  }
  return rest;
}

double mean_absolute_error(const Series& data, const std::string& target, const std::vector<double>& predicted,
                           const Cycle& cycle) {
  const std::vector<double>& measured = find_column(data, target)->values;
  double sum = 0.0;
  std::size_t n = 0;
  for (std::size_t row = 0; row < data.time_s.size(); ++row) {
    if (!within(cycle, data.time_s[row])) continue;
    sum += std::abs(measured[row] - predicted[row]);
    ++n;
  }
  return sum / static_cast<double>(n);
}

std::vector<double> regression(const Series& data, const std::string& target, const Cycle& cycle) {
  std::vector<const Column*> columns;
  for (const Column& column : data.columns) {
    if (unit_of(column.name) == "degC") columns.push_back(&column);
  }
  const auto n = static_cast<Eigen::Index>(data.time_s.size());
  Eigen::MatrixXd all = Eigen::MatrixXd::Ones(n, static_cast<Eigen::Index>(columns.size()) + 1);
  for (std::size_t k = 0; k < columns.size(); ++k) {
    all.col(static_cast<Eigen::Index>(k) + 1) = Eigen::VectorXd::Map(columns[k]->values.data(), n);
  }
  const std::vector<double>& measured = find_column(data, target)->values;
  Eigen::MatrixXd a = all;
  Eigen::VectorXd b = Eigen::VectorXd::Map(measured.data(), n);
  for (Eigen::Index i = 0; i < n; ++i) {
    if (!within(cycle, data.time_s[static_cast<std::size_t>(i)])) continue;
    a.row(i).setZero();
    b[i] = 0.0;
  }
  const Eigen::VectorXd predicted = all * a.colPivHouseholderQr().solve(b);
  return {predicted.data(), predicted.data() + n};
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) return 2;
  const std::filesystem::path folder = std::filesystem::path(argv[1]) / "spindle-46h";
  const Series data = *open_model_data({folder / "measured.csv"}, {}, 600.0).series;
  bool failed = false;
  fmt::print("mean absolute error um on the cycle left out: model (regression on 16 temperatures)\n{:<8}", "");
  for (const Cycle& cycle : kCycles) fmt::print("{:>18}", cycle.name);
  fmt::print("\n");
  for (const char* file : {"ch1-ch2.toml", "ch3-ch4.toml", "ch5.toml"}) {
    const Model model = read_model(read_bytes(folder / file, kLargestText), file);
    for (std::size_t target = 0; target < model.targets.size(); ++target) {
      const std::string& name = model.targets[target];
      fmt::print("{:<8}", name);
      for (const Cycle& cycle : kCycles) {
        const Fit fitted = fit(model, without(data, name, cycle), target);
        const double ours =
            mean_absolute_error(data, name, predict(model, fitted.parameters, data).predicted_um, cycle);
        const double theirs = mean_absolute_error(data, name, regression(data, name, cycle), cycle);
        fmt::print("{:>10.2f} ({:5.2f})", ours, theirs);
        if (cycle.to_s > 1e8) failed = failed || ours > 0.5 * theirs;
      }
      fmt::print("\n");
    }
  }
  return failed ? 1 : 0;
}
