#include <gtest/gtest.h>

#include "ballbar/circle/circle.hpp"

namespace ballbar {
namespace {

// r / cos(x) - r = r x^2 / 2 (1 + 5 x^2 / 12 + ...), x = dL / r = 2e-4: 100 mm * 2e-8 = 2e-6 mm = 0.002 um.
TEST(Elongation, Eq34At20umOn100mmIs2nm) {
  EXPECT_NEAR(elongation_correction_um(ElongationForm::eq34, 100.0, 0.0, 20.0), 0.002, 1e-10);
  EXPECT_NEAR(elongation_correction_um(ElongationForm::eq34, 100.0, 5.0, 20.0), 0.002, 1e-10) << "h is ignored";
}

// Balls level: sqrt(100^2 + 0.02^2) - 100 = 0.0004 / 200 mm = 0.002 um, the same to the fourth order.
TEST(Elongation, ExactAgreesWithEq34WhenTheBallsAreLevel) {
  EXPECT_NEAR(elongation_correction_um(ElongationForm::exact, 100.0, 0.0, 20.0), 0.002, 1e-9);
}

// h = 5, dL = 0.02 mm, R = 100: (5.02^2 - 5^2) / (sqrt(10025.2004) + sqrt(10025)) = 0.2004 / 200.25085 mm
// = 1.000745 um. Computed by hand: sqrt(10025) = 100.1249220, sqrt(10025.2004) = 100.1259227.
TEST(Elongation, ExactAtHeight5mmIsAboutOneMicrometre) {
  EXPECT_NEAR(elongation_correction_um(ElongationForm::exact, 100.0, 5.0, 20.0), 1.000745, 1e-5);
}

TEST(Elongation, NothingGrownNothingCorrected) {
  for (const auto form : {ElongationForm::exact, ElongationForm::eq34}) {
    EXPECT_EQ(elongation_correction_um(form, 100.0, 5.0, 0.0), 0.0);
  }
}

// Shrinking towards level makes the readings shorter.
TEST(Elongation, NegativeWhereTheBallsComeCloserToLevel) {
  EXPECT_LT(elongation_correction_um(ElongationForm::exact, 100.0, 5.0, -20.0), -0.99);
}

}  // namespace
}  // namespace ballbar
