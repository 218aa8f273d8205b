#include "numerics/tails.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "ballbar/units.hpp"

namespace ballbar {
namespace {

// One degree: a normal number squared, erfc(sqrt(x / 2)); two: exp(-x / 2); four: exp(-x / 2) (1 + x / 2).
TEST(Chi2UpperTail, of_one_two_and_four_degrees) {
  EXPECT_NEAR(chi2_upper_tail(3.0, 1), std::erfc(std::sqrt(1.5)), 1e-15);
  EXPECT_NEAR(chi2_upper_tail(3.0, 2), std::exp(-1.5), 1e-15);
  EXPECT_NEAR(chi2_upper_tail(3.0, 4), std::exp(-1.5) * 2.5, 1e-15);
  EXPECT_NEAR(chi2_upper_tail(100.0, 2) / std::exp(-50.0), 1.0, 1e-12);
}

TEST(Chi2UpperTail, of_nothing_is_certain) {
  EXPECT_EQ(chi2_upper_tail(0.0, 3), 1.0);
  EXPECT_EQ(chi2_upper_tail(-1.0, 3), 1.0);
}

// Two degrees: -2 ln p; the inverse of the tail.
TEST(Chi2Exceeded, of_two_degrees_and_back) {
  EXPECT_NEAR(chi2_exceeded(0.01, 2), -2.0 * std::log(0.01), 1e-13);
  EXPECT_NEAR(chi2_upper_tail(chi2_exceeded(1e-5, 7), 7) / 1e-5, 1.0, 1e-12);
}

// One degree: Cauchy, half of it beyond 1; two: 1 - t / sqrt(2 + t^2), 1 - sqrt(1/2) at sqrt 2. Many: normal.
TEST(StudentTails, of_one_two_and_many_degrees) {
  EXPECT_NEAR(student_tails(1.0, 1.0), 0.5, 1e-15);
  EXPECT_NEAR(student_tails(-std::sqrt(2.0), 2.0), 1.0 - std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(student_tails(2.0, INFINITY), std::erfc(std::sqrt(2.0)), 1e-15);
  EXPECT_NEAR(student_tails(2.0, 1e9), std::erfc(std::sqrt(2.0)), 1e-8);
}

// One degree above: t squared; two: (1 + 2 f / d)^(-d / 2). Infinite below: chi^2.
TEST(FisherUpperTail, of_one_and_two_degrees) {
  EXPECT_NEAR(fisher_upper_tail(4.0, 1, 7.0), student_tails(2.0, 7.0), 1e-15);
  EXPECT_NEAR(fisher_upper_tail(3.0, 2, 4.0), 1.0 / 6.25, 1e-15);
  EXPECT_NEAR(fisher_upper_tail(3.0, 4, INFINITY), chi2_upper_tail(12.0, 4), 1e-15);
  EXPECT_EQ(fisher_upper_tail(0.0, 4, 7.0), 1.0);
}

// Four coins: three heads in 4 ways of 16, four in one.
TEST(BinomialUpperTail, of_four_coins) {
  EXPECT_NEAR(binomial_upper_tail(3, 4, 0.5), 5.0 / 16.0, 1e-15);
  EXPECT_NEAR(binomial_upper_tail(4, 4, 0.5), 1.0 / 16.0, 1e-15);
  EXPECT_NEAR(binomial_upper_tail(1, 4, 0.5), 15.0 / 16.0, 1e-15);
}

TEST(BinomialUpperTail, of_what_is_certain_or_cannot_be) {
  EXPECT_EQ(binomial_upper_tail(0, 4, 0.1), 1.0);
  EXPECT_EQ(binomial_upper_tail(5, 4, 0.9), 0.0);
  EXPECT_EQ(binomial_upper_tail(1, 4, 0.0), 0.0);
  EXPECT_EQ(binomial_upper_tail(4, 4, 1.0), 1.0);
  EXPECT_EQ(binomial_upper_tail(1, 0, 0.5), 0.0);
}

// Half of 100000 coins or more: one half and half of the chance of just as many, sqrt(2 / (pi n)) by Stirling.
TEST(BinomialUpperTail, of_many_coins) {
  EXPECT_NEAR(binomial_upper_tail(50000, 100000, 0.5), 0.5 + 0.5 * std::sqrt(2.0 / (kPi * 1e5)), 1e-8);
}

}  // namespace
}  // namespace ballbar
