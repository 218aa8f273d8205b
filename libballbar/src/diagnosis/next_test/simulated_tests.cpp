#include "diagnosis/next_test/simulated_tests.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <thread>
#include <utility>

#include "ballbar/diagnosis/signatures/search.hpp"
#include "ballbar/error.hpp"
#include "ballbar/internal/model/run_terms.hpp"
#include "ballbar/internal/numerics/parallel.hpp"
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

struct Score {
  bool right = false, part = false, wrong = false;
};

// A truth is found if all its effects are named, but those of time alone, which are never named; if nothing is missing,
// the verdict must be that; a wrong value that the model holds must be named.
Score score_of(const Truth& truth, const Diagnosis& found, const std::vector<BoundEffect>& known) {
  const auto is_in = [](const std::vector<BoundEffect>& all, const BoundEffect& one) {
    return std::find(all.begin(), all.end(), one) != all.end();
  };
  const std::vector<BoundEffect>& effects = truth.set->effects;
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
  const bool verdict_fits = is_nothing(truth) ? found.verdict == Verdict::nothing : own == truth.set->has_other_value;
  score.right = !score.wrong && all && verdict_fits;
  score.part = !score.wrong && !is_nothing(truth) && (score.right || more);
  return score;
}

Diagnosis diagnosis_with(const TestDesign& design, const Series& data) {
  DiagnosisOptions how = diagnosis_options(design.options);
  how.most_rows = kRowsSimulated;
  const Model model = with_run_terms(design.model, data);
  Inference found = inference_of(model, data, design.target, how, {}, design.covariances);
  return diagnosis_of(found, model, data, design.target, how);
}

// sensed: an effect whose heat a thermometer shows; the run is then diagnosed alone.
std::vector<Score> scores_of(const TestDesign& design, const Schedule& schedule, const std::vector<Truth>& truths,
                             const std::function<void(std::size_t)>& done, const PossibleSet* sensed = nullptr) {
  const Column& target = *find_column(design.data, design.model.targets[design.target]);
  const double resolution_um = resolution_of(target.values);
  std::vector<Score> scores(truths.size());
  std::atomic<std::size_t> ended = 0;
  const std::thread::id caller = std::this_thread::get_id();
  in_parallel(truths.size(), [&](std::size_t k) {
    std::mt19937_64 random = random_of(design.options, 1000 + k);
    Series run = inputs_under(schedule, design.inputs, random);
    run.columns.push_back({target.name, Role::measured, readings_um(truths[k], run, resolution_um, random)});
    if (sensed != nullptr) {
      const auto member = static_cast<Eigen::Index>(sensed->problem->model.terms.size());
      run.columns.push_back({kAddedSensor, Role::structure, thermometer(terms_um(*sensed, run).col(member), random)});
    }
    try {
      Diagnosis found = diagnosis_with(design, sensed != nullptr ? run : with_run(design.data, run));
      for (BoundEffect& one : found.named) {
        if (sensed != nullptr && one.columns == std::vector<std::string>{kAddedSensor}) one = sensed->effects.front();
      }
      scores[k] = score_of(truths[k], found, design.named);
    } catch (const Error&) {  // a failed diagnosis decides nothing
    }
    ++ended;
    if (std::this_thread::get_id() == caller) done(ended);
  });
  return scores;
}

}  // namespace

std::mt19937_64 random_of(const TestPlanOptions& options, std::uint64_t purpose) {
  return simulation::stream_of(options.seed, simulation::Stream::signal, purpose);
}

DiagnosisOptions diagnosis_options(const TestPlanOptions& options) {
  DiagnosisOptions how;
  how.search = options.search;
  how.search.progress = {};
  how.fit_candidates = how.leave_out = false;
  return how;
}

std::vector<Covariance> simulated_covariances(const Inference& inference) {
  std::vector<Covariance> chosen;
  for (const NoiseFilter& filter : inference.posterior.filters) {
    if (chosen.size() < kMostCovariances) chosen.push_back(filter.covariance);
  }
  std::size_t slow = 0;
  for (const Covariance& one : with_discrepancy(chosen.front(), inference.problem->time_s)) {
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

ExpectedTest expected_test(const TestDesign& design, ExpectedTest test, const std::vector<Truth>& truths,
                           const std::function<void(std::size_t)>& done) {
  const auto n = static_cast<double>(truths.size());
  test.truths = truths.size();
  test.p_right = test.p_part = test.p_wrong = 0.0;
  for (const Score& one : scores_of(design, test.schedule, truths, done)) {
    test.p_right += one.right ? 1.0 / n : 0.0;
    test.p_part += one.part ? 1.0 / n : 0.0;
    test.p_wrong += one.wrong ? 1.0 / n : 0.0;
  }
  // Sigma of Laplace's estimate, so that 24 of 24 is not certain.
  const double p = (test.p_right * n + 1.0) / (n + 2.0);
  test.p_right_sigma = std::sqrt(p * (1.0 - p) / (n + 3.0));
  return test;
}

double p_right_with_sensor(const TestDesign& design, const Schedule& schedule, const PossibleSet& set,
                           const std::vector<Truth>& truths) {
  const std::vector<Score> scores = scores_of(
      design, schedule, truths, [](std::size_t) {}, &set);
  const auto right = std::count_if(scores.begin(), scores.end(), [](const Score& one) { return one.right; });
  return static_cast<double>(right) / static_cast<double>(truths.size());
}

}  // namespace ballbar
