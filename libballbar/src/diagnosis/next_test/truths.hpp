// Possible truths drawn from a posterior, and the readings of a test for each of them.
#pragma once

#include <cstddef>
#include <map>
#include <random>
#include <vector>

#include "diagnosis/posterior/inference.hpp"
#include "diagnosis/verdict/fitted_set.hpp"

namespace ballbar {

// A set of the posterior at its most likely parameters.
struct PossibleSet {
  const Problem* problem = nullptr;
  std::vector<BoundEffect> effects;
  bool has_other_value = false;  // of a parameter that the model holds
  FittedSet fitted;
  Covariance noise, slow;  // without and with a slow curve
  double variance = 0.0;
};

struct Truth {
  const PossibleSet* set = nullptr;
  bool slow = false;  // with a slow curve without a cause
};

// Fits the sets of a posterior, each once. It must outlive the truths.
class PossibleSets {
 public:
  // Keeps a reference.
  explicit PossibleSets(const Inference& inference) : inference_(inference) {}

  const PossibleSet& at(std::size_t set);

  // Truths with frequencies as close to the weights of the posterior as their number allows.
  std::vector<Truth> drawn(std::size_t count, std::mt19937_64 random);

 private:
  const Inference& inference_;
  std::map<std::size_t, PossibleSet> fitted_;
};

bool is_nothing(const Truth& truth);  // no effect, no wrong held value, no slow curve

// The terms of the model, then those of the effects, on the rows of one run. slopes: derivatives by all parameters.
Eigen::MatrixXd terms_um(const PossibleSet& set, const Series& run, Eigen::MatrixXd* slopes = nullptr);

// Their sum, without noise and without effects of the set-up.
Eigen::VectorXd drift_um(const PossibleSet& set, const Series& run);

// The readings with noise, rounded like the target.
std::vector<double> readings_um(const Truth& truth, const Series& run, double resolution_um, std::mt19937_64& random);

}  // namespace ballbar
