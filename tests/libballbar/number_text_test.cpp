// Numbers as people write them.
#include "ballbar/internal/number_text.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace ballbar {
namespace {

TEST(NumberText, durations) {
  EXPECT_EQ(duration_text(38.74), "38.7 s");
  EXPECT_EQ(duration_text(59.6), "1 min");
  EXPECT_EQ(duration_text(265.0), "4 min 25 s");
  EXPECT_EQ(duration_text(3599.6), "1 h");
  EXPECT_EQ(duration_text(9600.0), "2 h 40 min");
  EXPECT_EQ(duration_text(100.0 * 3600.0 - 29.0), "100 h");
  EXPECT_EQ(duration_text(12345.0 * 3600.0), "12 345 h");
  EXPECT_EQ(duration_text(-90.0), "-1 min 30 s");
  EXPECT_EQ(duration_text(2e9), "2e+09 s");
  EXPECT_EQ(duration_text(std::numeric_limits<double>::infinity()), "inf s");
}

TEST(NumberText, groups_of_three_from_five_digits_on) {
  EXPECT_EQ(grouped_text(5000.0), "5000");
  EXPECT_EQ(grouped_text(9999.6), "10 000");
  EXPECT_EQ(grouped_text(20000.0), "20 000");
  EXPECT_EQ(grouped_text(-1234567.0), "-1 234 567");
}

TEST(NumberText, a_small_p) {
  EXPECT_EQ(p_text(0.996), "1");
  EXPECT_EQ(p_text(0.18), "0.18");
  EXPECT_EQ(p_text(0.00123), "0.0012");
  EXPECT_EQ(p_text(1.2e-6), "0.0000012");
  EXPECT_EQ(p_text(9e-7), "< 0.000001");
  EXPECT_EQ(p_text(0.0), "< 0.000001");
  EXPECT_EQ(p_equals_text(0.05), "p = 0.050");
  EXPECT_EQ(p_equals_text(1e-300), "p < 0.000001");
}

TEST(NumberText, how_sure) {
  EXPECT_EQ(text_of(sure_of(1.0)), "over 99 % sure");
  EXPECT_EQ(text_of(sure_of(0.98)), "98 % sure");
  EXPECT_EQ(text_of(sure_of(0.83)), "83 % sure");
  EXPECT_EQ(text_of(sure_of(0.51)), "51 % sure");
  EXPECT_EQ(text_of(sure_of(0.2)), "20 % sure");
  EXPECT_EQ(text_of(sure_of(0.001)), "under 1 % sure");
}

TEST(NumberText, decimals_that_show_so_many_digits) {
  EXPECT_EQ(decimals_showing(2, 0.031), 3);
  EXPECT_EQ(decimals_showing(2, -0.99), 2);
  EXPECT_EQ(decimals_showing(2, 1.0), 1);
  EXPECT_EQ(decimals_showing(3, 1.0), 2);
  EXPECT_EQ(decimals_showing(2, 31.0), 0);
  EXPECT_EQ(decimals_showing(2, 3.1e9), 0);
  EXPECT_EQ(decimals_showing(2, 3.1e-9), 6);
  EXPECT_EQ(decimals_showing(2, 3.1e-9, 9), 9);
  EXPECT_EQ(decimals_showing(3, 0.0), 2);
  EXPECT_EQ(decimals_showing(3, std::numeric_limits<double>::infinity()), 2);
  EXPECT_EQ(decimals_showing(3, std::numeric_limits<double>::quiet_NaN()), 2);
}

TEST(NumberText, decimals_in_a_unit) {
  EXPECT_EQ(decimals_in("ms"), 3);
  EXPECT_EQ(decimals_in("um"), 2);
  EXPECT_EQ(decimals_in("um/m"), 1);
}

TEST(NumberText, sizes) {
  EXPECT_EQ(size_text(0.534), "0.53");
  EXPECT_EQ(size_text(13.98), "14");
  EXPECT_EQ(size_text(1234.0), "1234");
}

}  // namespace
}  // namespace ballbar
