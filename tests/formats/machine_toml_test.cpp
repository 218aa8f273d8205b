#include "ballbar/formats/machine_toml.hpp"

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

struct Bad {
  const char* text;  // after the format line
  const char* message;
};

TEST(machine_toml, bad_text) {
  const Bad cases[] = {
      {"metod = \"circles\"",
       "m.toml:2:1: expected one of the keys format, method, title, seed, started, test_min, feed_mm_per_min, plane, "
       "height_offset_mm, spindle_above, bar, setup, c_arc, a_arc, circle, axial, truth, signals, signal, five_probe, "
       "found \"metod\"; the nearest is method."},
      {"method = \"circle\"",
       "m.toml:2:10: expected one of \"two_arcs\", \"spindle_rotation\", \"circles\" for method, found the text "
       "\"circle\"."},
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
