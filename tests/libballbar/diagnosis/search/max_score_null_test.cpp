// What a search finds where there is nothing.
#include "diagnosis/search/max_score_null.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <random>

#include "diagnosis/by_hand.hpp"
#include "noise/whitening.hpp"

namespace ballbar {
namespace {

// One signature, white noise: scores are chi^2 with one degree of freedom; 90 % quantile 2.706, mean excess about 2.4.
TEST(MaxScoreNull, one_signature_is_chi2) {
  const std::size_t n = 40;
  Eigen::MatrixXd columns(n, 1);
  for (Eigen::Index i = 0; i < columns.rows(); ++i) columns(i, 0) = std::sin(0.7 * static_cast<double>(i));
  const SignatureLibrary library = by_hand::library_with(columns);
  const LinearisedFit linearised = by_hand::fit_with(std::vector<double>(n, 0.0));
  const Noise noise{0.3, 0.0, 0.0, 0.0};
  const Projected seen =
      projected(library, linearised.residual_um, linearised.model, Whitening(noise, linearised.time_s, {}));
  const MaxScoreNull null = max_score_null(library, seen, linearised, noise, {noise}, 20000, 1);
  const Effect& effect = *library.families[0].bound.effect;
  EXPECT_NEAR(null.p_of_effect(effect, 2.706), 0.1, 0.01);
  EXPECT_NEAR(null.p_of_effect(effect, 6.635), 0.01, 0.004);
  EXPECT_NEAR(null.p_search(effect, 6.635), 0.01, 0.004);
  EXPECT_GT(null.threshold(effect), 5.5);
  EXPECT_LT(null.threshold(effect), 8.0);
}

// Noise with a memory, uneven steps and stated sigma: whitened by itself it is white, whatever the filter's way.
TEST(MaxScoreNull, noise_with_a_memory_is_drawn_as_it_is) {
  const std::size_t n = 40;
  Eigen::MatrixXd columns(n, 1);
  for (Eigen::Index i = 0; i < columns.rows(); ++i) columns(i, 0) = std::sin(0.2 * static_cast<double>(i));
  const SignatureLibrary library = by_hand::library_with(columns);
  LinearisedFit linearised = by_hand::fit_with(std::vector<double>(n, 0.0));
  for (std::size_t i = 0; i < n; ++i) {
    linearised.time_s[i] += i % 3 == 0 ? 10.0 : 0.0;
    linearised.sigma_um.push_back(i % 2 == 0 ? 0.1 : 0.3);
  }
  const Noise noise{0.3, 0.5, 200.0, 0.0};
  const Whitening whitening(noise, linearised.time_s, linearised.sigma_um);
  const Projected seen = projected(library, linearised.residual_um, linearised.model, whitening);
  const MaxScoreNull null = max_score_null(library, seen, linearised, noise, {noise}, 20000, 1);
  const Effect& effect = *library.families[0].bound.effect;
  EXPECT_NEAR(null.p_of_effect(effect, 2.706), 0.1, 0.01);
  EXPECT_NEAR(null.p_of_effect(effect, 6.635), 0.01, 0.004);
  // Noise of twice the size: scores are four times as large.
  const Noise larger{0.6, 1.0, 200.0, 0.0};
  linearised.sigma_um.clear();
  const Whitening plain(noise, linearised.time_s, {});
  const Projected without = projected(library, linearised.residual_um, linearised.model, plain);
  const MaxScoreNull twice = max_score_null(library, without, linearised, noise, {larger}, 20000, 1);
  EXPECT_NEAR(twice.p_of_effect(effect, 4.0 * 2.706), 0.1, 0.01);
}

}  // namespace
}  // namespace ballbar
