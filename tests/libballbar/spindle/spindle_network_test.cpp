// Masses, conduction, friction and contacts of the network, by hand.
#include "spindle/spindle_network.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace ballbar::thermal {
namespace {

TEST(SpindleNetwork, CommonPartOfIntervals) {
  EXPECT_EQ(overlap_mm({0.0, 10.0}, {4.0, 20.0}), 6.0);
  EXPECT_EQ(overlap_mm({0.0, 10.0}, {2.0, 3.0}), 1.0);
  EXPECT_EQ(overlap_mm({0.0, 10.0}, {10.0, 20.0}), 0.0);
  EXPECT_EQ(overlap_mm({0.0, 10.0}, {15.0, 20.0}), 0.0);
}

// Through its two points; between them lg lg (nu + 0.7) goes as lg T. For 22 and 4.2 mm2/s: 0.132268 at 40 degC,
// -0.161028 at 100 degC, slope 3.852 per lg K, so -0.020799 at 70 degC, which is 8.279 mm2/s.
TEST(SpindleNetwork, ViscosityAfterWalther) {
  const FiniteVolumeSpindle spindle;
  EXPECT_NEAR(viscosity_mm2_per_s(spindle, 40.0), 22.0, 1e-12);
  EXPECT_NEAR(viscosity_mm2_per_s(spindle, 100.0), 4.2, 1e-12);
  EXPECT_NEAR(viscosity_mm2_per_s(spindle, 70.0), 8.279, 5e-4);
}

// nu n = 2e5, ^(2/3) = 3419.95; 1e-7 * 3419.95 * 80^3 = 175.10 N mm of the lubricant, 0.0003 * 500 * 80 = 12 N mm of
// the load; 187.10 N mm at 1047.20 rad/s are 195.93 W.
TEST(SpindleNetwork, FrictionAfterPalmgren) {
  FiniteVolumeSpindle spindle;
  spindle.f0 = 1.0;
  spindle.f1 = 0.0003;
  EXPECT_NEAR(friction_W(spindle, 80.0, 500.0, 10000.0, 20.0), 195.93, 0.01);
  EXPECT_EQ(friction_W(spindle, 80.0, 500.0, 0.0, 20.0), 0.0);
  // nu n = 500: 160 stands in for 500^(2/3). 1e-7 * 160 * 80^3 = 8.192, with 12 N mm 20.192 at 2.618 rad/s.
  EXPECT_NEAR(friction_W(spindle, 80.0, 500.0, 25.0, 20.0), 0.052863, 1e-6);
}

TEST(SpindleNetwork, ConvectionAtTenThousand) {
  EXPECT_EQ(convection_W_per_m2_K(9.0, 45.0, 10000.0), 54.0);
  EXPECT_EQ(convection_W_per_m2_K(9.0, 45.0, 0.0), 9.0);
}

// Shaft: density * section to the nose, 64 mm with a bore of 24 mm over 420 mm, and 32 mm of tool over 100 mm:
// 7850 * (2764.6 mm2 * 420 mm + 804.25 mm2 * 100 mm) = 9.7462 kg. Housing 13194.7 mm2 * 380 mm: 39.360 kg.
TEST(SpindleNetwork, MassesOfShaftAndHousing) {
  const FiniteVolumeSpindle spindle;
  const Cells cells = cells_of(spindle);
  const Network network = network_of(spindle, {}, cells, 0.0);
  const auto shaft = static_cast<Eigen::Index>(cells.shaft.size());
  const auto housing = static_cast<Eigen::Index>(4 * cells.housing.size());
  const double heat = spindle.specific_heat_J_per_kg_K;
  EXPECT_NEAR(network.capacity_J_per_K.head(shaft).sum() / heat, 9.7462, 1e-3);
  EXPECT_NEAR(network.capacity_J_per_K.segment(shaft, housing).sum() / heat, 39.360, 1e-3);
}

// Cells of 10 mm, 45 W/m/K. Over the nose 5 mm of 2764.6 mm2 and 5 mm of 804.25 mm2: 0.04019 + 0.13815 K/W. Along a
// side of the housing 45 * 3298.7 mm2 / 10 mm; round it 45 * 30 mm * 10 mm / (70 mm * pi / 2).
TEST(SpindleNetwork, ConductionOfShaftAndHousing) {
  const FiniteVolumeSpindle spindle;
  const Cells cells = cells_of(spindle);
  const Network network = network_of(spindle, {}, cells, 0.0);
  const auto between = [&](Eigen::Index a, Eigen::Index b) {
    double W_per_K = 0.0;
    for (const Link& link : network.links) {
      if ((link.a == a && link.b == b) || (link.a == b && link.b == a)) W_per_K += link.W_per_K;
    }
    return W_per_K;
  };
  EXPECT_NEAR(between(cells.shaft_node(41), cells.shaft_node(42)), 5.6072, 1e-3);
  EXPECT_NEAR(between(cells.housing_node(3, plus_x), cells.housing_node(4, plus_x)), 14.844, 1e-3);
  EXPECT_NEAR(between(cells.housing_node(3, minus_y), cells.housing_node(3, plus_x)), 0.12278, 1e-5);
}

// Cells that do not end where the bodies do still carry the whole of each contact.
TEST(SpindleNetwork, ContactsAreWholeOnAnyGrid) {
  for (const double number : {7.0, 52.0, 131.0}) {
    FiniteVolumeSpindle spindle;
    spindle.cells = number;
    const Cells cells = cells_of(spindle);
    double front_W_per_K = 0.0, jacket_W_per_K = 0.0;
    for (const Link& link : network_of(spindle, {}, cells, 0.0).links) {
      if (link.a == cells.front_bearing()) front_W_per_K += link.W_per_K;
      if (link.a == cells.jacket_water() && link.b != cells.tank()) jacket_W_per_K += link.W_per_K;
    }
    EXPECT_NEAR(front_W_per_K, 2.0 * (12.0 + 14.0), 1e-9) << number;  // two rows, both rings
    EXPECT_NEAR(jacket_W_per_K, 120.0, 1e-9) << number;
  }
}

TEST(SpindleNetwork, SidesShareAll) {
  const Shares shares = more_to(minus_y, 0.6);
  EXPECT_DOUBLE_EQ(shares[minus_y], 0.4);
  EXPECT_DOUBLE_EQ(shares[plus_y], 0.1);
  EXPECT_DOUBLE_EQ(shares[plus_x] + shares[minus_x], 0.5);
}

}  // namespace
}  // namespace ballbar::thermal
