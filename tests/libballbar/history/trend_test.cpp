#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "ballbar/history/history.hpp"
#include "numerics/not_finite.hpp"

namespace ballbar {
namespace {

std::vector<DatedValue> quarterly(std::size_t count, double start, double rate_per_year, double sigma, double scatter,
                                  std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  std::vector<DatedValue> values;
  for (std::size_t i = 0; i < count; ++i) {
    const double years = 0.25 * static_cast<double>(i);
    const double off = sigma * normal(random) + scatter * normal(random);
    values.push_back({years * kYear_s, start + rate_per_year * years + off, sigma});
  }
  return values;
}

TEST(trend, few_tests_or_one_week_tell_none) {
  std::vector<DatedValue> values{{0.0, 1.0, 0.1}, {30 * kDay_s, 2.0, 0.1}};
  EXPECT_FALSE(trend_of(values));
  values.push_back({60 * kDay_s, 3.0, 0.1});
  EXPECT_TRUE(trend_of(values));
  for (DatedValue& one : values) one.time_s /= 10.0;
  EXPECT_FALSE(trend_of(values)) << "6 days";
}

// With very many tests tau is known, and it is weighted least squares: 400 quarterly tests of sigma 1, variance of the
// slope 1 / sum (t - mean)^2 = 12 / (0.25^2 n (n^2 - 1)).
TEST(trend, many_tests_are_weighted_least_squares) {
  std::mt19937_64 random(11);
  const auto values = quarterly(400, 5.0, 0.3, 1.0, 0.0, random);
  const auto trend = trend_of(values);
  ASSERT_TRUE(trend);
  const double sigma = std::sqrt(12.0 / (0.0625 * 400.0 * (400.0 * 400.0 - 1.0)));
  EXPECT_NEAR(trend->sigma_per_year, sigma, 0.1 * sigma);
  EXPECT_NEAR(trend->rate_per_year, 0.3, 4.0 * sigma);
  EXPECT_TRUE(trend->significant);
  EXPECT_EQ(trend->last_s, values.back().time_s);
  EXPECT_LT(trend->scatter, 0.5);
}

TEST(trend, scatter_beyond_the_sigmas_is_found) {
  std::mt19937_64 random(12);
  const auto trend = trend_of(quarterly(60, 5.0, 0.0, 0.2, 1.0, random));
  ASSERT_TRUE(trend);
  EXPECT_NEAR(trend->scatter, 1.0, 0.3);
}

// Values on a line without a sigma leave nothing that is not known.
TEST(trend, stored_values_on_a_line) {
  const std::vector<DatedValue> values{{0.0, 1.0, kUnknown}, {kYear_s, 3.0, kUnknown}, {2.0 * kYear_s, 5.0, kUnknown}};
  const auto trend = trend_of(values);
  ASSERT_TRUE(trend);
  EXPECT_NEAR(trend->rate_per_year, 2.0, 1e-9);
  EXPECT_EQ(trend->sigma_per_year, 0.0);
  EXPECT_NEAR(quantile(*trend, 3.0 * kYear_s, 0.3), 7.0, 1e-9);
}

// Without any sigma it is Student's t. Four values 0, 0, 1, 0 a year apart: slope 0.1, residuals -0.1, -0.2, 0.7, -0.4,
// s^2 = 0.7 / 2, sigma of the slope sqrt(0.35 / 5) = 0.2646; of t with 2 degrees 68.27 % lie within 1.3210.
TEST(trend, without_sigmas_it_is_students_t) {
  std::vector<DatedValue> values;
  for (int i = 0; i < 4; ++i) values.push_back({i * kYear_s, i == 2 ? 1.0 : 0.0, kUnknown});
  const auto trend = trend_of(values);
  ASSERT_TRUE(trend);
  EXPECT_NEAR(trend->rate_per_year, 0.1, 1e-9);
  EXPECT_NEAR(trend->sigma_per_year, 1.3210 * 0.26458, 0.01);
}

struct Coverage {
  std::size_t tests = 0;
  double scatter = 0.0;  // in sigmas
};

// Share of 1000 histories in which the interval of 95 % of the value a year after the last test holds the truth, and
// share in which a trend is seen where there is none. One hundredth is the 2.6 sigmas; with few tests and no scatter
// the intervals are wider than they need be, for tau is not known.
TEST(trend, intervals_hold_what_they_say) {
  for (const Coverage& how : {Coverage{3, 0.0}, {3, 1.0}, {3, 5.0}, {5, 0.0}, {5, 2.0}, {12, 0.0}, {12, 2.0}}) {
    std::mt19937_64 random(1000 + how.tests);
    int inside = 0, seen = 0;
    constexpr int kHistories = 1000;
    for (int k = 0; k < kHistories; ++k) {
      const auto values = quarterly(how.tests, 3.0, 0.0, 0.5, 0.5 * how.scatter, random);
      const auto trend = trend_of(values);
      const double later_s = trend->last_s + kYear_s;
      inside += quantile(*trend, later_s, 0.025) <= 3.0 && 3.0 <= quantile(*trend, later_s, 0.975) ? 1 : 0;
      seen += trend->significant ? 1 : 0;
    }
    SCOPED_TRACE(testing::Message() << how.tests << " tests, scatter " << how.scatter << " sigma: inside " << inside
                                    << ", seen " << seen);
    EXPECT_GE(inside, 935);
    EXPECT_LE(seen, 20);
    if (how.tests == 12) {
      EXPECT_LE(inside, 985);
    }
  }
}

// Five tests, 0.5 um +- 0.1 um a quarter and no scatter: five times what they could see.
TEST(trend, a_clear_one_is_seen) {
  for (const auto& [tests, least] : {std::pair(4, 600), {5, 950}, {8, 1000}}) {
    std::mt19937_64 random(2000);
    int seen = 0;
    for (int k = 0; k < 1000; ++k) {
      seen += trend_of(quarterly(static_cast<std::size_t>(tests), 3.0, 2.0, 0.1, 0.0, random))->significant ? 1 : 0;
    }
    EXPECT_GE(seen, least) << tests;
  }
}

TEST(trend, order_does_not_matter) {
  std::mt19937_64 random(13);
  auto values = quarterly(6, 1.0, 2.0, 0.3, 0.3, random);
  const auto trend = trend_of(values);
  std::swap(values[0], values[4]);
  const auto other = trend_of(values);
  EXPECT_NEAR(trend->rate_per_year, other->rate_per_year, 1e-12);
  EXPECT_EQ(trend->last_s, other->last_s);
}

}  // namespace
}  // namespace ballbar
