#include "numerics/root.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace ballbar {
namespace {

TEST(RootBetween, is_between_two_neighbouring_doubles) {
  const auto [below, above] = root_between([](double x) { return x * x < 2.0; }, 0.0, 2.0);
  EXPECT_LT(below * below, 2.0);
  EXPECT_GE(above * above, 2.0);
  EXPECT_EQ(above, std::nextafter(below, 2.0));
}

TEST(RootBetween, is_an_end_where_it_is_not_within) {
  const auto is_below = [](double x) { return x < 5.0; };
  EXPECT_EQ(root_between(is_below, 6.0, 9.0), (std::pair{6.0, 6.0}));
  EXPECT_EQ(root_between(is_below, 5.0, 9.0), (std::pair{5.0, 5.0}));
  EXPECT_EQ(root_between(is_below, 1.0, 4.0), (std::pair{4.0, 4.0}));
}

}  // namespace
}  // namespace ballbar
