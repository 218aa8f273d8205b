// Heavy tails, and where the readings lie that make them.
#include "diagnosis/statistics/outliers.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
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

// 1000 rows of a minute, the speed changes every 100.
Series with_changes() {
  Series data;
  Column speed{"speed_rpm", Role::speed, {}};
  for (int i = 0; i < 1000; ++i) {
    data.time_s.push_back(60.0 * i);
    speed.values.push_back(i / 100 % 2 == 0 ? 0.0 : 4000.0);
  }
  data.columns = {std::move(speed)};
  return data;
}

Outliers with_spikes_at(const std::vector<Eigen::Index>& places) {
  const Series data = with_changes();
  Eigen::VectorXd noise = normal_noise(1000, 5).cwiseMax(-3.0).cwiseMin(3.0);
  for (const Eigen::Index place : places) noise[place] = 9.0;
  std::vector<std::size_t> rows(1000);
  std::iota(rows.begin(), rows.end(), std::size_t{0});
  return outliers(noise, data, rows);
}

TEST(Outliers, after_changes_of_speed_are_no_chance) {
  const Outliers found = with_spikes_at({101, 203, 302, 405, 501});
  EXPECT_EQ(found.count, 5U);
  EXPECT_EQ(found.after_changes, 5U);
  // 9 changes, 11 rows after each of 1000: 0.099^5
  EXPECT_NEAR(found.p, std::pow(0.099, 5), 1e-8);
}

TEST(Outliers, anywhere_are_chance) {
  const Outliers found = with_spikes_at({50, 150, 203, 350, 960});
  EXPECT_EQ(found.count, 5U);
  EXPECT_EQ(found.after_changes, 1U);
  EXPECT_GT(found.p, 0.3);
  EXPECT_EQ(with_spikes_at({}).p, 1.0);
}

}  // namespace
}  // namespace ballbar
