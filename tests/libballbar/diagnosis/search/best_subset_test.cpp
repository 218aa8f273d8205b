// Few signatures that explain most together.
#include "diagnosis/search/best_subset.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <random>

#include "diagnosis/by_hand.hpp"
#include "noise/whitening.hpp"

namespace ballbar {
namespace {

// u1 and u2 nearly the same, r along their difference: each alone explains little, together all.
TEST(BestSubset, finds_a_pair_of_which_each_alone_is_weak) {
  const Eigen::Index n = 200;
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  Eigen::MatrixXd base(n, 3);
  for (Eigen::Index i = 0; i < n; ++i) base.row(i) << normal(random), normal(random), normal(random);
  Eigen::MatrixXd columns(n, 3);
  columns.col(0) = base.col(0) + 0.5 * base.col(1);
  columns.col(1) = base.col(0) - 0.5 * base.col(1);
  columns.col(2) = base.col(2);
  const SignatureLibrary library = by_hand::library_with(columns);
  const Eigen::VectorXd residual = columns.col(0) - columns.col(1);
  LinearisedFit linearised = by_hand::fit_with(std::vector<double>(residual.begin(), residual.end()));
  const Noise noise{0.1, 0.0, 0.0, 0.0};
  const Projected seen = projected(library, residual, linearised.model, Whitening(noise, linearised.time_s, {}));
  const std::vector<Subset> subsets = best_subsets(library, seen, nullptr, 3);
  ASSERT_FALSE(subsets.empty());
  EXPECT_EQ(subsets.front().signatures, (std::vector<std::size_t>{0, 1}));
  EXPECT_NEAR(subsets.front().gain, seen.residual.squaredNorm(), 1e-6 * seen.residual.squaredNorm());
}

// What the model makes already has no score and leads no search.
TEST(BestSubset, leaves_out_what_the_model_absorbs) {
  Eigen::MatrixXd columns(6, 2);
  columns << 1, 1, 1, -1, 1, 2, 1, -2, 1, 1, 1, 3;
  const SignatureLibrary library = by_hand::library_with(columns);
  const LinearisedFit linearised = by_hand::fit_with({0.1, -0.2, 0.1, 0.2, -0.1, -0.1});
  const Noise noise{0.2, 0.0, 0.0, 0.0};
  const Projected seen =
      projected(library, linearised.residual_um, linearised.model, Whitening(noise, linearised.time_s, {}));
  for (const Subset& subset : best_subsets(library, seen, nullptr, 2)) {
    EXPECT_EQ(subset.signatures, std::vector<std::size_t>{1});
  }
}

}  // namespace
}  // namespace ballbar
