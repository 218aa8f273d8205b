#include "diagnosis/next_test/simulated_tests.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <thread>
#include <utility>

#include "ballbar/diagnosis/thresholds.hpp"
#include "ballbar/error.hpp"
#include "ballbar/model/run_terms.hpp"
#include "ballbar/numerics/parallel.hpp"
#include "ballbar/series/runs.hpp"
#include "diagnosis/verdict/diagnosis_at.hpp"
#include "noise/discrepancy_grid.hpp"
#include "numerics/random_streams.hpp"
#include "series/resolution.hpp"

namespace ballbar {
namespace {

constexpr const char* kAddedSensor = "T_added_degC";
constexpr std::size_t kSlowStride = 3;       // use one in so many covariances with a slow curve
constexpr std::size_t kMostCovariances = 8;  // likely ones
constexpr double kPriorOfSlow = 0.25;
constexpr std::size_t kRowsSimulated = 500;  // of the target in each diagnosis

// Without the terms of the set-up of the data at hand.
Model of_a_drift(const Model& model, const Series& data) {
  if (model.level == Level::series) return without_run_terms(model);
  throw Error(
      fmt::format("expected a drift series to plan a run for, found recordings of {} readings.", data.time_s.size()));
}

// The rows of a run behind those of the data, columns by their names.
Series with_run(const Series& data, const Series& run) {
  Series all = data;
  const double begin_s = data.time_s.empty() ? 0.0 : data.time_s.front();
  if (runs_of(data.time_s).size() < 2) {
    for (double& time_s : all.time_s) time_s -= begin_s;
    all.runs = {{"data", RunStart::rest}};
  }
  all.time_s.insert(all.time_s.end(), run.time_s.begin(), run.time_s.end());
  for (Column& column : all.columns) {
    const std::vector<double>& values = find_column(run, column.name)->values;
    column.values.insert(column.values.end(), values.begin(), values.end());
  }
  all.runs.push_back({"test", RunStart::rest});
  return all;
}

// 5 K from its least to its largest, read to 0.1 K.
std::vector<double> thermometer(const Eigen::VectorXd& heat, std::mt19937_64& random) {
  const double low = heat.minCoeff(), range = std::max(1e-12, heat.maxCoeff() - low);
  std::vector<double> values;
  values.reserve(static_cast<std::size_t>(heat.size()));
  for (const double one : heat) {
    const double kelvin = 5.0 * (one - low) / range + 0.03 * simulation::normal(random);
    values.push_back(0.1 * std::round(10.0 * (20.0 + kelvin)));
  }
  return values;
}

}  // namespace

SimulatedTests::SimulatedTests(const Model& model, const Series& data, std::size_t target,
                               const TestPlanOptions& options)
    : model_(of_a_drift(model, data)),
      options_(options),
      data_(data),
      target_(model.targets.at(target)),
      target_index_(target) {
  ProblemOptions how;
  how.search.catalogue = options.search.catalogue;
  how.search.without = options.search.without;
  tell("weighing the data at hand");
  inference_ = inference(with_run_terms(model_, data_), data_, target, how);
  if (inference_.largest == 0 || inference_.is_still) return;
  truths_.emplace(inference_);
  planned_ = std::make_unique<PlannedInputs>(data_, target_);
  resolution_um_ = resolution_of(find_column(data_, target_)->values);
  covariances_ = simulated_covariances();
}

std::vector<Truth> SimulatedTests::drawn(std::size_t count, std::uint64_t stage) const {
  std::mt19937_64 random = simulation::stream_of(options_.seed, simulation::Stream::signal, 100 + stage);
  return truths_->drawn(count, random);
}

ExpectedTest SimulatedTests::expected(ExpectedTest test, const std::vector<Truth>& truths,
                                      const std::function<void(std::size_t)>& done) const {
  std::vector<Score> outcomes(truths.size());
  std::atomic<std::size_t> ended = 0;
  const std::thread::id caller = std::this_thread::get_id();
  in_parallel(truths.size(), [&](std::size_t k) {
    std::mt19937_64 random = simulation::stream_of(options_.seed, simulation::Stream::signal, 1000 + k);
    outcomes[k] = score_under(test.schedule, truths[k], random);
    ++ended;
    if (std::this_thread::get_id() == caller) done(ended);
  });
  test.truths = truths.size();
  const auto n = static_cast<double>(truths.size());
  for (const Score& one : outcomes) {
    test.p_right += one.right ? 1.0 / n : 0.0;
    test.p_part += one.part ? 1.0 / n : 0.0;
    test.p_wrong += one.wrong ? 1.0 / n : 0.0;
  }
  // Sigma of Laplace's estimate, so that 24 of 24 is not certain.
  const double p = (test.p_right * n + 1.0) / (n + 2.0);
  test.p_right_sigma = std::sqrt(p * (1.0 - p) / (n + 3.0));
  return test;
}

double SimulatedTests::p_right_with_sensor(const Schedule& schedule, std::size_t set,
                                           const std::vector<Truth>& truths) const {
  const std::vector<BoundEffect> place = truths_->effects_of({set, false});
  static_cast<void>(truths_->sigma_um({set, false}));  // fitted before the threads ask for it
  std::vector<char> right(truths.size(), 0);
  in_parallel(truths.size(), [&](std::size_t k) {
    std::mt19937_64 random = simulation::stream_of(options_.seed, simulation::Stream::signal, 1000 + k);
    Series run = simulated(schedule, truths[k], random);
    run.columns.push_back(
        {kAddedSensor, Role::structure, thermometer(truths_->member_um({set, false}, 0, run), random)});
    try {
      Diagnosis found = diagnosis_with(model_, run);
      for (BoundEffect& one : found.named) {
        if (one.columns.size() == 1 && one.columns.front() == kAddedSensor) one = place.front();
      }
      right[k] = score_of(truths[k], found, {}).right ? 1 : 0;
    } catch (const Error&) {
      right[k] = 0;
    }
  });
  return static_cast<double>(std::count(right.begin(), right.end(), 1)) / static_cast<double>(truths.size());
}

void SimulatedTests::tell(const std::string& step) const {
  if (options_.search.progress) options_.search.progress(step);
}

Series SimulatedTests::simulated(const Schedule& schedule, const Truth& truth, std::mt19937_64& random) const {
  Series run = planned_->under(schedule, random);
  run.columns.push_back({target_, Role::measured, truths_->readings_um(truth, run, resolution_um_, random)});
  return run;
}

// The likely covariances, and a few with a slow curve, so that a simulated run can detect one.
std::vector<Covariance> SimulatedTests::simulated_covariances() const {
  std::vector<Covariance> chosen;
  for (const Point& point : inference_.posterior.points) {
    if (chosen.size() < kMostCovariances) chosen.push_back(point.covariance);
  }
  std::size_t slow = 0;
  for (const Covariance& one : with_discrepancy(chosen.front(), inference_.problem->time_s)) {
    if (slow++ % kSlowStride == 0 && std::find(chosen.begin(), chosen.end(), one) == chosen.end())
      chosen.push_back(one);
  }
  // Renormalises the weights of the remaining ones, without and with a slow curve.
  double without = 0.0, with = 0.0;
  for (const Covariance& one : chosen) (one.slow > 0.0 ? with : without) += 1.0;
  for (Covariance& one : chosen) {
    one.log_prior = std::log(one.slow > 0.0 ? kPriorOfSlow / with : (1.0 - kPriorOfSlow) / without);
  }
  return chosen;
}

DiagnosisOptions SimulatedTests::simulated_options() const {
  DiagnosisOptions how;
  how.search = options_.search;
  how.search.progress = {};
  how.most_rows = kRowsSimulated;
  how.fit_candidates = how.leave_out = false;
  return how;
}

// What needs nothing but time is never named: a truth is told where all the rest of it is.
// Of nothing that nothing is said, of a value that the model holds that it is told.
SimulatedTests::Score SimulatedTests::score_of(const Truth& truth, const Diagnosis& found,
                                               const std::vector<BoundEffect>& known) const {
  const auto is_in = [](const std::vector<BoundEffect>& all, const BoundEffect& one) {
    return std::find(all.begin(), all.end(), one) != all.end();
  };
  const std::vector<BoundEffect> effects = truths_->effects_of(truth);
  Score score;
  bool more = false;
  for (const BoundEffect& named : found.named) {
    score.wrong = score.wrong || !is_in(effects, named);
    more = more || !is_in(known, named);
  }
  const bool own = std::any_of(found.own.begin(), found.own.end(), [](const OwnValue& one) { return one.p >= kNamed; });
  const bool all = std::all_of(effects.begin(), effects.end(), [&](const BoundEffect& one) {
    return one.effect->time_only || is_in(found.named, one);
  });
  const bool verdict_fits =
      truths_->is_nothing(truth) ? found.verdict == Verdict::nothing : own == truths_->has_other_value(truth);
  score.right = !score.wrong && all && verdict_fits;
  score.part = !score.wrong && !truths_->is_nothing(truth) && (score.right || more);
  return score;
}

Diagnosis SimulatedTests::diagnosis_with(const Model& model, const Series& data) const {
  const DiagnosisOptions how = simulated_options();
  Inference found = inference_of(model, data, target_index_, how, {}, covariances_);
  return diagnosis_of(found, model, data, target_index_, how);
}

SimulatedTests::Score SimulatedTests::score_under(const Schedule& schedule, const Truth& truth,
                                                  std::mt19937_64& random) const {
  const Series all = with_run(data_, simulated(schedule, truth, random));
  try {
    const Diagnosis found = diagnosis_with(with_run_terms(model_, all), all);
    return score_of(truth, found, named_now_);
  } catch (const Error&) {
    return {};  // a failed diagnosis decides nothing
  }
}

}  // namespace ballbar
