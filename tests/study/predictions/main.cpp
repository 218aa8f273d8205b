// Predictions of an effect regression for spindles whose physics is no effect of the catalogue.
//
//   study_predictions [SPINDLES]        24 unless given; every spindle has another build, duty and noise
//
// Trained on 8 h of random steps of speed, 6 h of others are predicted (made.hpp). Printed of each, root of the mean
// square of the errors on the unseen duty cycle:
//   regression   effect_regression
//   causes       least squares on the causes that the simulation adds up: about the noise, and no sensor shows them
//   sensors      least squares on the logged temperatures as they were, without noise or rounding, and on n^2, whose
//                growth is at once
//   within       share of unseen readings within the interval of 95 %
// and for targets that are random walks beside the same columns whether forecasts say that to hold the last value is as
// good: their RMSE over that of holding. Fails (exit 1) where a figure leaves the range stated in its row.
#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "ballbar/predict/train.hpp"
#include "made.hpp"

namespace {

using namespace ballbar;

Eigen::VectorXd column(const Series& series, const std::string& name) {
  const std::vector<double>& values = find_column(series, name)->values;
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

double rms(const Eigen::VectorXd& errors) {
  return std::sqrt(errors.squaredNorm() / static_cast<double>(errors.size()));
}

// Of the causes whose names go on from the target's axis: z_shaft_um ...
Eigen::MatrixXd causes(const predictions::Duty& duty, const std::string& target) {
  Eigen::MatrixXd columns = Eigen::MatrixXd::Ones(static_cast<Eigen::Index>(duty.truth.time_s.size()), 1);
  for (const Column& one : duty.truth.columns) {
    if (one.role != Role::measured || one.name == target || one.name.front() != target.front()) continue;
    columns.conservativeResize(Eigen::NoChange, columns.cols() + 1);
    columns.rightCols(1) = column(duty.truth, one.name);
  }
  return columns;
}

// Changes since the start, as the drift is one.
Eigen::MatrixXd sensors(const predictions::Duty& duty, const std::string&) {
  Eigen::MatrixXd columns = Eigen::MatrixXd::Ones(static_cast<Eigen::Index>(duty.truth.time_s.size()), 1);
  for (const Column& one : duty.truth.columns) {
    if (unit_of(one.name) != "degC" && one.role != Role::speed) continue;
    const Eigen::VectorXd values = column(duty.truth, one.name);
    columns.conservativeResize(Eigen::NoChange, columns.cols() + 1);
    columns.rightCols(1) = one.role == Role::speed ? Eigen::VectorXd((values.array() / 1000.0).square())
                                                   : Eigen::VectorXd(values.array() - values[0]);
  }
  return columns;
}

template <class Terms>
double least_squares_um(const predictions::Made& made, Terms terms) {
  const Eigen::VectorXd gains = terms(made.training, made.target)
                                    .completeOrthogonalDecomposition()
                                    .solve(column(made.training.logged, made.target));
  return rms(column(made.unseen.logged, made.target) - terms(made.unseen, made.target) * gains);
}

double quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1) + 0.5)];
}

bool is_asked(const std::string& what, double value, double low, double high) {
  const bool is_within = value >= low && value <= high;
  fmt::print("{:46} {:8.3f}   {:.2f} to {:.2f}{}\n", what, value, low, high, is_within ? "" : "   FAILED");
  return is_within;
}

void print_quantiles(const std::string& what, const std::vector<double>& values) {
  fmt::print("{:20}", what);
  for (const double share : {0.0, 0.1, 0.25, 0.5, 0.75, 0.9, 1.0}) fmt::print(" {:7.2f}", quantile(values, share));
  fmt::print("\n");
}

}  // namespace

int main(int argc, char** argv) {
  const std::uint64_t count = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 24;
  if (count == 0) {
    fmt::print(stderr, "study_predictions: expected how many spindles, found {}.\n", argv[1]);
    return 2;
  }
  const auto start = std::chrono::steady_clock::now();
  std::vector<double> of_causes, of_sensors, shares, of_held, of_walk_held;
  double within = 0.0, readings = 0.0;
  fmt::print("          range  regression  causes  sensors  within  memory scale  forecasts  dictionary\n");
  for (std::uint64_t seed = 1; seed <= count; ++seed) {
    const predictions::Made made = predictions::made(seed);
    const EffectRegression regression = effect_regression({&made.training.logged, 1}, made.target);
    const RegressionPrediction prediction = predict(regression, made.unseen.logged);
    const Eigen::VectorXd measured = column(made.unseen.logged, made.target);
    const auto n = measured.size();
    const Eigen::VectorXd errors = measured - Eigen::Map<const Eigen::VectorXd>(prediction.predicted_um.data(), n);
    const auto inside =
        (errors.array().abs() <= Eigen::Map<const Eigen::ArrayXd>(prediction.half_width_um.data(), n)).count();
    const double rmse_um = rms(errors), causes_um = least_squares_um(made, causes),
                 sensors_um = least_squares_um(made, sensors);
    of_causes.push_back(rmse_um / causes_um);
    of_sensors.push_back(rmse_um / sensors_um);
    of_held.push_back(regression.forecasts->rmse_um / regression.forecasts->held_um);
    shares.push_back(static_cast<double>(inside) / static_cast<double>(n));
    within += static_cast<double>(inside);
    readings += static_cast<double>(n);
    fmt::print("{:2} {} {}{}  {:5.1f}  {:10.2f}  {:6.2f}  {:7.2f}  {:5.1f}%  {:6.0f} {:5.2f}  {:9.2f}  {}\n", seed,
               made.target, made.rounded ? 'r' : ' ', made.discrepant ? 'd' : ' ',
               measured.maxCoeff() - measured.minCoeff(), rmse_um, causes_um, sensors_um, 100.0 * shares.back(),
               regression.length_s, regression.interval_scale, regression.forecasts->rmse_um,
               dictionary_text(regression));
    std::fflush(stdout);
    const Series walk = predictions::random_walk(made, seed);
    const Forecasts of_walk = *effect_regression({&walk, 1}, made.target).forecasts;
    of_walk_held.push_back(of_walk.rmse_um / of_walk.held_um);
  }
  fmt::print("\n{:20}     min     10%     25%  median     75%     90%     max\n", "");
  print_quantiles("over causes", of_causes);
  print_quantiles("over sensors", of_sensors);
  print_quantiles("share within", shares);
  print_quantiles("over held", of_held);
  print_quantiles("over held, walks", of_walk_held);
  fmt::print("\n{:46} {:>8}   asked\n", "", "found");
  bool succeeds = is_asked("median of regression over sensors", quantile(of_sensors, 0.5), 0.0, 1.3);
  succeeds = is_asked("unseen readings within 95 %", within / readings, 0.90, 0.98) && succeeds;
  const auto held = [&](double share) {
    const auto others = std::count_if(of_walk_held.begin(), of_walk_held.end(), [&](double of) { return of >= share; });
    return static_cast<double>(others) / static_cast<double>(count);
  };
  // Three origins of one record: below 0.95 by chance in a third of cases, below 2/3 in a tenth. Less two standard
  // deviations of a share of so few.
  const auto least = [&](double share) {
    return share - 2.0 * std::sqrt(share * (1.0 - share) / static_cast<double>(count));
  };
  succeeds = is_asked("random walks: over held from 2/3 on", held(2.0 / 3.0), least(0.9), 1.0) && succeeds;
  succeeds = is_asked("random walks: over held from 0.95 on", held(0.95), least(2.0 / 3.0), 1.0) && succeeds;
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
  fmt::print("{:.0f} s\n", taken.count());
  return succeeds ? 0 : 1;
}
