// Simulates planned tests for possible truths and diagnoses the results.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <random>
#include <vector>

#include "ballbar/diagnosis/next_test/plan.hpp"
#include "diagnosis/next_test/planned_inputs.hpp"
#include "diagnosis/next_test/truths.hpp"

namespace ballbar {

// What tests are simulated with.
struct TestDesign {
  const TestPlanOptions& options;
  const Model& model;  // without the terms of the set-up
  const Series& data;
  std::size_t target = 0;
  const std::vector<BoundEffect>& named;  // by the data at hand
  const Inference& found;                 // from them
  PossibleSets& sets;
  PlannedInputs inputs;
  std::vector<Covariance> covariances;  // for which a run is diagnosed
};

// The random numbers of one purpose.
std::mt19937_64 random_of(const TestPlanOptions& options, std::uint64_t purpose);

// Options of the diagnoses in a design: nothing that only a reader needs.
DiagnosisOptions diagnosis_options(const TestPlanOptions& options);

// The likely covariances, and a few with a slow curve, so that a simulated run can detect one.
std::vector<Covariance> simulated_covariances(const Inference& inference);

// The test with the outcome of a full diagnosis for each truth. done: called with the number of finished ones, in the
// calling thread.
ExpectedTest expected_test(const TestDesign& design, ExpectedTest test, const std::vector<Truth>& truths,
                           const std::function<void(std::size_t)>& done);

// P(right) of the run alone, with an additional thermometer where the first effect of the set heats. The thermometer
// shows that heat whether or not it causes a drift. Naming an effect of its column counts as naming that effect.
double p_right_with_sensor(const TestDesign& design, const Schedule& schedule, const PossibleSet& set,
                           const std::vector<Truth>& truths);

}  // namespace ballbar
