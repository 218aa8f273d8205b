#include "ballbar/formats/recordings/circle_table.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "ballbar/error.hpp"
#include "ballbar/formats/text/reader.hpp"
#include "ballbar/units.hpp"

namespace ballbar {
namespace {

constexpr int kReadings = 360;

// Of a circle of no more than a scale mismatch: 4 um cos 2t.
double deviation_um(double angle_rad) { return 4.0 * std::cos(2.0 * angle_rad); }

double angle_rad_of(int i, bool ccw = true) { return rad_from_deg((ccw ? i : kReadings - 1 - i) * 360.0 / kReadings); }

std::string with_commas(std::string text) {
  for (char& c : text) c = c == '.' ? ',' : c;
  return text;
}

using Row = std::function<std::string(double angle_rad, double radius_mm)>;

std::string rows(double radius_mm, const Row& row, bool ccw = true) {
  std::string text;
  for (int i = 0; i < kReadings; ++i) {
    const double angle_rad = angle_rad_of(i, ccw);
    text += row(angle_rad, radius_mm + mm_from_um(deviation_um(angle_rad))) + '\n';
  }
  return text;
}

std::string polar(double angle_rad, double radius_mm) {
  return fmt::format("{:.4f};{:.6f}", deg_from_rad(angle_rad), radius_mm);
}

std::string point(double angle_rad, double radius_mm) {
  return fmt::format("{:.6f}\t{:.6f}", radius_mm * std::cos(angle_rad), radius_mm * std::sin(angle_rad));
}

// The text is known as a circle, and read as these runs of that radius.
RecordingFile expect_circle(const std::string& text, double radius_mm, std::vector<Direction> directions,
                            const StatedCircle& stated = {}) {
  EXPECT_EQ(found_in(reader_of(text)), "a circle in a table of numbers");
  RecordingFile file = read_circle_table(text, "f", stated);
  EXPECT_EQ(file.recordings.size(), directions.size());
  for (std::size_t k = 0; k < std::min(directions.size(), file.recordings.size()); ++k) {
    const Recording& recording = file.recordings[k];
    EXPECT_EQ(recording.direction, directions[k]);
    EXPECT_NEAR(recording.nominal_length_mm, radius_mm, 1e-12);
    EXPECT_EQ(recording.length_mm.size(), static_cast<std::size_t>(kReadings));
    for (std::size_t i = 0; i < recording.length_mm.size(); ++i) {
      EXPECT_NEAR(recording.length_mm[i], radius_mm + mm_from_um(deviation_um(recording.angle_rad[i])), 2e-6);
    }
  }
  return file;
}

std::string complaint_of(const std::string& text, const StatedCircle& stated = {}) {
  try {
    read_circle_table(text, "f", stated);
  } catch (const Error& error) {
    return error.what();
  }
  return "no complaint";
}

TEST(circle_table, angle_and_radius_with_semicolons_and_decimal_commas) {
  const std::string text = "Winkel [°];Radius [mm]\n" + with_commas(rows(100.0, polar));
  const RecordingFile file = expect_circle(text, 100.0, {Direction::CCW}, {100.0});
  EXPECT_EQ(file.recordings[0].plane, Plane::XY);
  EXPECT_EQ(file.remarks, (std::vector<std::string>{"f: read as a circle from angles in deg and lengths in mm; plane "
                                                    "XY (not stated), nominal radius 100 mm; CCW of 360 readings."}));
}

TEST(circle_table, without_a_header) {
  expect_circle(rows(
                    100.0, [](double t, double r) { return fmt::format("{:.3f},{:.6f}", deg_from_rad(t), r); }, false),
                100.0, {Direction::CW}, {100.0});
  expect_circle(rows(100.0, [](double t, double r) { return fmt::format("{:.6f} {:.6f}", t, r); }), 100.0,
                {Direction::CCW}, {100.0});
}

TEST(circle_table, the_heading_angle_and_length_is_no_log) {
  const std::string text = "angle,length\n" + rows(100.0, [](double t, double r) {
                             return fmt::format("{:.3f},{:.6f}", deg_from_rad(t), r);
                           });
  expect_circle(text, 100.0, {Direction::CCW}, {100.0});
}

TEST(circle_table, units_are_those_of_the_header_or_the_likely_ones) {
  const auto um_of = [](double t, double r) { return fmt::format("{:.6f};{:.4f}", t, um_from_mm(r - 100.0)); };
  expect_circle("phi [rad];deviation [um]\n" + rows(100.0, um_of), 100.0, {Direction::CCW}, {100.0});
  expect_circle("phi;deviation\n" + rows(100.0, um_of), 100.0, {Direction::CCW}, {100.0});
  const auto mm_of = [](double t, double r) { return fmt::format("{:.4f};{:.7f}", deg_from_rad(t), r - 100.0); };
  expect_circle("phi;deviation\n" + rows(100.0, mm_of), 100.0, {Direction::CCW}, {100.0});
  const auto long_um = [](double t, double r) { return fmt::format("{:.4f};{:.3f}", deg_from_rad(t), um_from_mm(r)); };
  expect_circle("phi;radius\n" + rows(100.0, long_um), 100.0, {Direction::CCW}, {100.0});
}

TEST(circle_table, a_column_a_direction) {
  const std::string text = "Angle deg\tCCW mm\tCW mm\n" + rows(100.0, [](double t, double r) {
                             return fmt::format("{:.4f}\t{:.6f}\t{:.6f}", deg_from_rad(t), r, r);
                           });
  expect_circle(text, 100.0, {Direction::CCW, Direction::CW}, {100.0});
}

// Both directions one after the other, with the way in along a radius; the centre is anywhere on the machine.
TEST(circle_table, coordinates_with_what_the_header_states) {
  const Row row = [](double t, double r) {
    return fmt::format("{:.6f}\t{:.6f}", 250.0 + r * std::cos(t), -80.0 + r * std::sin(t));
  };
  std::string text = "Grid encoder\nNominal radius: 50,000 mm\nFeedrate: 1000 mm/min\n\nX [mm]\tY [mm]\n";
  for (int i = 10; i < 20; ++i) text += fmt::format("{:.6f}\t{:.6f}\n", 250.0 + 2.0 * i, -80.0);
  text = with_commas(text + rows(50.0, row) + rows(50.0, row, false));
  EXPECT_EQ(found_in(reader_of(text)), "a circle in a table of numbers");
  const RecordingFile file = read_circle_table(text, "f", {});
  ASSERT_EQ(file.recordings.size(), 2u);
  EXPECT_EQ(file.recordings[0].direction, Direction::CCW);
  EXPECT_EQ(file.recordings[1].direction, Direction::CW);
  EXPECT_EQ(file.recordings[0].nominal_length_mm, 50.0);
  EXPECT_EQ(file.recordings[0].feed_mm_per_min, 1000.0);
  for (const Recording& recording : file.recordings) {
    EXPECT_NEAR(static_cast<double>(recording.length_mm.size()), kReadings, 1.0);
    for (std::size_t i = 0; i < recording.length_mm.size(); ++i) {
      // 0.1 um: the centre is the fitted one
      EXPECT_NEAR(recording.length_mm[i], 50.0 + mm_from_um(deviation_um(recording.angle_rad[i])), 1e-4);
    }
  }
}

TEST(circle_table, x_and_z_are_the_plane_zx) {
  // From Z towards X: CCW of the plane ZX.
  const std::string text = "Radius 100\nX;Z\n" + rows(100.0, [](double t, double r) {
                             return fmt::format("{:.6f};{:.6f}", r * std::sin(t), r * std::cos(t));
                           });
  const RecordingFile file = expect_circle(text, 100.0, {Direction::CCW});
  EXPECT_EQ(file.recordings[0].plane, Plane::ZX);
}

TEST(circle_table, the_commanded_path_states_the_radius_and_the_time_the_feed) {
  int i = 0;
  const std::string text = "Time [s];X cmd;Y cmd;X act;Y act\n" + rows(50.0, [&](double t, double r) {
                             return fmt::format("{:.4f};{:.6f};{:.6f};{:.6f};{:.6f}", 0.01 * i++, 50.0 * std::cos(t),
                                                50.0 * std::sin(t), r * std::cos(t), r * std::sin(t));
                           });
  const RecordingFile file = expect_circle(text, 50.0, {Direction::CCW});
  // 50 mm x 1 deg in 0.01 s
  EXPECT_NEAR(file.recordings[0].feed_mm_per_min.value_or(0.0), 50.0 * rad_from_deg(1.0) / 0.01 * 60.0, 0.1);
  EXPECT_NEAR(file.recordings[0].time_s.back(), 3.59, 1e-9);
}

TEST(circle_table, assumes_a_whole_radius_and_asks_for_that_of_deviations) {
  const RecordingFile assumed = read_circle_table(rows(49.987, point), "f", {});
  EXPECT_EQ(assumed.recordings.front().nominal_length_mm, 50.0);
  EXPECT_NE(assumed.remarks.front().find("nominal radius 50 mm (assumed)"), std::string::npos);
  EXPECT_EQ(complaint_of(rows(49.987, point), {100.0}),
            "f: expected a circle of about the nominal radius 100 mm that --radius states, found one of 49.9870 mm.");
  const auto um_of = [](double t, double r) {
    return fmt::format("{:.4f};{:.4f}", deg_from_rad(t), um_from_mm(r - 100.0));
  };
  EXPECT_EQ(complaint_of("angle;deviation\n" + rows(100.0, um_of)),
            "f: expected the nominal radius of this circle, found only deviations. State it, as in --radius 100mm.");
}

// An arc from 10 deg, n readings, each a row.
std::string arc(double arc_deg, const Row& row, int n = 200) {
  std::string text;
  for (int i = 0; i < n; ++i) {
    const double angle_rad = rad_from_deg(10.0 + i * arc_deg / (n - 1));
    text += row(angle_rad, 100.0 + mm_from_um(deviation_um(angle_rad))) + '\n';
  }
  return text;
}

std::string um_over_deg(double angle_rad, double radius_mm) {
  return fmt::format("{:.3f};{:.2f}", deg_from_rad(angle_rad), um_from_mm(radius_mm - 100.0));
}

TEST(circle_table, an_arc_of_any_length) {
  const auto expect_arc = [](const std::string& text, std::size_t runs = 1) {
    SCOPED_TRACE(text.substr(0, 80));
    EXPECT_EQ(found_in(reader_of(text)), "a circle in a table of numbers");
    const RecordingFile file = read_circle_table(text, "f", {});
    ASSERT_EQ(file.recordings.size(), runs);
    for (const Recording& recording : file.recordings) {
      EXPECT_EQ(recording.nominal_length_mm, 100.0);
      EXPECT_GE(recording.length_mm.size(), 195u) << "of 200";
      EXPECT_NEAR(recording.length_mm.front(), 100.0 + mm_from_um(deviation_um(recording.angle_rad.front())), 2e-5);
    }
  };
  const Row point_mm = [](double t, double r) {
    return fmt::format("{:.5f},{:.5f}", r * std::cos(t), r * std::sin(t));
  };
  const Row um_first = [](double t, double r) {
    return fmt::format("{:.2f}\t{:.3f}", um_from_mm(r - 100.0), deg_from_rad(t));
  };
  const Row um_over_rad = [](double t, double r) { return fmt::format("{:.6f};{:.2f}", t, um_from_mm(r - 100.0)); };
  for (const double arc_deg : {12.0, 40.0, 120.0}) {
    expect_arc("X_mm,Y_mm\n" + arc(arc_deg, point_mm));
    expect_arc("Radius: 100 mm\nangle_deg;deviation_um\n" + arc(arc_deg, um_over_deg));
    expect_arc("Radius: 100 mm\nphi_rad;dr_um\n" + arc(arc_deg, um_over_rad));
    expect_arc("Radius: 100 mm\nAbweichung [um]\tWinkel [Grad]\n" + with_commas(arc(arc_deg, um_first)));
  }
  // Without names, or without the unit of the angle, from 60 deg.
  expect_arc(arc(110.0, point_mm));
  expect_arc("Radius: 100 mm\n" + arc(110.0, um_over_deg));
  expect_arc("Radius: 100 mm\nphi;dr_um\n" + arc(80.0, um_over_rad));
  // Both directions of a short arc.
  std::string back = arc(20.0, um_over_deg);
  for (int i = 199; i >= 0; --i) {
    const double angle_rad = rad_from_deg(10.0 + i * 20.0 / 199);
    back += um_over_deg(angle_rad, 100.0 + mm_from_um(deviation_um(angle_rad))) + '\n';
  }
  expect_arc("Radius: 100 mm\nangle_deg;deviation_um\n" + back, 2);
}

// Bent curves of slow logs, and an angle that is one column of many.
TEST(circle_table, bent_curves_of_logs_are_no_arcs) {
  std::string drift = "time_s,x_um,y_um\n", drift_mm = "time_s,x_mm,y_mm\n", two = "", temperatures = "time_s;T1;T2\n",
              tilt = "time_s,angle_deg,deviation_um,T_degC\n", lean = "time_s,angle_deg,deviation_um\n";
  for (int i = 0; i < 2000; ++i) {
    const double fast = 1.0 - std::exp(-i / 300.0), slow = 1.0 - std::exp(-i / 700.0);
    drift += fmt::format("{},{:.3f},{:.3f}\n", 10 * i, 30.0 * fast, 60.0 * slow);
    drift_mm += fmt::format("{},{:.6f},{:.6f}\n", 10 * i, 0.03 * fast, 0.06 * slow);
    two += fmt::format("{:.3f},{:.3f}\n", 30.0 * fast, 60.0 * slow);
    temperatures += fmt::format("{};{:.3f};{:.3f}\n", 10 * i, 20.0 + 5.0 * fast, 20.0 + 4.0 * slow);
    tilt += fmt::format("{},{:.4f},{:.3f},{:.2f}\n", 10 * i, 20.0 * fast, 60.0 * slow, 20.0 + 0.01 * i);
    lean += fmt::format("{},{:.4f},{:.3f}\n", 10 * i, 0.02 * fast + 0.001 * std::sin(i), 60.0 * slow);
  }
  for (const std::string& text : {drift, drift_mm, two, temperatures, tilt, lean}) {
    EXPECT_FALSE(holds_circle(text)) << text.substr(0, 40);
  }
}

TEST(circle_table, other_tables_are_none) {
  const auto kind = [](const std::string& text) { return found_in(reader_of(text)); };
  std::string temperatures = "Zeit [s];T1 [°C];T2 [°C]\n", rotary = "angle;error [arcsec]\n", oven = "t;a\n";
  for (int i = 0; i < kReadings; ++i) {
    temperatures +=
        fmt::format("{};{:.2f};{:.2f}\n", 10 * i, 20.0 + 5.0 * (1.0 - std::exp(-0.01 * i)), 20.0 + 0.01 * i);
    rotary += fmt::format("{};{:.2f}\n", i, 2.0 * std::sin(rad_from_deg(i)));
    oven += fmt::format("{};{:.3f}\n", i, 20.0 + 0.001 * i);
  }
  EXPECT_EQ(kind(with_commas(temperatures)), "a log of columns over time");
  EXPECT_EQ(kind(rotary), "a log of columns over time");
  EXPECT_EQ(kind(oven), "a log of columns over time");
  EXPECT_FALSE(holds_circle(""));
  EXPECT_FALSE(holds_circle("1e308;1e308\n-1e308;1e308\n"));
  // On one line, and all one point.
  EXPECT_FALSE(holds_circle("X;Y\n" + rows(50.0, [](double t, double) { return fmt::format("{:.3f};{:.3f}", t, t); })));
  EXPECT_FALSE(holds_circle("X;Y\n" + rows(50.0, [](double, double) { return std::string("50.0;50.0"); })));
}

// Two heaters, each off at 25 or on at 95 and 100: the corners of a rectangle, which a circle passes, with a few rows
// on the way between them.
TEST(circle_table, temperatures_that_rest_at_levels_are_none) {
  std::string text = "sample,bed_t,he_t\n";
  double bed = 25.0, he = 25.0;
  for (int i = 0; i < 400; ++i) {
    const double bed_wanted = i / 100 % 2 == 0 ? 25.0 : 95.0, he_wanted = i / 100 < 2 ? 25.0 : 100.0;
    bed += 0.6 * (bed_wanted - bed);
    he += 0.6 * (he_wanted - he);
    text += fmt::format("0,{:.3f},{:.3f}\n", bed + 0.2 * std::sin(7.0 * i), he + 0.2 * std::cos(5.0 * i));
  }
  EXPECT_FALSE(holds_circle(text));
}

// Of a longer file only the head is looked at.
TEST(circle_table, is_known_by_the_first_part_of_a_long_file) {
  std::string text = "Radius;50\nX;Y\n";
  for (int i = 0; i < 20000; ++i) {
    const double angle_rad = 2.0 * kPi * i / 20000.0;
    text += fmt::format("{:.6f};{:.6f}\n", 50.0 * std::cos(angle_rad), 50.0 * std::sin(angle_rad));
  }
  EXPECT_EQ(found_in(reader_of(text)), "a circle in a table of numbers");
  EXPECT_EQ(read_circle_table(text, "f", {}).recordings.front().length_mm.size(), 20000u);
}

// An arc of 140 deg about (0.002, 0.003) m.
std::string arc_in_metres(bool timed) {
  std::string text;
  for (int i = 0; i < 140; ++i) {
    const double angle_rad = rad_from_deg(100.0 + i);
    if (timed) text += fmt::format("{:.2f},", 3.0 + 0.05 * i);
    text += fmt::format("{:.7f},{:.7f},0.734970\n", 0.002 + 0.274 * std::cos(angle_rad),
                        0.003 + 0.274 * std::sin(angle_rad));
  }
  return text;
}

TEST(circle_table, metres_are_known_by_their_size_or_stated) {
  for (const bool timed : {false, true}) {
    for (const bool stated : {false, true}) {
      const std::string text = arc_in_metres(timed);
      EXPECT_EQ(found_in(reader_of(text)), "a circle in a table of numbers");
      StatedCircle how;
      if (stated) how.table.columns.push_back({"*", "", "m", std::nullopt, false});
      const RecordingFile file = read_circle_table(text, "f", how);
      ASSERT_EQ(file.recordings.size(), 1u);
      EXPECT_NEAR(file.recordings.front().nominal_length_mm, 274.0, 1e-12);
      EXPECT_EQ(file.recordings.front().length_mm.size(), 140u);
      EXPECT_NE(file.remarks.front().find(stated ? "in m, from" : "in m (read as metres by their size), from"),
                std::string::npos)
          << file.remarks.front();
    }
  }
}

TEST(circle_table, inches_are_known_by_a_usual_radius) {
  // 100 mm are 3.93701 in.
  const RecordingFile file = read_circle_table(rows(100.0 / 25.4, point), "f", {});
  EXPECT_NEAR(file.recordings.front().nominal_length_mm, 100.0, 1e-12);
}

TEST(circle_table, of_three_coordinates_the_order_tells_the_plane) {
  std::string text;
  for (int i = 0; i < 360; i += 2)
    text += fmt::format("{:.5f};7.5;{:.5f}\n", 50.0 * std::sin(rad_from_deg(i)), 50.0 * std::cos(rad_from_deg(i)));
  const RecordingFile file = read_circle_table(text, "f", {});
  EXPECT_EQ(file.recordings.front().plane, Plane::ZX);
  EXPECT_EQ(file.recordings.front().direction, Direction::CCW);
}

TEST(circle_table, points_in_any_order_are_sorted_by_angle) {
  std::string json = "[", polar_text = "angle_deg;radius_mm\n";
  for (int i = 0; i < 24; ++i) {
    const double angle_rad = rad_from_deg(15.0 * ((7 * i) % 24 + (i % 3 == 0 ? 5 : 0)));
    const double radius_mm = 50.0 + mm_from_um(deviation_um(angle_rad));
    json += fmt::format("{}{{\"No\": {}, \"x\": {:.6f}, \"y\": {:.6f}}}", i == 0 ? "" : ", ", i + 1,
                        10.0 + radius_mm * std::cos(angle_rad), 20.0 + radius_mm * std::sin(angle_rad));
    polar_text += polar(angle_rad, radius_mm) + '\n';
  }
  for (const std::string& text : {json + "]", polar_text}) {
    EXPECT_EQ(found_in(reader_of(text)), "a circle in a table of numbers");
    const RecordingFile file = read_circle_table(text, "f", {});
    ASSERT_EQ(file.recordings.size(), 1u);
    const Recording& recording = file.recordings.front();
    EXPECT_EQ(recording.direction, Direction::CCW);
    EXPECT_TRUE(std::is_sorted(recording.angle_rad.begin(), recording.angle_rad.end()));
    EXPECT_NE(file.remarks.front().find("sorted by angle"), std::string::npos);
  }
}

// Two temperatures that swing a quarter of a period apart.
TEST(circle_table, temperatures_by_dates_are_no_circle) {
  std::string text = "sample,time,pos_steps,frame_t,bed_t\n";
  for (int i = 0; i < 360; ++i) {
    text += fmt::format("{},2026/03/14-08:{:02}:{:02},-8000,{:.4f},{:.4f}\n", i / 6, i / 60, i % 60,
                        25.0 + 2.0 * std::cos(rad_from_deg(i)), 25.0 + 2.0 * std::sin(rad_from_deg(i)));
  }
  EXPECT_EQ(found_in(reader_of(text)), "a log of columns over time");
}

}  // namespace
}  // namespace ballbar
