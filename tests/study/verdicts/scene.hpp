// All that a data set is made from, before anything is hidden, and what makes it from that.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "made.hpp"

namespace ballbar::verdicts {

struct Scene {
  Plan plan;
  Conventions conventions;
  Scatter scatter;
  std::vector<double> time_s;
  Base base;
  Eigen::MatrixXd model;                      // whitened derivatives of the base model
  std::array<std::string, kQuantities> name;  // of the columns
  bool states_roles = false;
  std::string target;
};
Scene drawn_scene(const Recipe& recipe, Chance& chance);

// A track as the target sees it, whitened, less what the base model makes of it.
Eigen::VectorXd surviving(const Track& track, const Scene& scene);

// Factor that gives a track that d; nothing where less than a 20th survives, the range would pass 200 sigma, or noise
// and steps of the sensors, passed on by the model and by this effect, would take more than a fifth of d.
std::optional<double> factor_for(const Track& track, const Scene& scene, double d, double at_once_per_K = 0.0);

// Data and model, and nothing said of what is hidden. `sum`: that, scaled, all together; `needed`: columns that stay,
// one of the others may be missing; `not_logged`: one that is.
Made assembled(const Scene& scene, const Track& sum, const std::vector<Quantity>& needed, const Recipe& recipe,
               Chance& chance, std::optional<Quantity> not_logged = std::nullopt);

// The name of its column.
const std::string& name_of(const Scene& scene, Quantity quantity);

// Track times factor.
Track scaled(Track track, double factor);

}  // namespace ballbar::verdicts
