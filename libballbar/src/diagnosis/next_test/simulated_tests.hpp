// Simulates planned tests for possible truths and diagnoses the results.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "ballbar/diagnosis/next_test/test_plan.hpp"
#include "diagnosis/next_test/planned_inputs.hpp"
#include "diagnosis/next_test/truths.hpp"

namespace ballbar {

class SimulatedTests {
 public:
  // Keeps references to data and options. Throws Error for recordings.
  SimulatedTests(const Model& model, const Series& data, std::size_t target, const TestPlanOptions& options);

  // What the data at hand already name.
  void know(const std::vector<BoundEffect>& named) { named_now_ = named; }

  bool can_draw() const { return truths_.has_value(); }  // required by the functions below
  const Posterior& posterior() const { return inference_.posterior; }
  const Truths& truths() const { return *truths_; }
  const PlannedInputs& planned() const { return *planned_; }

  // The same truths at each stage of a design.
  std::vector<Truth> drawn(std::size_t count, std::uint64_t stage) const;

  // A full diagnosis for each truth. done: called with the number of finished ones, in the calling thread.
  ExpectedTest expected(ExpectedTest test, const std::vector<Truth>& truths,
                        const std::function<void(std::size_t)>& done) const;

  // P(right) of the run alone, with an additional thermometer where the effect heats. The thermometer shows that heat
  // whether or not it causes a drift. Naming an effect of its column counts as naming that effect.
  double p_right_with_sensor(const Schedule& schedule, std::size_t set, const std::vector<Truth>& truths) const;

  void tell(const std::string& step) const;

 private:
  struct Score {
    bool right = false, part = false, wrong = false;
  };
  Score score_of(const Truth& truth, const Diagnosis& found, const std::vector<BoundEffect>& known) const;
  Diagnosis diagnosis_with(const Model& model, const Series& data) const;
  Score score_under(const Schedule& schedule, const Truth& truth, std::mt19937_64& random) const;
  Series simulated(const Schedule& schedule, const Truth& truth, std::mt19937_64& random) const;
  std::vector<Covariance> simulated_covariances() const;
  DiagnosisOptions simulated_options() const;

  Model model_;
  const TestPlanOptions& options_;
  const Series& data_;
  std::string target_;
  std::size_t target_index_;
  Inference inference_;
  std::optional<Truths> truths_;
  std::unique_ptr<PlannedInputs> planned_;
  double resolution_um_ = 0.0;
  std::vector<Covariance> covariances_;
  std::vector<BoundEffect> named_now_;
};

}  // namespace ballbar
