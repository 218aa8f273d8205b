#include <gtest/gtest.h>

#include "errors/quantity_text.hpp"

namespace ballbar {
namespace {

// A and B of a plane are its first and second letter.
TEST(ErrorNames, HaveTheAxesOfThePlane) {
  EXPECT_EQ(plain_name("reversal_spike_a", Plane::XY), "reversal spike of X");
  EXPECT_EQ(plain_name("reversal_spike_b", Plane::ZX), "reversal spike of X");
  EXPECT_EQ(plain_name("scale_mismatch", Plane::YZ), "scale mismatch");
  EXPECT_EQ(plain_name("sin_4_theta", Plane::XY), "sin 4 theta");
}

// Only words that are A or B, wherever they stand.
TEST(ErrorNames, SummariesToo) {
  EXPECT_EQ(with_axes("Axis A shifts sideways, along B, when it reverses.", Plane::YZ),
            "Axis Y shifts sideways, along Z, when it reverses.");
  EXPECT_EQ(with_axes("Play of axis A: a step where A reverses", Plane::ZX), "Play of axis Z: a step where Z reverses");
  EXPECT_EQ(with_axes("An axis is longer. Ball Bar", Plane::XY), "An axis is longer. Ball Bar");
}

}  // namespace
}  // namespace ballbar
