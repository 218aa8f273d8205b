#include "simulate/machine_toml.hpp"

#include <gtest/gtest.h>

#include "ballbar/error.hpp"

namespace ballbar {
namespace {

constexpr const char* kMachine = R"(format = "ballbar-machine 1"
method = "spindle_rotation"
title = "four hours"
seed = 42
started = 1970-01-02T00:00:01
test_min = [0, 15, 30.5]
feed_mm_per_min = 9426
height_offset_mm = 5.0
spindle_above = false
[bar]
nominal_length_mm = 50.0
radius_error_um = 1.5
noise_um = 0.3
autocorrelation = 0.4
resolution_um = 0.05
outlier_share = 0.01
outlier_um = 8.0
[setup]
x_um = 1.0
y_um = 2.0
z_um = 3.0
run_out_um = 4.0
[circle]
start_deg = 10.0
end_deg = 370.0
readings = 720
[axial]
readings = 100
interval_s = 0.02
offset_um = -12.6
[[truth]]
time_min = 0
[[truth]]
time_min = 60
x_um = 1.0
y_um = 2.0
z_um = 3.0
along_bar_um = 4.0
[signals]
interval_s = 20.0
[[signal]]
name = "T_xi_degC"
role = "mean_point"
time_min = [0, 60]
value = [22.5, 31]
noise = 0.02
resolution = 0.01
[[signal]]
name = "speed_rpm"
time_min = [0]
value = [3000]
[five_probe]
spacing_mm = 80.0
interval_s = 30.0
noise_um = 0.2
resolution_um = 0.01
tilt_a_urad_per_um = 1.0
tilt_b_urad_per_um = 2.0
ball_offset_mm = 25.0
)";

TEST(machine_toml, every_key) {
  const VirtualMachine machine = read_machine(kMachine, "m.toml");
  EXPECT_EQ(machine.name, "m.toml");
  EXPECT_EQ(machine.method, Method::spindle_rotation);
  EXPECT_EQ(machine.title, "four hours");
  EXPECT_EQ(machine.seed, 42u);
  EXPECT_EQ(machine.started_s, 86401);
  EXPECT_EQ(machine.test_s, (std::vector<double>{0.0, 900.0, 1830.0}));
  EXPECT_EQ(machine.feed_mm_per_min, 9426.0);
  EXPECT_EQ(machine.height_offset_mm, 5.0);
  EXPECT_FALSE(machine.spindle_above);
  EXPECT_EQ(machine.bar.nominal_length_mm, 50.0);
  EXPECT_EQ(machine.bar.radius_error_um, 1.5);
  EXPECT_EQ(machine.bar.noise_um, 0.3);
  EXPECT_EQ(machine.bar.autocorrelation, 0.4);
  EXPECT_EQ(machine.bar.resolution_um, 0.05);
  EXPECT_EQ(machine.bar.outlier_share, 0.01);
  EXPECT_EQ(machine.bar.outlier_um, 8.0);
  EXPECT_EQ(machine.setup_x_um, 1.0);
  EXPECT_EQ(machine.setup_y_um, 2.0);
  EXPECT_EQ(machine.setup_z_um, 3.0);
  EXPECT_EQ(machine.run_out_um, 4.0);
  EXPECT_EQ(machine.circle.start_deg, 10.0);
  EXPECT_EQ(machine.circle.end_deg, 370.0);
  EXPECT_EQ(machine.circle.readings, 720u);
  EXPECT_EQ(machine.axial.readings, 100u);
  EXPECT_EQ(machine.axial.interval_s, 0.02);
  EXPECT_EQ(machine.axial.offset_um, -12.6);
  ASSERT_EQ(machine.truth.size(), 2u);
  EXPECT_EQ(machine.truth[0].x_um, 0.0);
  EXPECT_EQ(machine.truth[1].time_s, 3600.0);
  EXPECT_EQ(machine.truth[1].x_um, 1.0);
  EXPECT_EQ(machine.truth[1].y_um, 2.0);
  EXPECT_EQ(machine.truth[1].z_um, 3.0);
  EXPECT_EQ(machine.truth[1].along_bar_um, 4.0);
  EXPECT_EQ(machine.interval_s, 20.0);
}

TEST(machine_toml, signals_and_five_probes) {
  const VirtualMachine machine = read_machine(kMachine, "m.toml");
  ASSERT_EQ(machine.signals.size(), 2u);
  EXPECT_EQ(machine.signals[0].name, "T_xi_degC");
  EXPECT_EQ(machine.signals[0].role, Role::mean_point);
  EXPECT_EQ(machine.signals[0].time_s, (std::vector<double>{0.0, 3600.0}));
  EXPECT_EQ(machine.signals[0].value, (std::vector<double>{22.5, 31.0}));
  EXPECT_EQ(machine.signals[0].noise, 0.02);
  EXPECT_EQ(machine.signals[0].resolution, 0.01);
  EXPECT_EQ(machine.signals[1].role, Role::speed);  // from its unit
  EXPECT_TRUE(machine.five_probe.present);
  EXPECT_EQ(machine.five_probe.spacing_mm, 80.0);
  EXPECT_EQ(machine.five_probe.interval_s, 30.0);
  EXPECT_EQ(machine.five_probe.noise_um, 0.2);
  EXPECT_EQ(machine.five_probe.resolution_um, 0.01);
  EXPECT_EQ(machine.five_probe.tilt_a_urad_per_um, 1.0);
  EXPECT_EQ(machine.five_probe.tilt_b_urad_per_um, 2.0);
  EXPECT_EQ(machine.five_probe.ball_offset_mm, 25.0);
}

TEST(machine_toml, the_format_alone_is_a_machine_without_drift) {
  const VirtualMachine machine = read_machine("format = \"ballbar-machine 1\"", "m.toml");
  EXPECT_EQ(machine.method, Method::two_arcs);
  EXPECT_EQ(machine.test_s, std::vector<double>{0.0});
  ASSERT_EQ(machine.truth.size(), 1u);
  EXPECT_EQ(machine.truth[0].z_um, 0.0);
  EXPECT_FALSE(machine.started_s.has_value());
  EXPECT_EQ(simulate(machine).session.tests.size(), 1u);
}

TEST(machine_toml, arcs_and_circles) {
  const VirtualMachine machine = read_machine(
      "format = \"ballbar-machine 1\"\nmethod = \"circles\"\nplane = \"ZX\"\n"
      "[c_arc]\nstart_deg = 1\n[a_arc]\nend_deg = 2\n[circle]\nharmonic2_um = 3\nbacklash_a_um = 4\n",
      "m.toml");
  EXPECT_EQ(machine.plane, Plane::ZX);
  EXPECT_EQ(machine.c_arc.start_deg, 1.0);
  EXPECT_EQ(machine.a_arc.end_deg, 2.0);
  EXPECT_EQ(machine.harmonic2_um, 3.0);
  EXPECT_EQ(machine.backlash_a_um, 4.0);
}

TEST(machine_toml, truth_as_arrays) {
  const VirtualMachine machine =
      read_machine("format = \"ballbar-machine 1\"\n[truth]\ntime_min = [0, 1]\ny_um = [0, 7.5]\n", "m.toml");
  ASSERT_EQ(machine.truth.size(), 2u);
  EXPECT_EQ(machine.truth[1].time_s, 60.0);
  EXPECT_EQ(machine.truth[1].y_um, 7.5);
  EXPECT_EQ(machine.truth[1].x_um, 0.0);
}

constexpr const char* kSpindle = R"(format = "ballbar-machine 1"
method = "series"
seed = 3
[spindle]
time_min = [0, 240]
speed_rpm = [10000, 0]
load_W = [1500, 0]
end_min = 480
room_min = [0, 480]
room_degC = [20.0, 22.5]
off = ["centrifugal", "room"]
interval_s = 30.0
step_s = 10.0
profile_min = [0, 30.5]
[spindle.body]
f0 = 0.6
flange_mm = 180.0
set_point_degC = -5
[spindle.measured]
noise_um = 0.3
tail_freedom = 4
memory_um = 0.5
memory_s = 900
resolution_um = 0.1
temperature_noise_K = 0.05
temperature_resolution_K = 0.2
not_logged = ["T_room_degC"]
)";

TEST(machine_toml, spindle) {
  const VirtualMachine machine = read_machine(kSpindle, "m.toml");
  EXPECT_TRUE(machine.series);
  EXPECT_TRUE(machine.truth.empty());
  ASSERT_TRUE(machine.spindle.has_value());
  const VirtualSpindle& spindle = *machine.spindle;
  EXPECT_EQ(spindle.plan.time_s, (std::vector<double>{0.0, 14400.0}));
  EXPECT_EQ(spindle.plan.speed_rpm, (std::vector<double>{10000.0, 0.0}));
  EXPECT_EQ(spindle.plan.load_W, (std::vector<double>{1500.0, 0.0}));
  EXPECT_EQ(spindle.plan.end_s, 28800.0);
  EXPECT_EQ(spindle.plan.room_time_s, (std::vector<double>{0.0, 28800.0}));
  EXPECT_EQ(spindle.plan.room_degC, (std::vector<double>{20.0, 22.5}));
  EXPECT_FALSE(spindle.mechanisms.centrifugal);
  EXPECT_FALSE(spindle.mechanisms.room);
  EXPECT_TRUE(spindle.mechanisms.viscosity);
  EXPECT_EQ(spindle.clock.interval_s, 30.0);
  EXPECT_EQ(spindle.clock.step_s, 10.0);
  EXPECT_EQ(spindle.clock.profile_s, (std::vector<double>{0.0, 1830.0}));
  EXPECT_EQ(spindle.body.f0, 0.6);
  EXPECT_EQ(spindle.body.flange_mm, 180.0);
  EXPECT_EQ(spindle.body.set_point_degC, -5.0);
  EXPECT_EQ(spindle.body.head_kg, FiniteVolumeSpindle{}.head_kg);
  EXPECT_EQ(spindle.measurement.noise_um, 0.3);
  EXPECT_EQ(spindle.measurement.tail_freedom, 4.0);
  EXPECT_EQ(spindle.measurement.memory_um, 0.5);
  EXPECT_EQ(spindle.measurement.memory_s, 900.0);
  EXPECT_EQ(spindle.measurement.resolution_um, 0.1);
  EXPECT_EQ(spindle.measurement.temperature_noise_K, 0.05);
  EXPECT_EQ(spindle.measurement.temperature_resolution_K, 0.2);
  EXPECT_EQ(spindle.measurement.not_logged, std::vector<std::string>{"T_room_degC"});
}

// The run has a row at or after the last test.
TEST(machine_toml, spindle_of_a_session_lasts_to_its_last_test) {
  const VirtualMachine machine = read_machine(
      "format = \"ballbar-machine 1\"\ntest_min = [0, 7.1]\n[spindle]\ntime_min = [0]\nspeed_rpm = [5000]\n", "m.toml");
  EXPECT_FALSE(machine.series);
  EXPECT_EQ(machine.spindle->plan.end_s, 426.0 + 15.0);
  EXPECT_EQ(simulate(machine).session.tests.size(), 2u);
}

struct Bad {
  const char* text;  // after the format line
  const char* message;
};

TEST(machine_toml, bad_text) {
  const Bad cases[] = {
      {"metod = \"circles\"",
       "m.toml:2:1: expected one of the keys format, method, title, seed, started, test_min, feed_mm_per_min, plane, "
       "height_offset_mm, spindle_above, bar, setup, c_arc, a_arc, circle, axial, truth, signals, signal, five_probe, "
       "spindle, found \"metod\"; the nearest is method."},
      {"method = \"circle\"",
       "m.toml:2:10: expected one of \"two_arcs\", \"spindle_rotation\", \"circles\", \"series\" for method, found "
       "the text \"circle\"."},
      {"seed = -1", "m.toml:2:8: expected a count not below 0 for seed, found -1."},
      {"[bar]\nnominal_length_mm = 0",
       "m.toml:3:21: expected a number above 0 for nominal_length_mm, found the integer 0."},
      {"[bar]\nnoise_mm = 1",
       "m.toml:3:1: expected one of the keys nominal_length_mm, radius_error_um, noise_um, autocorrelation, "
       "resolution_um, outlier_share, outlier_um in [bar], found \"noise_mm\"; the nearest is noise_um."},
      {"[c_arc]\nreadings = 1.5", "m.toml:3:12: expected an integer for readings, found the number 1.5."},
      {"[c_arc]\nharmonic2_um = 1",
       "m.toml:3:1: expected one of the keys start_deg, end_deg, readings in [c_arc], found \"harmonic2_um\"; the "
       "nearest is readings."},
      {"[truth]\nx_um = [1]", "m.toml:2:1: expected the key time_min in [truth], found none."},
      {"[truth]\ntime_min = [0, 1]\nx_um = [1]",
       "m.toml:4:8: expected as many values for x_um as for time_min, 2, found 1."},
      {"[[truth]]\nx_um = 1", "m.toml:2:1: expected the key time_min in [[truth]] 1, found none."},
      {"truth = 3", "m.toml:2:9: expected tables [[truth]] for truth, found the integer 3."},
      {"[[signal]]\nname = \"T_degC\"\ntime_min = [0]\nvalue = [1, 2]",
       "m.toml:5:9: expected as many values as for time_min, 1, found 2."},
      {"[[signal]]\nname = \"T_degC\"\nrole = \"air\"",
       "m.toml:4:8: expected one of \"structure\", \"ambient\", \"coolant\", \"bearing\", \"mean_point\", "
       "\"housing\", \"speed\", \"load\", \"event\", \"measured\" for role, found the text \"air\"."},
      {"[five_probe]\nspacing_mm = -60.0",
       "m.toml:3:14: expected a number above 0 for spacing_mm, found the number -60."},
      {"[signals]\ninterval_min = 1",
       "m.toml:3:1: expected no key but interval_s in [signals], found \"interval_min\"."},
      {"method = \"series\"", "m.toml:1:1: expected the key spindle, found none."},
      {"method = \"series\"\n[spindle]\ntime_min = [0]\nspeed_rpm = [1]\n[bar]\nnoise_um = 1",
       "m.toml:6:1: expected nothing but title, seed and [spindle] beside method = \"series\", which has no ballbar, "
       "found bar."},
      {"method = \"series\"\n[spindle]\ntime_min = [0]\nspeed_rpm = [1]",
       "m.toml:3:1: expected the key end_min in [spindle], found none."},
      {"[truth]\ntime_min = [0]\n[spindle]\ntime_min = [0]\nspeed_rpm = [1]",
       "m.toml:2:1: expected the truth from [spindle] alone, found truth as well."},
      {"[spindle]\nspeed_rpm = [1]", "m.toml:2:1: expected the key time_min in [spindle], found none."},
      {"[spindle]\ntime_min = [0, 5, 5]", "m.toml:3:19: expected rising times for time_min, found 5 after 5."},
      {"[spindle]\ntime_min = []", "m.toml:3:12: expected at least one time for time_min, found an array."},
      {"[spindle]\ntime_min = [0, 5]\nspeed_rpm = [1]",
       "m.toml:4:13: expected as many values for speed_rpm as for time_min, 2, found 1."},
      {"[spindle]\ntime_min = [0, 5]\nspeed_rpm = [1, -2]",
       "m.toml:4:17: expected numbers not below 0 for speed_rpm, found -2."},
      {"[spindle]\ntime_min = [0, 5]\nspeed_rpm = [1, 2]\nend_min = 4",
       "m.toml:5:11: expected an end_min at or after the last of time_min, 5, found 4."},
      {"[spindle]\ntime_min = [0]\nspeed_rpm = [1]\nroom_degC = [20]",
       "m.toml:2:1: expected the key room_min in [spindle], found none."},
      {"[spindle]\ntime_min = [0]\nspeed_rpm = [1]\nroom_min = [0, 1]\nroom_degC = [20]",
       "m.toml:6:13: expected as many values for room_degC as for room_min, 2, found 1."},
      {"[spindle]\ntime_min = [0]\nspeed_rpm = [1]\noff = [\"room\", \"gravity\"]",
       "m.toml:5:16: expected one of viscosity, convection, asymmetry, rings, centrifugal, thermostat, coolant, room, "
       "structure in off, found \"gravity\"."},
      {"[spindle]\ntime_min = [0]\nspeed_rpm = [1]\nprofile_min = [30, 20]",
       "m.toml:5:20: expected rising times for profile_min, found 20 after 30."},
      {"[spindle]\ntime_min = [0]\nspeed_rpm = [1]\nprofile_min = []",
       "m.toml:5:15: expected at least one time for profile_min, found an array."},
      {"[spindle]\ntime_min = [0]\nspeed_rpm = [1]\nprofile = [30]",
       "m.toml:5:1: expected one of the keys time_min, speed_rpm, load_W, end_min, room_min, room_degC, off, "
       "interval_s, step_s, profile_min, image, body, measured in [spindle], found \"profile\"; the nearest is "
       "profile_min."},
      {"[spindle]\ntime_min = [0]\nspeed_rpm = [1]\n[spindle.body]\nhead_kg = -120",
       "m.toml:6:11: expected a number above 0 for head_kg, found the integer -120."},
      {"[spindle]\ntime_min = [0]\nspeed_rpm = [1]\n[spindle.body]\npump_W = -0.5",
       "m.toml:6:10: expected a number not below 0 for pump_W, found the number -0.5."},
      {"[spindle]\ntime_min = [0]\nspeed_rpm = [1]\n[spindle.body]\nhead_mass = 1",
       "m.toml:6:1: expected one of the 77 known keys in [spindle.body], found \"head_mass\"; the nearest is "
       "head_kg."},
      {"[spindle]\ntime_min = [0]\nspeed_rpm = [1]\n[spindle.measured]\nnoise = 1",
       "m.toml:6:1: expected one of the keys noise_um, tail_freedom, memory_um, memory_s, resolution_um, "
       "temperature_noise_K, temperature_resolution_K, not_logged in [spindle.measured], found \"noise\"; the nearest "
       "is "
       "noise_um."},
  };
  for (const Bad& bad : cases) {
    try {
      read_machine(std::string("format = \"ballbar-machine 1\"\n") + bad.text, "m.toml");
      ADD_FAILURE() << "accepted: " << bad.text;
    } catch (const Error& error) {
      EXPECT_STREQ(error.what(), bad.message);
    }
  }
}

TEST(machine_toml, another_format) {
  const auto complaint = [](const char* text) -> std::string {
    try {
      read_machine(text, "m.toml");
    } catch (const Error& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_EQ(complaint("format = \"ballbar-session 1\""),
            "m.toml:1:10: expected format = \"ballbar-machine 1\", found \"ballbar-session 1\".");
  EXPECT_EQ(complaint("method = \"circles\""), "m.toml:1:1: expected the key format, found none.");
}

}  // namespace
}  // namespace ballbar
