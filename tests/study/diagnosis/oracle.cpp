#include "oracle.hpp"

#include <algorithm>
#include <limits>

#include "additions.hpp"
#include "diagnosis/search/nested_effects.hpp"
#include "noise/whitening.hpp"
#include "numerics/orthonormal.hpp"

namespace ballbar::study {

namespace {

// A truth with a shape more: at its edge it is the truth, and no competitor.
bool becomes_true(const DataSet& set, const BoundEffect& competitor) {
  return std::any_of(set.hidden.begin(), set.hidden.end(), [&](const Hidden& hidden) {
    return hidden.injection && becomes(competitor, hidden.injection->bound);
  });
}

}  // namespace

Oracle oracle(const DataSet& set) {
  const SignatureLibrary library =
      signature_library_of(built_in_catalogue(), set.model, set.data, set.base,
                           {.motion = {}, .every_onset = true, .without = set.options.search.without});
  const auto n = static_cast<Eigen::Index>(set.base.row.size());
  const Whitening whitening(set.noise, set.base.time_s, set.base.sigma_um);
  const Projected seen = projected(library, Eigen::VectorXd::Zero(n), model_columns(set.base), whitening);
  Eigen::MatrixXd signals(n, static_cast<Eigen::Index>(set.hidden.size()));
  for (std::size_t m = 0; m < set.hidden.size(); ++m) {
    const Survival survival = survival_of(set.hidden[m].signal_um, set.base, set.noise);
    signals.col(static_cast<Eigen::Index>(m)) = Eigen::VectorXd::Map(survival.left.data(), n);
  }
  Oracle smallest{std::numeric_limits<double>::infinity(), {}};
  for (Eigen::Index m = 0; m < signals.cols(); ++m) {
    Eigen::MatrixXd others(n, signals.cols() - 1);
    others << signals.leftCols(m), signals.rightCols(signals.cols() - 1 - m);
    others = orthonormal(others);
    const Eigen::VectorXd target = freed(Eigen::VectorXd(signals.col(m)), others);
    const std::vector<double> fall = falls(library, seen, others, target);
    for (std::size_t k = 0; k < fall.size(); ++k) {
      const Family& family = library.families[library.signatures[k].family];
      const BoundEffect& competitor = family.bound;
      const double loss = target.squaredNorm() - fall[k];
      if (loss < smallest.loss && !is_true(set, competitor) && !becomes_true(set, competitor))
        smallest = {loss, label_of(competitor)};
    }
  }
  return smallest;
}

}  // namespace ballbar::study
