// Files as people and their programs write them, which state less than a logger does.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "ballbar/error.hpp"
#include "ballbar/formats/logs/log.hpp"

namespace ballbar {
namespace {

std::string rows(std::string_view names, int count, const std::function<std::string(int)>& cells) {
  std::string text = fmt::format("{}\n", names);
  for (int row = 0; row < count; ++row) text += cells(row) + "\n";
  return text;
}

// Names and first values.
std::string read(std::string_view text) {
  const Log log = read_log(text, "log.csv");
  std::string columns;
  for (const Column& column : log.series.columns) columns += fmt::format("{} {:.6g}; ", column.name, column.values[0]);
  return columns;
}

std::string error_of(std::string_view text) {
  try {
    read_log(text, "log.csv");
  } catch (const Error& error) {
    return error.what();
  }
  return "read";
}

std::string remark_of(std::string_view text) {
  const Log log = read_log(text, "log.csv");
  return log.remarks.empty() ? "" : log.remarks.front();
}

std::vector<double> times(std::string_view text) { return read_log(text, "log.csv").series.time_s; }

TEST(conventions, times_since_a_start_with_days) {
  // 1 d 5 h 30 min = 106 200 s.
  for (const std::string_view start :
       {"1-05:30:00", "1.05:30:00", "1:05:30:00", "001:05:30:00", "1 05:30:00", "001 05:30:00", "1d 05:30:00",
        "1 days 05:30:00", "1 Tag 05:30:00", "1T05:30:00", "+1d 05:30:00", "1d 5h 30m 0s", "29h 30min", "29h30m00s",
        "P1DT5H30M", "PT29H30M0S", "29小时30分0秒", "1天 05:30:00", "1-05:30"}) {
    const std::string text = fmt::format("Elapsed,a\n{0},1\n{0},2\n1-05:31:00,3\n", start);
    EXPECT_EQ(times(text).front(), 106200.0) << start;
  }
  // The fourth of four fields of two digits is a fraction; a length and a program are no times.
  EXPECT_EQ(times("Time,a\n01:05:30:00,1\n01:05:30:50,2\n"), (std::vector<double>{0.0, 0.5}));
  EXPECT_FALSE(read_log("Time,a\n5 m,1\n6 m,2\n", "log.csv").series.has_clock);
}

TEST(conventions, numbers_of_time_count_from_the_zero_of_their_system) {
  // 2026-11-22 13:05:10 and 10 s later. As ns since 1970 ticks of 100 ns would be of 1990, and 0.1 s apart.
  for (const std::string_view form :
       {"1795352710|1795352720", "639309495100000000|639309495200000000", "134398263100000000|134398263200000000",
        "3878197510|3878197520", "2461367.045254630|2461367.045370370", "46348.545254630|46348.545370370"}) {
    const std::size_t middle = form.find('|');
    const Log log =
        read_log(fmt::format("Time,z_um\n{},1\n{},2\n", form.substr(0, middle), form.substr(middle + 1)), "log.csv");
    EXPECT_NEAR(log.series.time_s[1], 10.0, 2e-3) << form;
    EXPECT_EQ(log.series.started->substr(0, 18), "2026-11-22T13:05:1") << form;
  }
}

TEST(conventions, a_time_may_have_its_unit_as_a_word_of_its_name) {
  for (const std::string_view name :
       {"timeSec", "seconds_elapsed", "uptime_s", "Sekunden seit Start", "time s", "Time elapsed, sec", "Время (с)"}) {
    EXPECT_EQ(times(fmt::format("{};a\n0;1\n5;2\n", name)), (std::vector<double>{0, 5})) << name;
  }
}

TEST(conventions, a_zone_may_have_the_name_of_a_region) {
  for (const std::string_view zone : {" Europe/Berlin", "+01:00[Europe/Berlin]", " +0100 CET"}) {
    const std::string text = fmt::format("t,a,b\n2026-11-22 13:05:10{0},1,2\n2026-11-22 13:05:20{0},2,2\n", zone);
    EXPECT_EQ(times(text), (std::vector<double>{0, 10})) << zone;
  }
}

TEST(conventions, units_as_people_spell_them) {
  EXPECT_EQ(read("t_s;A [µ];B (?m);C [мкм];D [micron(s)];E (°С)\n0;1;1;1;1;1\n1;2;2;2;2;2\n"),
            "A_um 1; B_um 1; C_um 1; D_um 1; E_degC 1; ");
  EXPECT_EQ(read("Time [s] Bearing temp [C] Probe Z [um]\n0 20 1\n1 21 2\n2 21 3\n"),
            "Bearing_temp_degC 20; Probe_Z_um 1; ");
  EXPECT_EQ(read("t_s,\"Displ, mm (S/N: 20, LBL: Z)\"\n0,1\n1,2\n"), "Displ_S_N_20_LBL_Z_um 1000; ");
}

TEST(conventions, dates_without_a_year_pass_new_year) {
  for (const std::string_view form :
       {"31.12. 23:59|01.01. 00:01", "12-31 23:59|01-01 00:01", "Dec 31 23:59|Jan 1 00:01"}) {
    const std::size_t middle = form.find('|');
    const std::string text = fmt::format("Time,a\n{},1\n{},2\n", form.substr(0, middle), form.substr(middle + 1));
    EXPECT_EQ(times(text), (std::vector<double>{0.0, 120.0})) << form;
    EXPECT_EQ(remark_of(text), "Past New Year once: the time continues.");
  }
}

TEST(conventions, a_date_may_stand_in_the_first_row_of_a_day_alone) {
  EXPECT_EQ(times("Date;Time;a\n22.11.2026;23:58;1\n;23:59;2\n;00:01;3\n23.11.2026;00:02;4\n;00:03;5\n"),
            (std::vector<double>{0, 60, 180, 240, 300}));
}

// Minutes from 10:00 on, in the order of `minutes`.
std::string dated(const std::vector<int>& minutes) {
  std::string text = "Time,z_um\n";
  for (const int minute : minutes) text += fmt::format("2026-03-20 10:{:02},{}\n", minute, minute);
  return text;
}

TEST(conventions, blocks_and_single_rows_in_another_order_are_put_in_order) {
  for (const auto& minutes : {std::vector{0, 1, 2, 6, 7, 8, 3, 4, 5}, {0, 2, 1, 3, 4, 5, 7, 6, 8}}) {
    const Log log = read_log(dated(minutes), "log.csv");
    EXPECT_EQ(log.series.columns[0].values, (std::vector<double>{0, 1, 2, 3, 4, 5, 6, 7, 8}));
    EXPECT_EQ(log.series.time_s.back(), 480.0);
    EXPECT_NE(
        log.remarks.front().find("is earlier than the line above: the rows are read in the order of their times."),
        std::string::npos);
  }
  EXPECT_NE(error_of("Time,z_um\n2026-12-31 23:59,1\n2026-01-01 00:00,2\n2026-01-01 00:01,2\n"), "read");
  // A clock that was set back: rows of two blocks in turns, or of the same time.
  EXPECT_NE(error_of(dated({0, 2, 4, 6, 8, 10, 12, 1, 3, 5, 7, 9, 11, 13})), "read");
  EXPECT_NE(error_of(dated({0, 1, 2, 3}) + "2026-03-20 10:02,8\n2026-03-20 10:03,9\n"), "read");
}

TEST(conventions, one_scale_for_all_temperatures_without_a_unit) {
  const auto cells = [](double scale, double zero) {
    return [=](int row) {
      const double warm = 0.5 * scale * row;
      return fmt::format("{},{:.2f},{:.2f},{:.2f}", row, 21.0 * scale + zero + warm, 21.0 * scale + zero, 0.1 * row);
    };
  };
  const std::string kelvin = rows("t_s,T1,T2,z_um", 60, cells(1.0, 273.15));
  EXPECT_EQ(read(kelvin), "T1_degC 21; T2_degC 21; z_um 0; ");
  EXPECT_EQ(remark_of(kelvin),
            "T1, T2 state no unit and begin at 294.15 to 294.15: read as K. State --unit 'T1=degC' if they are not.");
  // T1 goes to 122.9 degF, beyond what a machine has in degC, T2 stays at 69.8.
  EXPECT_EQ(read(rows("t_s,T1,T2,z_um", 60, cells(1.8, 32.0))), "T1_degC 21; T2_degC 21; z_um 0; ");
  // Of two alike at 21 no one doubts, and 62 beside 66 may be a machine that is warm.
  EXPECT_EQ(read(rows("t_s,T1,T2,z_um", 60, cells(1.0, 0.0))), "T1_degC 21; T2_degC 21; z_um 0; ");
  EXPECT_EQ(read(rows("t_s,T1,T2,z_um", 60,
                      [](int row) { return fmt::format("{},{},{:.1f},0", row, 62 + 0.1 * row, 66 + 0.1 * row); })),
            "T1_degC 62; T2_degC 66; z_um 0; ");
}

TEST(conventions, lengths_without_a_unit_are_mm_where_they_can_be_nothing_else) {
  const auto drift = [](double zero, double scale, int decimals) {
    return rows("t_s,Displacement", 60, [=](int row) {
      return fmt::format("{},{:.{}f}", row, zero + scale * (1.0 - std::exp(-row / 20.0)), decimals);
    });
  };
  EXPECT_EQ(read(drift(0.5, 0.03, 4)), "Displacement_um 500; ");
  EXPECT_EQ(read(drift(299.998, 0.03, 3)), "Displacement_um 299998; ");
  EXPECT_EQ(
      remark_of(drift(0.5, 0.03, 4)),
      "Displacement: no unit, and values from 0.5 to 0.5284: read as mm. State --unit 'Displacement=um' if they are "
      "in um.");
  EXPECT_EQ(read_log(drift(0.5, 0.03, 4), "log.csv").recipe.columns.back().unit, "mm");
  // One of two decides for the other, which alone may be in inches.
  EXPECT_EQ(read(rows("t_s,dz,dx", 60,
                      [](int row) { return fmt::format("{},{:.4f},{:.4f}", row, 0.0005 * row, 1e-4 * row); })),
            "dz_um 0; dx_um 0; ");
  EXPECT_EQ(read(drift(0.5, 30.0, 4)), "Displacement 0.5; ");   // um
  EXPECT_EQ(read(drift(0.5, 0.5, 3)), "Displacement 0.5; ");    // um to 0.001, or mm
  EXPECT_EQ(read(drift(0.5, 0.5, 9)), "Displacement 0.5; ");    // computed
  EXPECT_EQ(read(drift(0.5, 0.001, 5)), "Displacement 0.5; ");  // inches, perhaps
}

TEST(conventions, a_displacement_is_no_bearing) {
  EXPECT_EQ(read(rows("t_s,Verlagerung Z,Lager vorne", 30,
                      [](int row) { return fmt::format("{},{:.1f},{:.1f}", row, 6 + 0.5 * row, 20 + 0.1 * row); })),
            "Verlagerung_Z 6; Lager_vorne_degC 20; ");
}

TEST(conventions, a_word_that_comes_back_is_a_gap) {
  const auto text = [](std::string_view word) {
    return rows("t_s,T_degC,z_um", 60, [=](int row) {
      return fmt::format("{},{},{}", row, row % 6 == 2 ? std::string(word) : fmt::format("{}", 20 + 0.1 * row), row);
    });
  };
  const Log log = read_log(text("Break"), "log.csv");
  EXPECT_TRUE(std::isnan(log.series.columns[0].values[2]));
  EXPECT_EQ(log.series.time_s.size(), 60U);
  EXPECT_EQ(log.remarks.front(), "\"Break\": read as a missing value wherever it stands for a number.");
  EXPECT_NE(error_of(text("0x80")), "read");
}

TEST(conventions, a_spindle_that_stands_is_at_0_rpm) {
  const auto cells = [](int row) {
    return fmt::format("{},{},{},{}", row, row < 8 ? "stop" : "S8000", row < 8 ? "halt" : "8000", row);
  };
  EXPECT_EQ(read(rows("t_s,S,speed,z_um", 30, cells)), "S_rpm 0; speed_rpm 0; z_um 0; ");
}

TEST(conventions, names_may_stand_with_their_values) {
  EXPECT_EQ(
      read(rows("", 30, [](int row) { return fmt::format("10:00:{:02} bearing=20.{} z_um={}", row, row % 10, row); })),
      "bearing_degC 20; z_um 0; ");
  EXPECT_EQ(read(rows("", 30, [](int row) { return fmt::format("{{\"t_s\": {0}, \"z_um\": {0}.5}}\r", row); })),
            "z_um 0.5; ");
}

TEST(conventions, the_row_of_units_may_hold_names_too) {
  EXPECT_EQ(
      read("Time;Spindle;Temp;Temp\nhh:mm:ss;1/min;Bearing [°C];Room [°C]\n10:00:00;0;21,5;20\n10:00:10;0;22;20\n"),
      "Spindle_rpm 0; Temp_Bearing_degC 21.5; Temp_Room_degC 20; ");
  // What stands above a row of names is no row of names.
  EXPECT_EQ(read("Date;22.11.2026;\nmin;Bearing [°C];Z [mm]\n0;21,5;20\n1;22;20,1\n"),
            "Bearing_degC 21.5; Z_um 20000; ");
}

TEST(conventions, two_logs_side_by_side_are_no_table) {
  const auto text = [](int other_s) {
    return rows("t1 (s),T1_degC,t2 (s),z_um", 30,
                [=](int row) { return fmt::format("{},{},{},{}", row * 60, 20 + 0.1 * row, row * other_s, row); });
  };
  EXPECT_EQ(
      error_of(text(30)),
      "log.csv:2: expected one time for all columns, found another, \"t2 (s)\", which goes on by 30 s a row where "
      "\"t1 (s)\" goes on by 60 s. Write the columns from there on into a file of their own, or use --leave-out "
      "\"t2 (s)\".");
  EXPECT_EQ(error_of(text(60)), "read");
}

TEST(conventions, a_table_that_lies_on_its_side_or_has_no_names) {
  std::string line;
  for (int k = 0; k < 50; ++k) line += fmt::format(",{}.5", k);
  EXPECT_EQ(
      error_of(fmt::format("Time (s){0}\nT (C){0}\nZ (um){0}\n", line)),
      "log.csv:1: expected a row for each time, found 3 rows of 51 values without names. If each row is a channel, "
      "export one column a channel.");
  EXPECT_EQ(remark_of("0,21.5,0.1\n60,21.6,0.2\n120,21.6,0.3\n"),
            "c1 rises like a time. State --time c1 --time-unit s if it is one in s.");
}

}  // namespace
}  // namespace ballbar
