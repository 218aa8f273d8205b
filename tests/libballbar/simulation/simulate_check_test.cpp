// Contradictory virtual machines: what is refused, and in which words.
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "ballbar/error.hpp"
#include "ballbar/lab/simulation/simulate.hpp"

namespace ballbar {
namespace {

VirtualMachine with_everything() {
  VirtualMachine machine;
  machine.truth = {{0.0, 0.0, 0.0, 0.0, 0.0}, {1200.0, 4.0, 30.0, 5.0, 0.0}};
  machine.test_s = {0.0, 600.0};
  machine.signals = {{"T_air_degC", Role::ambient, {0.0}, {20.0}, 0.05, 0.01}};
  machine.five_probe.present = true;
  return machine;
}

struct Bad {
  const char* message;
  std::function<void(VirtualMachine&)> spoil;
};

TEST(SimulateErrors, EachSaysWhatWasExpectedAndFound) {
  using M = VirtualMachine;
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const Bad cases[] = {
      {"expected a truth of at least one point, found none.", [](M& m) { m.truth.clear(); }},
      {"expected rising times for the truth, found 20 min after 20 min.", [](M& m) { m.truth[0].time_s = 1200.0; }},
      {"expected a finite number for the truth's z_um, found nan.", [](M& m) { m.truth[1].z_um = kNan; }},
      {"the truth's along_bar_um belongs to method spindle_rotation, and the method is two_arcs.",
       [](M& m) { m.truth[1].along_bar_um = 1.0; }},
      {"expected at least one test, found none.", [](M& m) { m.test_s.clear(); }},
      {"expected rising times for the tests, found 5 min after 10 min.",
       [](M& m) {
         m.test_s = {600.0, 300.0};
       }},
      {"expected tests within the truth, 0 to 20 min, found one at 30 min.",
       [](M& m) {
         m.test_s = {0.0, 1800.0};
       }},
      {"expected a number above 0 for nominal_length_mm, found 0.", [](M& m) { m.bar.nominal_length_mm = 0.0; }},
      {"expected a number above 0 for nominal_length_mm + radius_error_um, found -100.",
       [](M& m) { m.bar.radius_error_um = -200e3; }},
      {"expected a number above 0 for feed_mm_per_min, found -1.", [](M& m) { m.feed_mm_per_min = -1.0; }},
      {"expected a number not below 0 for the bar's noise_um, found -0.1.", [](M& m) { m.bar.noise_um = -0.1; }},
      {"expected a number not below 0 for the bar's resolution_um, found -1.",
       [](M& m) { m.bar.resolution_um = -1.0; }},
      {"expected an autocorrelation from 0 to below 1, found 1.", [](M& m) { m.bar.autocorrelation = 1.0; }},
      {"expected an outlier_share from 0 to 1, found 2.", [](M& m) { m.bar.outlier_share = 2.0; }},
      {"expected a finite number for the set-up's x_um, found nan.", [](M& m) { m.setup_x_um = kNan; }},
      {"expected an arc above 0 and up to 360 deg for c_arc, found 90 to 90 deg.",
       [](M& m) { m.c_arc.end_deg = 90.0; }},
      {"expected an arc above 0 and up to 360 deg for a_arc, found -20 to 341 deg.",
       [](M& m) { m.a_arc.end_deg = 341.0; }},
      {"expected 1 to 1000000 readings for a_arc, found 0.", [](M& m) { m.a_arc.readings = 0; }},
      {"plane ZX belongs to method circles, and the method is two_arcs.", [](M& m) { m.plane = Plane::ZX; }},
      {"harmonic2_um belongs to method circles, and the method is two_arcs.", [](M& m) { m.harmonic2_um = 1.0; }},
      {"run_out_um belongs to method spindle_rotation, and the method is two_arcs.", [](M& m) { m.run_out_um = 1.0; }},
      {"spindle_above = false belongs to method spindle_rotation, and the method is two_arcs.",
       [](M& m) { m.spindle_above = false; }},
      {"expected a number above 0 for interval_s, found 0.", [](M& m) { m.interval_s = 0.0; }},
      {"expected at most 10000000 rows for the signals, found 600000000; widen interval_s.",
       [](M& m) { m.interval_s = 1e-6; }},
      {"expected a name ending in its unit (_um, _mm, _degC, _rpm, _A, _W, _K), found signal \"air\".",
       [](M& m) { m.signals[0].name = "air"; }},
      {"expected one signal of each name, found signal \"T_air_degC\" twice.",
       [](M& m) { m.signals.push_back(m.signals[0]); }},
      {"expected as many values as times, at least one, for signal \"T_air_degC\", found 1 times and 0 values.",
       [](M& m) { m.signals[0].value.clear(); }},
      {"expected a number not below 0 for signal \"T_air_degC\" noise, found -1.",
       [](M& m) { m.signals[0].noise = -1.0; }},
      {"expected a number above 0 for the five probes' spacing_mm, found 0.",
       [](M& m) { m.five_probe.spacing_mm = 0.0; }},
      {"expected a number not below 0 for the five probes' noise_um, found -1.",
       [](M& m) { m.five_probe.noise_um = -1.0; }},
      {"expected readings at least 0.01 ms apart, found 1500 in 0.006283185307179587 s for c_arc; lower the feed or "
       "the "
       "readings.",
       [](M& m) { m.feed_mm_per_min = 6e6; }},
      {"the two balls meet: a reading comes to 0 mm, and a length must be above 0.",
       [](M& m) {
         m.truth = {{0.0, 100e3, 0.0, 0.0, 0.0}};
         m.c_arc = {-10.0, 10.0, 1};  // its one reading is at 0 deg
         m.bar.noise_um = 0.0;
       }},
  };
  for (const Bad& bad : cases) {
    VirtualMachine machine = with_everything();
    bad.spoil(machine);
    try {
      simulate(machine);
      ADD_FAILURE() << "accepted, expected: " << bad.message;
    } catch (const Error& error) {
      EXPECT_EQ(std::string(error.what()), std::string("virtual machine: ") + bad.message);
    }
  }
}

}  // namespace
}  // namespace ballbar
