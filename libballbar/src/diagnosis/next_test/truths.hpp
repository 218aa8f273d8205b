// What may be true, drawn from a posterior, and what would then be read in a test.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <random>
#include <vector>

#include "diagnosis/posterior/inference.hpp"
#include "diagnosis/verdict/fitted_set.hpp"

namespace ballbar {

struct Truth {
  std::size_t set = 0;  // of Posterior::sets
  bool slow = false;    // with a slow curve without a cause
};

class Truths {
 public:
  // Refers to it.
  explicit Truths(const Inference& inference);

  // Truths of about the posterior's weights, as even as so many can be.
  std::vector<Truth> drawn(std::size_t count, std::mt19937_64& random) const;

  std::vector<BoundEffect> effects_of(const Truth& truth) const;
  bool is_nothing(const Truth& truth) const;  // no effect, no other value of the model, no slow curve
  bool has_other_value(const Truth& truth) const { return inference_.posterior.sets[truth.set].own > 0; }

  // On the rows of one run, without noise; what is of a set-up left out.
  Eigen::VectorXd drift_um(const Truth& truth, const Series& run) const;

  // What one effect of the set adds, the model left out.
  Eigen::VectorXd member_um(const Truth& truth, std::size_t member, const Series& run) const;

  // By the parameters of the model about those of the set, n by its parameters: what the model can make of a curve.
  Eigen::MatrixXd model_slopes(const Truth& truth, const Series& run) const;

  // With noise, rounded as the target is.
  std::vector<double> readings_um(const Truth& truth, const Series& run, double resolution_um,
                                  std::mt19937_64& random) const;

  double sigma_um(const Truth& truth) const;  // of a reading

 private:
  struct Fitted {
    FittedSet set;
    Covariance noise, slow;
    double variance = 0.0;
  };
  const Fitted& fitted(std::size_t set) const;
  Series behind_the_data(const Series& run) const;
  Eigen::VectorXd added_um(const Truth& truth, const Series& run,
                           const std::function<bool(std::size_t)>& is_included) const;

  const Inference& inference_;
  mutable std::map<std::size_t, Fitted> fitted_;  // as they are asked for, before anything runs in parallel
};

}  // namespace ballbar
