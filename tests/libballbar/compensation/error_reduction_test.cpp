#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "ballbar/compensation/compensation.hpp"

namespace ballbar {
namespace {

// RMS of (3, 4, 0) is 5/sqrt 3, of (0, 1, 1) sqrt(2/3): 1 - sqrt(2)/5 = 0.7172. Without each in turn, 1 - sqrt of
// 2/16, 1/9, 1/25: 0.6464, 0.6667, 0.8; their mean is 0.7044, sigma^2 = 2/3 (0.0580^2 + 0.0377^2 + 0.0956^2) = 0.0093.
TEST(Reduction, WorkedByHand) {
  const std::vector<double> before_um{3.0, -4.0, 0.0}, after_um{0.0, 1.0, -1.0};
  const Reduction rms = reduction_of(before_um, after_um, ErrorSize::root_mean_square);
  EXPECT_NEAR(rms.before_um, 5.0 / std::sqrt(3.0), 1e-12);
  EXPECT_NEAR(rms.after_um, std::sqrt(2.0 / 3.0), 1e-12);
  EXPECT_NEAR(rms.share, 0.71716, 1e-5);
  EXPECT_NEAR(rms.sigma, 0.0964, 1e-4);
  const Reduction mean = reduction_of(before_um, after_um, ErrorSize::mean_of_sizes);
  EXPECT_NEAR(mean.before_um, 7.0 / 3.0, 1e-12);
  EXPECT_NEAR(mean.share, 1.0 - 2.0 / 7.0, 1e-12);
}

// What stays alike for long is left out in long stretches, and is less sure: a slow wave of 100 values against the same
// values in another order.
TEST(Reduction, NeighboursThatAreAlikeCountAsFewer) {
  std::vector<double> before_um, wave_um, mixed_um(400);
  for (int i = 0; i < 400; ++i) {
    before_um.push_back(10.0);
    wave_um.push_back(1.0 + std::sin(0.0628 * i));
  }
  for (std::size_t i = 0; i < 400; ++i) mixed_um[i * 157 % 400] = wave_um[i];
  const Reduction wave = reduction_of(before_um, wave_um, ErrorSize::root_mean_square);
  const Reduction mixed = reduction_of(before_um, mixed_um, ErrorSize::root_mean_square);
  EXPECT_NEAR(wave.share, mixed.share, 1e-12);
  EXPECT_GE(wave.stretch, 30U);
  EXPECT_LE(mixed.stretch, 8U);
  EXPECT_GT(wave.sigma, 2.0 * mixed.sigma);
}

TEST(Reduction, SaysWhatItDoesNotKnow) {
  EXPECT_TRUE(std::isnan(reduction_of({{0.0, 0.0}}, {{1.0, 1.0}}, ErrorSize::root_mean_square).share));
  EXPECT_TRUE(std::isnan(reduction_of({{1.0, 2.0}}, {{1.0, 1.0}}, ErrorSize::root_mean_square).sigma));
}

// Table 3 of Huang, Li, Zhao 2022 (doi 10.19650/j.cnki.cjsi.J2209226): depth of a bore from the table's surface,
// nominally 30 mm, and its diameter, nominally 175 mm, of ten workpieces without and with compensation.
struct Bore {
  double depth_before_mm, diameter_before_mm;
  double depth_after_mm, diameter_after_mm;
};
constexpr std::array<Bore, 10> kBores{{{29.979709, 175.005271, 29.994545, 175.002451},
                                       {29.979625, 175.005322, 29.994471, 175.002513},
                                       {29.979721, 175.005288, 29.994516, 175.002462},
                                       {29.979711, 175.005158, 29.994528, 175.002381},
                                       {29.979906, 175.005952, 29.994661, 175.002736},
                                       {29.979535, 175.005573, 29.994345, 175.002616},
                                       {29.979431, 175.005482, 29.994239, 175.002561},
                                       {29.979607, 175.005467, 29.994404, 175.002478},
                                       {29.979782, 175.005441, 29.994567, 175.002537},
                                       {29.979756, 175.005393, 29.994632, 175.002493}}};

Reduction of_bores(double Bore::*before_mm, double Bore::*after_mm, double nominal_mm) {
  std::vector<double> before_um, after_um;
  for (const Bore& bore : kBores) {
    before_um.push_back(1e3 * (bore.*before_mm - nominal_mm));
    after_um.push_back(1e3 * (bore.*after_mm - nominal_mm));
  }
  return reduction_of(before_um, after_um, ErrorSize::mean_of_sizes);
}

// The paper prints 53.6 %.
TEST(Huang2022Table3, RadialReductionIsAsPrinted) {
  const Reduction radial = of_bores(&Bore::diameter_before_mm, &Bore::diameter_after_mm, 175.0);
  EXPECT_NEAR(radial.before_um, 5.435, 0.0005);
  EXPECT_NEAR(radial.after_um, 2.523, 0.0005);
  EXPECT_NEAR(radial.share, 0.536, 0.0005);
  EXPECT_NEAR(radial.sigma, 0.0017, 0.00005);
}

// The paper prints 73.5 %. The means that it prints, 20.322 and 5.351 um, give 73.7 %; the ten rows have the mean 5.509
// um with compensation, 29.994491 mm and not 29.994649, and give 72.9 %.
TEST(Huang2022Table3, AxialReductionIsNot) {
  const Reduction axial = of_bores(&Bore::depth_before_mm, &Bore::depth_after_mm, 30.0);
  EXPECT_NEAR(axial.before_um, 20.322, 0.0005);
  EXPECT_NEAR(axial.after_um, 5.509, 0.0005);
  EXPECT_NEAR(axial.share, 0.729, 0.0005);
  EXPECT_NEAR(axial.sigma, 0.0017, 0.00005);  // leaving out two bores at a time
  EXPECT_EQ(axial.stretch, 2U);
  EXPECT_NEAR(1.0 - 5.351 / 20.322, 0.737, 0.0005);
}

// Sample deviations of the rows are those printed, so that the rows are read as they were.
TEST(Huang2022Table3, RowsHaveThePrintedDeviations) {
  const auto deviation_mm = [](double Bore::*column) {
    double mean = 0.0, square = 0.0;
    for (const Bore& bore : kBores) mean += bore.*column / 10.0;
    for (const Bore& bore : kBores) square += std::pow(bore.*column - mean, 2);
    return std::sqrt(square / 9.0);
  };
  EXPECT_NEAR(deviation_mm(&Bore::depth_before_mm), 0.000134201, 5e-10);
  EXPECT_NEAR(deviation_mm(&Bore::diameter_before_mm), 0.000218421, 5e-10);
  EXPECT_NEAR(deviation_mm(&Bore::depth_after_mm), 0.000130066, 5e-10);
  EXPECT_NEAR(deviation_mm(&Bore::diameter_after_mm), 9.8743e-5, 5e-10);
}

}  // namespace
}  // namespace ballbar
