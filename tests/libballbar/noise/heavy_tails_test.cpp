// Heavy tails, told from normal noise.
#include <gtest/gtest.h>

#include <random>

#include "noise/whitening.hpp"

namespace ballbar {
namespace {

Eigen::VectorXd normal_noise(Eigen::Index n, unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  Eigen::VectorXd noise(n);
  for (double& value : noise) value = normal(random);
  return noise;
}

TEST(HeavyTails, are_told_from_normal_noise) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    EXPECT_FALSE(has_heavy_tails(3.0 * normal_noise(400, seed))) << seed;
    std::mt19937_64 random(seed);
    std::student_t_distribution<double> student(3.0);
    Eigen::VectorXd noise(400);
    for (double& value : noise) value = student(random);
    EXPECT_TRUE(has_heavy_tails(noise)) << seed;
  }
}

TEST(HeavyTails, of_too_little_are_not_told) {
  EXPECT_FALSE(has_heavy_tails(Eigen::VectorXd(0)));
  EXPECT_FALSE(has_heavy_tails(Eigen::VectorXd::Ones(5)));
}

}  // namespace
}  // namespace ballbar
