#include "ballbar/effects/spindle_growth_huang2022.hpp"

#include <gtest/gtest.h>

#include <array>
#include <string>

#include "ballbar/error.hpp"

namespace ballbar {
namespace {

constexpr Huang2022 kPaper;

// 13.6 ppm/K * 165 mm * 9 K = 20.196 um.
TEST(Huang2022, ElongationOfThePapersSpindle) {
  EXPECT_NEAR(mean_point_elongation_um(kPaper.expansion_ppm_per_K, kPaper.length_mm, 31.5 - kPaper.start_degC), 20.196,
              1e-9);
}

// One temperature: u_r = alpha r T everywhere in the ring, whatever Poisson's ratio. 10 K of the inner ring:
// 13.6e-3 * 27.34 * 10 = 3.71824 um at its raceway, 13.6e-3 * 26 * 10 = 3.536 um inside.
TEST(Huang2022, RingOfOneTemperatureGrowsWithItsRadius) {
  const std::array<double, 3> radius_mm{kPaper.inner_ring_bore_mm, 25.7, kPaper.inner_raceway_mm};
  const std::array<double, 3> rise_K{10.0, 10.0, 10.0};
  const RingTemperature ring{radius_mm, rise_K};
  EXPECT_NEAR(inner_ring_growth_um(ring, 13.6), 3.71824, 1e-12);
  EXPECT_NEAR(outer_ring_growth_um(ring, 13.6), 13.6e-3 * 25.0 * 10.0, 1e-12) << "eq. 17 is the inner edge";
  for (const double poisson_ratio : {0.0, 0.26, 0.5}) {
    EXPECT_NEAR(ring_growth_um(ring, 26.0, 13.6, poisson_ratio), 3.536, 1e-12);
  }
}

// T = 6 (r - 1) K from 1 to 2 mm, 1000 ppm/K. I(1, 2) = 6 (7/3 - 3/2) = 5 and I(1, 1.5) = 6 (2.375/3 - 1.25/2) = 1.
//   eq. 15  2 * 2 / 3 * 5 = 20/3 um      eq. 17  2 * 1 / 3 * 5 = 10/3 um
//   eq. 14 at 1.5, mu = 0.26:  (1.26 * 1 + (0.74 * 2.25 + 1.26) / 3 * 5) / 1.5 = (1.26 + 4.875) / 1.5 = 4.09 um
TEST(Huang2022, RingWithAStraightTemperature) {
  const std::array<double, 2> radius_mm{1.0, 2.0};
  const std::array<double, 2> rise_K{0.0, 6.0};
  const RingTemperature ring{radius_mm, rise_K};
  EXPECT_NEAR(inner_ring_growth_um(ring, 1000.0), 20.0 / 3.0, 1e-12);
  EXPECT_NEAR(outer_ring_growth_um(ring, 1000.0), 10.0 / 3.0, 1e-12);
  EXPECT_NEAR(ring_growth_um(ring, 1.5, 1000.0, 0.26), 4.09, 1e-12);
}

// Eq. 15 and 17 are eq. 14 at the edges; more samples on the same straight lines change nothing.
TEST(Huang2022, EdgesDoNotDependOnPoissonsRatio) {
  const std::array<double, 4> radius_mm{37.66, 38.2, 39.0, 40.0};
  const std::array<double, 4> rise_K{9.0, 7.0, 6.5, 3.0};
  const RingTemperature ring{radius_mm, rise_K};
  for (const double poisson_ratio : {0.1, 0.26}) {
    EXPECT_NEAR(ring_growth_um(ring, 37.66, 13.6, poisson_ratio), outer_ring_growth_um(ring, 13.6), 1e-12);
    EXPECT_NEAR(ring_growth_um(ring, 40.0, 13.6, poisson_ratio), inner_ring_growth_um(ring, 13.6), 1e-12);
  }
  const std::array<double, 5> more_mm{37.66, 38.2, 38.6, 39.0, 40.0};
  const std::array<double, 5> more_K{9.0, 7.0, 6.75, 6.5, 3.0};
  EXPECT_NEAR(outer_ring_growth_um({more_mm, more_K}, 13.6), outer_ring_growth_um(ring, 13.6), 1e-12);
}

// No elongation, no clearance. Small ones: c = 0.8 dL tan 18 deg = 0.25994 dL. At 119.58 um the contact angle is 0:
// theta = 81 - 72 = 9 deg, c = 309.57 * sin 18 deg * tan 9 deg = 15.1514 um.
TEST(Huang2022, ClearanceStartsWithTan18AndBends) {
  EXPECT_EQ(clearance_um(0.0, 10.319, 0.53), 0.0);
  EXPECT_NEAR(clearance_um(1e-3, 10.319, 0.53), 0.25994e-3, 1e-8);
  EXPECT_NEAR(clearance_um(309.57 * 0.30901699 / 0.8, 10.319, 0.53), 15.1514, 2e-4);
}

TEST(Huang2022, RadialErrorIsTheSum) { EXPECT_DOUBLE_EQ(radial_error_um(5.0, 4.0, 3.5), 4.5); }

std::string message(const std::array<double, 2>& radius_mm, double at_mm) {
  const std::array<double, 2> rise_K{1.0, 1.0};
  try {
    (void)ring_growth_um({radius_mm, rise_K}, at_mm, 13.6, 0.26);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Huang2022, SaysWhatIsWrong) {
  EXPECT_EQ(message({25.0, 27.0}, 28.0), "a radius of 28 mm is not in the ring from 25 to 27 mm");
  EXPECT_EQ(message({27.0, 25.0}, 26.0), "the radii of a ring must rise; found 25 mm after 27 mm");
  EXPECT_EQ(message({0.0, 25.0}, 26.0), "a radius must be positive; found 0 mm");
  EXPECT_THROW((void)inner_ring_growth_um({}, 13.6), Error);
  EXPECT_THROW((void)clearance_um(507.0, 10.319, 0.53), Error);
  EXPECT_THROW((void)clearance_um(-268.0, 10.319, 0.53), Error);
  EXPECT_NO_THROW((void)clearance_um(506.0, 10.319, 0.53));
  EXPECT_NO_THROW((void)clearance_um(-267.0, 10.319, 0.53));
}

}  // namespace
}  // namespace ballbar
