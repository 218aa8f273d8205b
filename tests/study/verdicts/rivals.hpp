// What effects of the catalogue could make of a hidden signal: how far the best of them, alone beside the base model,
// stays from it. By the study's own formulas, on a grid of shapes.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "scene.hpp"

namespace ballbar::verdicts {

struct Rivals {
  std::vector<std::string> effect;            // one a column
  std::vector<std::vector<Quantity>> inputs;  // likewise
  Eigen::MatrixXd left;                       // whitened, less the base model, of length 1
};
Rivals rivals(const Scene& scene);

// d of what the best rival leaves of a hidden signal whose surviving part is `left`. Rivals that need a column which is
// not logged and those of that name are none. Nor are those of `also` on the same inputs.
struct Apart {
  double d = 0.0;
  std::string effect;  // the best rival
};
Apart apart(const Eigen::VectorXd& left, const Rivals& rivals, const std::string& without_effect,
            std::optional<Quantity> not_logged);

}  // namespace ballbar::verdicts
