// Possible truths drawn from a posterior, and the readings of a test for each of them.
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
  std::size_t set = 0;  // index into Posterior::sets
  bool slow = false;    // with a slow curve without a cause
};

class Truths {
 public:
  // Keeps a reference to the posterior.
  explicit Truths(const Inference& inference);

  // Truths with frequencies as close to the weights of the posterior as their number allows.
  std::vector<Truth> drawn(std::size_t count, std::mt19937_64& random) const;

  std::vector<BoundEffect> effects_of(const Truth& truth) const;
  bool is_nothing(const Truth& truth) const;  // no effect, no wrong held value, no slow curve
  bool has_other_value(const Truth& truth) const { return inference_.posterior.sets[truth.set].own > 0; }

  // The curve on the rows of one run, without noise and without effects of the set-up.
  Eigen::VectorXd drift_um(const Truth& truth, const Series& run) const;

  // The contribution of one effect of the set, without the model.
  Eigen::VectorXd member_um(const Truth& truth, std::size_t member, const Series& run) const;

  // Derivatives by the parameters of the model at those of the set, n by parameters: what the model can absorb.
  Eigen::MatrixXd model_slopes(const Truth& truth, const Series& run) const;

  // The readings with noise, rounded like the target.
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
  mutable std::map<std::size_t, Fitted> fitted_;  // computed on request, before any parallel work
};

}  // namespace ballbar
