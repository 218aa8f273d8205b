#include <gtest/gtest.h>

#include <cmath>

#include "ballbar/circle/circle.hpp"
#include "ballbar/error.hpp"
#include "ballbar/units.hpp"

namespace ballbar {
namespace {

// Lengths 100 mm + growth + oval cos 2 theta + lift, um, no offset of the centre; n readings at mid-sample.
Recording oval(Direction direction, double growth_um, double oval_um, double lift_um = 0.0, int n = 720) {
  Recording recording;
  recording.direction = direction;
  for (int i = 0; i < n; ++i) {
    const double turn = (i + 0.5) / n;
    const double angle_rad = 2.0 * kPi * (direction == Direction::CCW ? turn : 1.0 - turn);
    const double lift = angle_rad > kPi ? lift_um : 0.0;
    recording.angle_rad.push_back(angle_rad);
    recording.length_mm.push_back(100.0 + mm_from_um(growth_um + oval_um * std::cos(2.0 * angle_rad) + lift));
  }
  return recording;
}

// An oval of 3 um: G = 6, from -3 to +3; radius 2 um over nominal: F from -1 to +5. cos 2 theta at mid-sample of
// 0.5 deg is 1 - 4e-5: 1e-4 um short.
TEST(Circularity, OvalByHand) {
  const Recording recording = oval(Direction::CCW, 2.0, 3.0);
  const Circularity result = circularity(recording, fit_circle(recording));
  EXPECT_NEAR(result.circular_deviation_um, 6.0, 5e-4);
  EXPECT_NEAR(result.max_circular_um, 3.0, 3e-4);
  EXPECT_NEAR(result.min_circular_um, -3.0, 3e-4);
  EXPECT_NEAR(result.max_radial_um, 5.0, 3e-4);
  EXPECT_NEAR(result.min_radial_um, -1.0, 3e-4);
  EXPECT_NEAR(std::abs(std::cos(rad_from_deg(result.max_at_deg))), 1.0, 1e-4) << "at 0 or 180 deg";
  EXPECT_NEAR(std::abs(std::sin(rad_from_deg(result.min_at_deg))), 1.0, 1e-4) << "at 90 or 270 deg";
}

// CCW radius +2, CW radius +4 um, the same oval of 3: D = 3; G = 6 each; about the common centre the radii run
// from 2 - 3 to 4 + 3: 8; H = 2 everywhere.
TEST(Bidirectional, PairByHand) {
  const Recording ccw = oval(Direction::CCW, 2.0, 3.0);
  const Recording cw = oval(Direction::CW, 4.0, 3.0);
  const Circle ccw_circle = fit_circle(ccw);
  const Circle cw_circle = fit_circle(cw);
  for (const bool swapped : {false, true}) {
    const Bidirectional both =
        swapped ? bidirectional(cw, cw_circle, ccw, ccw_circle) : bidirectional(ccw, ccw_circle, cw, cw_circle);
    EXPECT_NEAR(both.bidirectional_1996_um, 6.0, 5e-4);
    EXPECT_NEAR(both.bidirectional_2005_um, 8.0, 5e-4);
    EXPECT_NEAR(both.mean_radial_um, 3.0, 1e-6);
    EXPECT_NEAR(both.hysteresis_um, 2.0, 1e-6);
  }
}

// H is not re-centred: a lift of 5 um on the lower half of CW alone is a hysteresis of 5 um there.
TEST(Bidirectional, HysteresisIsOfTheReadingsThemselves) {
  const Recording ccw = oval(Direction::CCW, 0.0, 0.0);
  const Recording cw = oval(Direction::CW, 0.0, 0.0, 5.0);
  const Bidirectional both = bidirectional(ccw, fit_circle(ccw), cw, fit_circle(cw));
  EXPECT_NEAR(both.hysteresis_um, 5.0, 1e-6);
  EXPECT_GT(both.hysteresis_at_deg, 179.0);
}

// Different numbers of readings: interpolated; the oval of 3 um between readings 1 deg apart is 3 (1 - cos 1 deg) off.
TEST(Bidirectional, AnglesNeedNotCoincide) {
  const Recording ccw = oval(Direction::CCW, 0.0, 3.0, 0.0, 720);
  const Recording cw = oval(Direction::CW, 1.0, 3.0, 0.0, 361);
  const Bidirectional both = bidirectional(ccw, fit_circle(ccw), cw, fit_circle(cw));
  EXPECT_NEAR(both.hysteresis_um, 1.0, 1e-3);
}

TEST(Bidirectional, BothDirectionsAreOfOneTest) {
  const Recording ccw = oval(Direction::CCW, 2.0, 3.0);
  Recording cw = oval(Direction::CW, 1.0, 1.0);
  EXPECT_TRUE(are_both_directions(ccw, cw));
  EXPECT_TRUE(are_both_directions(cw, ccw));
  EXPECT_FALSE(are_both_directions(ccw, ccw));
  cw.motion = Motion::spindle;
  EXPECT_FALSE(are_both_directions(ccw, cw));
  cw.motion = ccw.motion;
  cw.plane = Plane::YZ;
  EXPECT_FALSE(are_both_directions(ccw, cw));
  cw.plane = ccw.plane;
  cw.nominal_length_mm = 150.0;
  EXPECT_FALSE(are_both_directions(ccw, cw));
}

TEST(Bidirectional, RefusesWhatIsNoPair) {
  const Recording ccw = oval(Direction::CCW, 0.0, 0.0);
  Recording cw = oval(Direction::CW, 0.0, 0.0);
  const Circle circle = fit_circle(ccw);
  const auto message_of = [&](const Recording& second) {
    try {
      bidirectional(ccw, circle, second, circle);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  EXPECT_EQ(message_of(ccw), "both recordings are CCW; ISO 230-4 needs one CCW and one CW");
  cw.plane = Plane::ZX;
  EXPECT_EQ(message_of(cw), "one recording lies in plane XY, the other in ZX; ISO 230-4 needs both in one plane");
}

}  // namespace
}  // namespace ballbar
