// What effects of the catalogue could make of a hidden signal: how far the best of them, alone beside the base model,
// stays from it. By the study's own formulas, on a grid of shapes.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "scene.hpp"

namespace ballbar::verdicts {

struct Rivals {
  std::vector<std::string> effect;            // one a column
  std::vector<std::vector<Quantity>> inputs;  // likewise
  Eigen::MatrixXd left;                       // whitened, less the base model, of length 1
  std::vector<double> prior;                  // effects alike, columns of an effect alike, shapes alike
};
Rivals rivals(const Scene& scene);

// d of what the best rival leaves of a hidden signal whose surviving part is `left`, and who that is.
struct Apart {
  double d = 0.0;
  std::string effect;
};
using IsRival = std::function<bool(const std::string& effect, const std::vector<Quantity>& inputs)>;
Apart apart(const Eigen::VectorXd& left, const Rivals& rivals, const IsRival& is_rival);

// Probability of the truth for one who knows the noise and all else, where the data are exactly what is hidden, and the
// best effect that is not it.
struct Ideal {
  double p = 0.0;
  std::string rival;
};
Ideal ideal(const Eigen::VectorXd& left, const Rivals& rivals, const IsRival& is_rival);

}  // namespace ballbar::verdicts
