#include "ballbar/formats/logs/log.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <optional>
#include <vector>

#include "ballbar/error.hpp"
#include "ballbar/formats/logs/column_named.hpp"
#include "ballbar/formats/logs/recipe_toml.hpp"
#include "ballbar/formats/series/series_csv.hpp"
#include "logs/log_cells.hpp"
#include "logs/log_units.hpp"
#include "logs/number_format.hpp"
#include "logs/time_stamp.hpp"
#include "scratch_folder.hpp"

namespace ballbar {
namespace {

std::string said(std::string_view text, const LogRecipe& recipe = {}) {
  try {
    read_log(text, "log.csv", recipe);
  } catch (const Error& error) {
    return error.what();
  }
  return "read";
}

// Names, units, roles and values of the columns as one text.
std::string text_of(const Log& log) {
  std::string text;
  for (const Column& column : log.series.columns) {
    text += fmt::format("{} {}:", column.name, name_of(column.role));
    for (const double value : column.values) text += fmt::format(" {:.10g}", value);
    text += "; ";
  }
  return text;
}

std::string times(std::string_view text) {
  std::string out;
  for (const double time : read_log(text, "log.csv").series.time_s) out += fmt::format("{} ", time);
  return out;
}

TEST(log, of_a_german_logger) {
  const Log log = read_log(
      "Messprotokoll\r\nPr\xFC"
      "fer;M\xFC"
      "ller\r\n\r\n"
      "Zeit;Drehzahl [1/min];Spindellast [%];K\xFC"
      "hlmittel [\xB0"
      "C];Taster X [\xB5m]\r\n"
      "22.11.2026 13:05:10;1.200;12,5;21,25;0,5\r\n"
      "22.11.2026 13:05:20;12.000;14,0;#NV;1,25\r\n"
      "22.11.2026 13:05:30;12.000;14,5;21,50;-999\r\n",
      "log.csv");
  EXPECT_EQ(
      text_of(log),
      "Drehzahl_rpm speed: 1200 12000 12000; Spindellast_percent load: 12.5 14 14.5; K\xC3\xBChlmittel_degC coolant: "
      "21.25 nan 21.5; Taster_X_um measured: 0.5 1.25 nan; ");
  EXPECT_EQ(log.series.time_s, (std::vector<double>{0, 10, 20}));
  EXPECT_EQ(log.series.started, "2026-11-22T13:05:10");
  EXPECT_EQ(log.shape, "semicolons, decimal comma, WINDOWS-1252");
  EXPECT_EQ(log.first_row_line, 5u);
  EXPECT_EQ(sentence_of(log),
            "read as semicolons, decimal comma, WINDOWS-1252; 3 rows from line 5, time \"Zeit\"; 1 measured column, 1 "
            "speed, 1 load, 1 coolant temperature.");
}

// The bytes of the code pages: "Время;Температура подшипника;Z (мкм)", "시간;베어링온도;Z변위(um)", "Saat;Yığın ısısı".
TEST(log, words_tell_the_code_page) {
  const Log russian = read_log(
      "\xC2\xF0\xE5\xEC\xFF;\xD2\xE5\xEC\xEF\xE5\xF0\xE0\xF2\xF3\xF0\xE0 "
      "\xEF\xEE\xE4\xF8\xE8\xEF\xED\xE8\xEA\xE0 (C);Z (\xEC\xEA\xEC)\n"
      "08:00;21,2;0,5\n08:01;21,3;1,5\n08:02;21,4;1,7\n",
      "log.csv");
  EXPECT_EQ(russian.shape, "semicolons, decimal comma, WINDOWS-1251");
  EXPECT_EQ(text_of(russian), "Температура_подшипника_degC bearing: 21.2 21.3 21.4; Z_um measured: 0.5 1.5 1.7; ");
  const Log korean = read_log(
      "\xBD\xC3\xB0\xA3;\xBA\xA3\xBE\xEE\xB8\xB5\xBF\xC2\xB5\xB5(C);Z\xBA\xAF\xC0\xA7(um)\n"
      "08:00;21,2;0,5\n08:01;21,3;1,5\n08:02;21,4;1,7\n",
      "log.csv");
  EXPECT_EQ(korean.shape, "semicolons, decimal comma, CP949");
  EXPECT_EQ(text_of(korean), "베어링온도_degC structure: 21.2 21.3 21.4; Z변위_um measured: 0.5 1.5 1.7; ");
  const Log turkish = read_log(
      "Saat;Y\xFD\xF0\xFDn \xFDs\xFDs\xFD (C);Z (um)\n08:00;21,2;0,5\n08:01;21,3;1,5\n08:02;21,4;1,7\n", "log.csv");
  EXPECT_EQ(turkish.shape, "semicolons, decimal comma, WINDOWS-1252");
}

TEST(log, reads_a_line_in_another_encoding_than_the_file) {
  const Log log = read_log(
      "\xEF\xBB\xBFZeit;Lager\xC3\xB6l;Taster Z\ns;\xB0"
      "C;\xB5m\n0;21,2;0,5\n1;21,3;1,5\n2;21,3;1,5\n",
      "log.csv");
  EXPECT_EQ(text_of(log), "Lager\xC3\xB6l_degC bearing: 21.2 21.3 21.3; Taster_Z_um measured: 0.5 1.5 1.5; ");
  EXPECT_EQ(read_recipe(write_recipe(log.recipe), "recipe").columns.back().unit, "\xC2\xB5m");
}

TEST(log, units_become_those_of_a_series) {
  // 1 in = 25 400 um; 212 degF = 100 degC; 293.15 K = 20 degC; 2 kW = 2000 W; 10 Hz of a speed is no unit of ours.
  const Log log = read_log(
      "t [min],a [in],b (°F),c/K,d in kW,e [nm],f [l/min],g [Nm],humidity [%]\n"
      "0,1,212,293.15,2,1000,3,4,40\n0.5,1.1,32,294.15,2.5,2000,3,5,41\n",
      "log.csv");
  EXPECT_EQ(
      text_of(log),
      "a_um event: 25400 27940; b_degC structure: 100 0; c_degC structure: 20 21; d_W load: 2000 2500; e_um measured: "
      "1 2; f_l_per_min event: 3 3; g_Nm load: 4 5; humidity_percent event: 40 41; ");
  EXPECT_EQ(log.series.time_s, (std::vector<double>{0, 30}));
}

TEST(log, times_of_all_kinds) {
  EXPECT_EQ(times("t_ms,a\n0,1\n250,2\n"), "0 0.25 ");
  EXPECT_EQ(times("time,a\n23:59:58,1\n23:59:59,2\n00:00:01,3\n"), "0 1 3 ");
  EXPECT_EQ(times("time,a\n1795352710,1\n1795352720,2\n"), "0 10 ");
  EXPECT_EQ(times("time,a\n1795352710000,1\n1795352710500,2\n"), "0 0.5 ");
  EXPECT_EQ(times("Datum,a\n46348.5,1\n46348.500011574,2\n"), "0 1 ");  // 1 s is 1.1574e-5 d
  EXPECT_EQ(times("Date,Time,a\n2026-11-22,13:05:10,1\n2026-11-22,13:05:11.5,2\n"), "0 1.5 ");
  EXPECT_EQ(times("Time,a\n11/22/2026 11:59:59 AM,1\n11/22/2026 12:00:01 PM,2\n"), "0 2 ");
  EXPECT_EQ(times("Elapsed,a\n26:15:00,1\n26:15:10,2\n"), "94500 94510 ");
  EXPECT_EQ(times("Time,a\n2026-11-22T13:00:00+01:00,1\n2026-11-22T13:00:00Z,2\n"), "0 3600 ");
  EXPECT_EQ(times("Time,a\n10:00:00,1\n10:00:00,2\n10:00:01,3\n10:00:01,4\n"), "0 0.5 1 1.5 ");
  EXPECT_EQ(times("Sampling interval: 20 ms\nNo.,a,b\n1,5,6\n2,6,7\n3,8,8\n"), "0 0.02 0.04 ");
}

TEST(log, clocks_with_dots_are_no_dates) {
  EXPECT_EQ(times("Data;Ora;a\n22/11/2026;07.45.58;1\n22/11/2026;07.46.01;2\n"), "0 3 ");
  EXPECT_EQ(times("Data;Ora;a\n22/11/2026;07.05.00;1\n22/11/2026;07.06.00;2\n"), "0 60 ");
  EXPECT_EQ(times("Ora;Data;a\n07.05.00;22/11/2026;1\n07.06.00;22/11/2026;2\n"), "0 60 ");
  EXPECT_EQ(times("Datum;Uhrzeit;a\n22.11.26;23.59.58;1\n23.11.26;00.00.00,5;2\n"), "0 2.5 ");
  EXPECT_EQ(times("Uhrzeit;a\n07.05.00;1\n07.05.01;2\n07.05.02;3\n"), "0 1 2 ");
  EXPECT_EQ(times("Uhrzeit;a\n07.45.58;1\n7:46:01;2\n"), "0 3 ");
  EXPECT_EQ(times("Laufzeit;a\n30.45.00;1\n30.45.10;2\n"), "110700 110710 ");
  EXPECT_EQ(times("Datum;a\n07.05.24;1\n08.05.24;2\n"), "0 86400 ");
  EXPECT_EQ(times("Zeit;a\n07.05.24;1\n08.05.24;2\n"), "0 86400 ");
  EXPECT_EQ(times("Zeit_s;Firmware;a\n0;1.20.33;1\n5;1.20.34;2\n10;1.20.34;2\n"), "0 5 10 ");
  EXPECT_EQ(times("Date,Time,Z\n11.22.26,08:00:00,1\n11.23.26,08:00:00,2\n").find("114"), std::string::npos);
}

TEST(log, a_time_may_be_named_by_its_unit) {
  EXPECT_EQ(times("Minutes,a\n0,1\n5,2\n"), "0 300 ");
  EXPECT_EQ(times("h,a\n0,1\n0.5,2\n"), "0 1800 ");
  EXPECT_EQ(times("Tage;a\n0;1\n2;2\n"), "0 172800 ");
  EXPECT_EQ(times("t (min:s),a\n0:00,1\n0:30,2\n1:00,3\n"), "0 30 60 ");
  EXPECT_EQ(times("Uhrzeit;a\n07:05 Uhr;1\n07:10 Uhr;2\n"), "0 300 ");
  EXPECT_EQ(times("Interval;00:05:00\n\na;b\n1;5\n2;6\n4;8\n3;8\n"), "0 300 600 900 ");
  EXPECT_EQ(times("Dato;Klokken;a\n10.03.2025;07.05;1,5\n10.03.2025;07.10;1,6\n"), "0 300 ");
}

TEST(log, a_time_may_be_in_parts) {
  EXPECT_EQ(times("Datum;Stunde;Minute;a\n22.11.2026;7;55;1\n22.11.2026;8;5;2\n23.11.2026;8;5;3\n"), "0 600 87000 ");
  EXPECT_EQ(times("Date,Hour,a\n2026-11-22,23,1\n2026-11-23,0,2\n"), "0 3600 ");
  EXPECT_EQ(times("hh;mm;ss;a\n23;59;58.5;1\n23;59;59;2\n0;0;1;3\n"), "0 0.5 2.5 ");
  EXPECT_EQ(times("year,month,day,hour,minute,second,a\n2026,2,28,23,59,30,1\n2026,3,1,0,0,15,2\n"), "0 45 ");
  EXPECT_EQ(times("Time,ms,a\n10:00:00,0,1\n10:00:00,250,2\n"), "0 0.25 ");
  // As the recipe names its first column.
  LogRecipe recipe;
  recipe.time = "Stunde";
  EXPECT_EQ(read_log("Stunde;Minute;a\n7;55;1\n8;5;2\n", "log.csv", recipe).series.time_s,
            (std::vector<double>{0, 600}));
  // Minutes that run on are no part of a clock.
  EXPECT_EQ(times("Minute,a\n0,1\n70,2\n"), "0 4200 ");
}

TEST(log, the_half_of_the_day_may_be_in_a_column) {
  EXPECT_EQ(times("Time,AM/PM,a\n11:59:00,AM,1\n12:00:00,PM,2\n1:00:00,PM,3\n"), "0 60 3660 ");
  EXPECT_EQ(times("Date,Time,,a\n2026-11-22,11:59,p.m.,1\n2026-11-23,12:01,a.m.,2\n"), "0 120 ");
  EXPECT_EQ(times("Time,Half,a\n2026-11-22 11:59,am,1\n2026-11-22 12:00,pm,2\n"), "0 60 ");
  // Nor AM nor PM anywhere: a clock of 12 hours.
  const Log log = read_log("Time,a\n12:58,1\n12:59,2\n1:00,3\n1:01,4\n", "log.csv");
  EXPECT_EQ(log.series.time_s, (std::vector<double>{0, 60, 120, 180}));
  ASSERT_FALSE(log.remarks.empty());
  EXPECT_EQ(log.remarks.front(), "The clock falls by 12 h at line 4, read as one of 12 hours: the time continues.");
}

TEST(log, two_fields_are_minutes_where_the_unit_or_the_rows_say_so) {
  EXPECT_EQ(times("Elapsed (min),a\n0:00,1\n5:30,2\n"), "0 330 ");
  EXPECT_EQ(times("Laufzeit [min];a\n478:00;1\n479:30;2\n"), "28680 28770 ");
  EXPECT_EQ(times("Elapsed,a\n59:00,1\n1:00:00,2\n1:01:30,3\n"), "3540 3600 3690 ");
  LogRecipe recipe;
  recipe.time_unit = "min";
  EXPECT_EQ(read_log("Elapsed,a\n5:00,1\n6:00,2\n", "log.csv", recipe).series.time_s, (std::vector<double>{0, 60}));
  // Hours that run on: how they are read is said.
  const Log log = read_log("Elapsed,a\n25:00,1\n26:00,2\n", "log.csv");
  EXPECT_EQ(log.series.time_s, (std::vector<double>{90000, 93600}));
  ASSERT_FALSE(log.remarks.empty());
  EXPECT_EQ(log.remarks.front(),
            "\"Elapsed\" is read as hours and minutes. State --time-unit min where 5:10 is five minutes.");
}

// What looks like these, and is not.
TEST(log, clocks_that_lack_seconds_or_hours_by_chance) {
  EXPECT_EQ(times("Time,a\n8:00,1\n8:00:30,2\n8:01,3\n"), "0 30 60 ");         // hours and minutes
  EXPECT_EQ(times("Time,Half,a\n11:59,AM,1\n13:05,PM,2\n"), "0 3960 ");        // of 24 hours
  EXPECT_THROW(times("Time,a\n19:59,1\n20:00,2\n08:01,3\n08:02,4\n"), Error);  // a night, its date unknown
  EXPECT_EQ(times("Päivämäärä;Klo;a\n2026-11-22;23:59;1\n2026-11-25;08:00;2\n"), "0 201660 ");
  EXPECT_EQ(times("Time,a\n2021-11-22 13:05,1\n2026-11-22 13:05,2\n").substr(0, 2), "0 ");  // years apart, both set
}

TEST(log, dates_may_lack_the_year) {
  EXPECT_EQ(times("Time,a\n28.02. 23:59,1\n01.03. 00:01,2\n"), "0 120 ");
  EXPECT_EQ(times("Time,Elapsed_s,a\n03-04 08:15,0,1\n03-04 08:15,10,2\n"), "0 10 ");
  EXPECT_EQ(times("Time,a\n22.11. 23:59,1\n23.11. 00:01,2\n"), "0 120 ");
  EXPECT_EQ(times("Time,a\n11-22 23:59,1\n11-23 00:01,2\n"), "0 120 ");
  EXPECT_EQ(times("Time,a\nNov 22 23:59:58,1\nNov 23 00:00:01,2\n"), "0 3 ");
  EXPECT_FALSE(read_log("Time,a\n22.11. 23:59,1\n23.11. 00:01,2\n", "log.csv").series.started);
}

TEST(log, packed_times_without_a_date_or_with_a_short_one) {
  EXPECT_EQ(times("Time,a\n261122-235959,1\n261123-000001,2\n"), "0 2 ");
  EXPECT_EQ(times("Time,a\n211122-235959,1\n211123-000001,2\n"), "0 2 ");
  EXPECT_EQ(times("Time,a\n075959,1\n080001,2\n"), "0 2 ");
}

// The number of a part may look like a date.
TEST(log, a_column_that_is_not_named_as_a_date_is_none_beside_a_clock) {
  EXPECT_EQ(times("Part,Time,a\n13-4-26,23:59,1\n14-4-26,00:01,2\n"), "0 120 ");
  EXPECT_EQ(times("Time,Batch,a\n07:58,26-03-04,1\n07:59,26-03-07,2\n"), "0 60 ");
  EXPECT_EQ(times("Datum;Zeit;a\n13.4.26;23:59;1\n14.4.26;00:01;2\n"), "0 120 ");
}

TEST(log, rows_that_repeat_rows_above_are_left_out) {
  const std::string rows = "10:00:00,1\n10:01:00,2\n10:02:00,3\n";
  const Log log = read_log("Time,a\n" + rows + rows + "10:03:00,4\n", "log.csv");
  EXPECT_EQ(log.series.time_s, (std::vector<double>{0, 60, 120, 180}));
  EXPECT_EQ(log.series.columns.front().values, (std::vector<double>{1, 2, 3, 4}));
  ASSERT_FALSE(log.remarks.empty());
  EXPECT_EQ(log.remarks.front(), "The 3 rows from line 5 on repeat rows above: left out.");
  EXPECT_EQ(times("Time,a\n" + rows + rows + rows), "0 60 120 ");
  // Other values at the same times are another recording.
  EXPECT_THROW(read_log("Time,a\n" + rows + "10:00:00,5\n10:01:00,6\n", "log.csv"), Error);
}

TEST(log, cells_with_units) {
  const Log comma = read_log("Zeit_s;a;b;T\n0;1;2;21,72 °C\n1;1;2;21,80 °C\n2;1;3;21,90 °C\n", "log.csv");
  ASSERT_EQ(comma.series.columns.size(), 3U);
  EXPECT_EQ(comma.series.columns.back().values, (std::vector<double>{21.72, 21.8, 21.9}));
  const Log speed = read_log("Time_s;a;b;Speed\n0;1;2;9000 1/min\n1;1;2;9500 1/min\n2;1;3;9500 1/min\n", "log.csv");
  ASSERT_EQ(speed.series.columns.size(), 3U);
  EXPECT_EQ(speed.series.columns.back().values, (std::vector<double>{9000, 9500, 9500}));
  EXPECT_EQ(speed.series.columns.back().role, Role::speed);
  // A quote behind a number is no beginning of a cell in quotes.
  const Log inches = read_log(
      "Time_s,T1_degC,T2_degC,T3_degC,Z\n0,20,20,20,0.000100\"\n1,21,20,20,0.000200\"\n2,22,20,20,0.000300\"\n",
      "log.csv");
  ASSERT_EQ(inches.series.columns.size(), 4U);
  EXPECT_NEAR(inches.series.columns.back().values.back(), 7.62, 1e-9);
}

TEST(log, rows_before_the_clock_is_set_are_left_out) {
  const Log log = read_log(
      "Time,a\n1970-01-01 00:00:12,1\n1970-01-01 00:01:12,2\n2026-11-22 13:05:00,3\n2026-11-22 13:06:00,4\n"
      "2026-11-22 13:07:00,5\n",
      "log.csv");
  EXPECT_EQ(log.series.time_s, (std::vector<double>{0, 60, 120}));
  EXPECT_EQ(log.series.columns.front().values, (std::vector<double>{3, 4, 5}));
  EXPECT_EQ(log.series.started, "2026-11-22T13:05:00");
  ASSERT_FALSE(log.remarks.empty());
  EXPECT_EQ(log.remarks.front(), "The first 2 rows were written before the clock was set: left out.");
  // Whatever day it started at, no log pauses for years.
  EXPECT_EQ(times("Time,a\n2015-01-01 00:00,1\n2015-01-01 00:01,2\n2026-11-22 13:05,3\n2026-11-22 13:06,4\n"), "0 60 ");
  // A clock that is never set counts on.
  EXPECT_EQ(times("Time,a\n1970-01-01 23:59:00,1\n1970-01-02 00:01:00,2\n"), "0 120 ");
}

TEST(log, names_that_change_are_another_layout) {
  const std::string rows = "Time,A [degC],B [degC]\n10:00:00,20,30\n10:01:00,21,31\n10:02:00,22,32\n";
  const std::string more = "10:03:00,20,30\n10:04:00,21,31\n";
  EXPECT_EQ(read_log(rows + "Time,A [degC],B [degC]\n" + more, "log.csv").series.time_s.size(), 5U);
  try {
    read_log(rows + "Time,B [degC],A [degC]\n" + more, "log.csv");
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(
        error.what(),
        "log.csv:5: expected the names of line 1 again, found \"B [degC]\" in place of \"A [degC]\". Split the "
        "file here.");
  }
}

TEST(log, a_date_between_clocks_is_not_lost) {
  std::string day;
  for (int minute = 10; minute < 50; ++minute) day += fmt::format("07:{}:00;{}\n", minute, minute);
  EXPECT_EQ(read_log("Datum: 14.03.2025\nZeit;a\n" + day + "Seite 2, 14.03.2025\n07:53:00;1\n", "log.csv")
                .series.time_s.back(),
            43.0 * 60.0);
  EXPECT_THROW(times("Datum: 14.03.2025\nZeit;a\n" + day + "Datum: 17.03.2025\n07:53:00;1\n"), Error);
}

TEST(log, scales_of_units) {
  EXPECT_EQ(text_of(read_log("t [s],T1 (x0.1 \xC2\xB0"
                             "C),n [1000/min]\n0,253,7.2\n1,254,7.2\n2,255,9\n",
                             "log.csv")),
            "T1_degC structure: 25.3 25.4 25.5; n_rpm speed: 7200 7200 9000; ");
}

TEST(log, summer_time_neither_repeats_nor_skips_an_hour) {
  // 2026-10-25 03:00 became 02:00; 2026-03-29 02:00 became 03:00. Both Sundays.
  EXPECT_EQ(
      times("Zeit;a\n25.10.2026 02:58:00;1\n25.10.2026 02:59:00;2\n25.10.2026 02:00:00;3\n25.10.2026 02:01:00;4\n"),
      "0 60 120 180 ");
  EXPECT_EQ(
      times("Zeit;a\n29.03.2026 01:58:00;1\n29.03.2026 01:59:00;2\n29.03.2026 03:00:00;3\n29.03.2026 03:01:00;4\n"),
      "0 60 120 180 ");
}

TEST(log, days_and_months_are_told_apart_only_where_they_can_be) {
  const std::string open = "Time,a\n03/04/2026 10:00,1\n03/04/2026 10:01,2\n";
  EXPECT_EQ(said(open),
            "log.csv:2: expected an unambiguous date, found \"03/04/2026 10:00\". The third number is the year; state "
            "--dates day-first or --dates month-first.");
  LogRecipe recipe;
  recipe.month_first = true;
  EXPECT_EQ(read_log(open, "log.csv", recipe).series.started, "2026-03-04T10:00:00");
  // The days after each other in one reading are a month apart in the other.
  EXPECT_EQ(read_log("Time,a\n03/04/2026 23:59,1\n04/04/2026 00:01,2\n", "log.csv").series.started,
            "2026-04-03T23:59:00");
  EXPECT_EQ(read_log("Time,a\n03/04/2026 23:59,1\n03/05/2026 00:01,2\n", "log.csv").series.started,
            "2026-03-04T23:59:00");
  // A later row tells.
  EXPECT_EQ(read_log("Time,a\n12/11/2026 23:59,1\n13/11/2026 00:01,2\n", "log.csv").series.started,
            "2026-11-12T23:59:00");
}

// Rows of numbers, a line each.
std::string table(std::string_view head, std::size_t rows, const std::function<std::string(std::size_t)>& row) {
  std::string text = fmt::format("{}\n", head);
  for (std::size_t i = 0; i < rows; ++i) text += row(i) + "\n";
  return text;
}

TEST(log, what_is_not_clear_is_refused_with_its_line_and_the_way_out) {
  EXPECT_EQ(said(""), "log.csv:1: expected a table of numbers over time, found an empty file.");
  EXPECT_EQ(
      said("only words\nand more\n"),
      "log.csv:1: expected rows of at least two values separated by commas, semicolons, tabs or blanks, found none in "
      "the first 2 lines.");
  EXPECT_EQ(said("time,b\n1,2\n3,5\n4,4\n"),
            "log.csv:1: expected the unit of the time \"time\", found none; state --time-unit s, ms, min, h or d.");
  EXPECT_EQ(said("time_s,b\n1,2\n3,5\n2,4\n"),
            "log.csv:4: expected a time above 3 s of the row before, found 2 s. If another recording starts here, "
            "split the file.");
  EXPECT_EQ(said("t [s];b\n1;2\n2;5\n3;x\n4;4\n"),
            "log.csv:4: expected a number for \"b\", found \"x\". Use --missing to read such a text as a gap. Use "
            "--skip-bad-rows to omit the row.");
  EXPECT_EQ(said(table("t [s];b", 50, [](std::size_t i) { return fmt::format("{};2{}", i, i % 10 == 9 ? ";7" : ""); })),
            "log.csv:11: expected 2 values, one for each column, found more: \"7\". This affects 5 of 50 rows. Use "
            "--skip-bad-rows to omit them.");
  EXPECT_EQ(said("t [s]\ta\n0\t1,234\n1\t1,235\n"),
            "log.csv:2: expected a number of one reading: decimals or thousands, found \"1,234\". State --decimal "
            "comma or --decimal point.");
  EXPECT_EQ(said("t [s],a\n0,5,23,4\n1,0,23,5\n1,5,23,6\n"),
            "log.csv:2: expected 2 values, one for each name of line 1, found 4. Separators and decimal commas are "
            "ambiguous. Export with semicolons or tabs between the values, or with decimal points.");
  EXPECT_EQ(said(std::string("\x7F"
                             "ELF\0\0\1\2",
                             8)),
            "log.csv:1: expected text, a workbook (.xlsx) or a .mat file, found another binary file.");
  // The values of A and B are 2 apart, each moves by 1: two channels, or one reading in two states.
  EXPECT_EQ(said("name,t_s,v\nA,0,0\nB,1,2\nA,2,1\nB,3,3\nA,4,2\nB,5,4\nA,6,1\nB,7,3\nA,8,0\nB,9,2\n"),
            "log.csv:2: expected rows of one layout, found that they are one table or 2 channels below each other, "
            "named in \"name\". For one table use --leave-out name; else export a column for each channel.");
}

TEST(log, names_and_units_are_told_by_the_rows_below_them) {
  // The first line has as many cells as the table, the fourth says only how values were taken.
  const Log log = read_log(
      "\"TOA5\",\"Bridge\",\"CR6\",\"1001\",\"OS 9\"\n"
      "\"TIMESTAMP\",\"RECORD\",\"T_gauge\",\"Digits\",\"Gap\"\n\"TS\",\"RN\",\"Deg C\",\"Digits\",\"mm\"\n"
      "\"\",\"\",\"Smp\",\"Smp\",\"Smp\"\n\"2026-02-01 00:00:00\",7,14.0,4199.3,0.5\n"
      "\"2026-02-01 00:15:00\",8,\"NAN\",4198.8,0.75\n\"2026-02-01 00:30:00\",9,14.5,4198.5,1.0\n",
      "log.dat");
  EXPECT_EQ(text_of(log),
            "T_gauge_degC structure: 14 nan 14.5; Digits event: 4199.3 4198.8 4198.5; Gap_um measured: 500 750 1000; ");
  EXPECT_EQ(log.names_from, "names from line 2, units from line 3");
  EXPECT_EQ(log.columns.front().why, "counts the rows");
  // Types between names and units; names above numbers of channels.
  EXPECT_EQ(read_log("time,bed\ndatetime,float\ns,degC\n0,20\n1,21\n2,22\n", "f").columns.front().source, "bed");
  EXPECT_EQ(
      read_log("Channel,101\nName,bed\nUnit,degC\n10:00:00,20\n10:00:01,21\n10:00:02,22\n", "f").columns.front().source,
      "bed");
}

TEST(log, a_row_with_a_remark_is_data) {
  for (const char* const text :
       {"t (s),Z (um),note\n0,1,re-clamped\n1,2,\n2,4,\n3,5,\n", "t (s),Z (um)\n0,1,re-clamped\n1,2\n2,4\n3,5\n",
        "t (s),note,Z (um)\n0,re-clamped,1\n1,,2\n2,,4\n3,door,5\n"}) {
    const Log log = read_log(text, "f");
    EXPECT_EQ(text_of(log), "Z_um measured: 1 2 4 5; ") << text;
    EXPECT_EQ(log.first_row_line, 2u);
  }
}

TEST(log, units_may_stand_beside_the_values) {
  EXPECT_EQ(text_of(read_log("t_s,Ch1,unit,Ch2,unit\n0,20.5,C,1.5,um\n1,20.6,C,2.5,um\n2,20.7,C,2.0,um\n", "f")),
            "Ch1_degC structure: 20.5 20.6 20.7; Ch2_um measured: 1.5 2.5 2; ");
}

TEST(log, numbers_of_the_columns_are_no_row) {
  const Log log = read_log("0,1,2,3\n20.5,20.6,20.7,1\n20.6,20.7,20.9,3\n20.7,20.8,20.9,2\n", "f");
  EXPECT_EQ(log.first_row_line, 2u);
  EXPECT_EQ(log.columns.back().role, Role::measured);
}

TEST(log, names_may_stand_beside_the_values) {
  const Log log = read_log(
      "Sampling period is 1000000 nSec \n\nj.0.pos +1,5 j.0.on +0 \nj.0.pos +1,75 j.0.on +1 \n"
      "j.0.pos +2,5 j.0.on +1 \n",
      "f");
  EXPECT_EQ(text_of(log), "j_0_pos measured: 1.5 1.75 2.5; j_0_on event: 0 1 1; ");
  EXPECT_EQ(log.series.time_s, (std::vector<double>{0, 0.001, 0.002}));
  EXPECT_EQ(text_of(read_log("T1: 20.5 C Z: 1.5 um\nT1: 20.6 C Z: 2.5 um\nT1: 20.7 C Z: 2.0 um\n", "f")),
            "T1_degC structure: 20.5 20.6 20.7; Z_um measured: 1.5 2.5 2; ");
}

TEST(log, channels_below_each_other_become_columns) {
  // Worked by hand: A at 0, 0.2 and 0.4 s, B at 0.1 and 0.2 s.
  const Log log = read_log(
      "M:A-Pos 2026-03-02 11:00:00.0 10.5  \nM:A-Pos 2026-03-02 11:00:00.2 10.75 HIGH MINOR\n"
      "M:A-Pos 2026-03-02 11:00:00.4 10.0  \nM:B-Pos 2026-03-02 11:00:00.1 -2.5  \n"
      "M:B-Pos 2026-03-02 11:00:00.2 -2.75  \nM:B-Pos 2026-03-02 11:00:00.3 -2.5  \n",
      "f");
  EXPECT_EQ(text_of(log), "M_A_Pos measured: 10.5 nan 10.75 nan 10; M_B_Pos measured: nan -2.5 -2.75 -2.5 nan; ");
  EXPECT_EQ(log.series.time_s, (std::vector<double>{0, 0.1, 0.2, 0.3, 0.4}));
  EXPECT_EQ(log.series.started, "2026-03-02T11:00:00");
  // With units, in the order of time; the channel that lags has its own stamps.
  std::string tidy = "timestamp,sensor,value,unit\n";
  for (int i = 0; i < 4; ++i)
    tidy += fmt::format("2026-03-02T10:0{}:00,room,2{}.0,°F\n2026-03-02T10:0{}:30,Z,{}.5,mm\n", i, 5 - i, i, i);
  EXPECT_EQ(text_of(read_log(tidy, "f")).substr(0, 25), "room_degC ambient: -3.888");
  EXPECT_EQ(read_log(tidy, "f").series.columns.back().name, "Z_um");
  // Without a clock each turn is a row.
  EXPECT_EQ(text_of(read_log("Z,1.5\nT_bed,20.5\nZ,2.5\nT_bed,20.4\nZ,2.0\nT_bed,20.6\n", "f")),
            "Z measured: 1.5 2.5 2; T_bed_degC structure: 20.5 20.4 20.6; ");
  // Numbers of sensors; a column of such a name that is none.
  EXPECT_EQ(text_of(read_log("sensor,t_s,Z (um)\n1,0,2\n2,0,5\n1,1,3\n2,1,4\n1,2,1\n2,2,6\n", "f")),
            "sensor_1_um measured: 2 3 1; sensor_2_um measured: 5 4 6; ");
  EXPECT_EQ(text_of(read_log("probe,t_s,T1_degC\n1,0,20\n2,1,21\n1,2,22\n2,3,22\n1,4,21\n2,5,20\n", "f")),
            "probe measured: 1 2 1 2 1 2; T1_degC structure: 20 21 22 22 21 20; ");
  // A state is no channel.
  EXPECT_EQ(text_of(read_log("t_s,Z_um,phase\n0,1,up\n1,2,up\n2,3,down\n3,2,down\n4,1,up\n5,0,up\n", "f")),
            "Z_um measured: 1 2 3 2 1 0; ");
}

TEST(log, points_have_three_coordinates) {
  const Log log = read_log(
      "// Points in frame 'A::WORLD'\n// AXES = CARTESIAN: X,  Y,  Z (mm)\n"
      "Rest,  Main,  1,  2296.5,  -2416.25,  -442.5,  03/14/26 16:38:29\n"
      "Rest,  Main,  2,  2296.6,  -2416.5,  -442.25,  03/14/26 16:38:29\n"
      "Rest,  Main,  3,  2296.7,  -2416.0,  -442.75,  03/14/26 16:38:30\n"
      "Rest,  Main,  4,  2296.6,  -2416.5,  -442.25,  03/14/26 16:38:30\n",
      "f");
  EXPECT_EQ(text_of(log),
            "X_um measured: 2296500 2296600 2296700 2296600; Y_um measured: -2416250 -2416500 -2416000 -2416500; "
            "Z_um measured: -442500 -442250 -442750 -442250; ");
  EXPECT_EQ(log.names_from, "points: names from line 2");
  EXPECT_EQ(log.series.time_s, (std::vector<double>{0, 0.5, 1, 1.5}));
}

TEST(log, a_date_at_midnight_goes_with_the_time_beside_it) {
  for (const char* const text :
       {"Date,Time,Z um\n2026-05-01 00:00:00,23:59:00,1\n2026-05-02 00:00:00,00:00:00,2\n2026-05-02 "
        "00:00:00,00:01:00,4\n",
        "Date,Time,Z um\n2026-05-01,0.9993055555556,1\n2026-05-02,0,2\n2026-05-02,0.0006944444444,4\n"}) {
    const Log log = read_log(text, "f");
    EXPECT_EQ(log.series.started, "2026-05-01T23:59:00") << text;
    ASSERT_EQ(log.series.time_s.size(), 3u);
    EXPECT_NEAR(log.series.time_s[1], 60.0, 1e-4);
    EXPECT_NEAR(log.series.time_s[2], 120.0, 1e-4);
    EXPECT_EQ(log.columns.size(), 1u);
  }
}

double warm(std::size_t row, double start) { return start + 8.0 * (1.0 - std::exp(-static_cast<double>(row) / 30.0)); }

TEST(log, without_names_the_last_column_is_proposed) {
  // Five temperatures, one of them warm from the run before; a displacement.
  std::string text;
  for (std::size_t row = 0; row < 60; ++row) {
    for (const double start : {18.0, 20.0, 22.0, 21.0, 45.0}) text += fmt::format("{:.1f};", warm(row, start));
    text += fmt::format("{:.1f}\n", 3.0 * (warm(row, 0.0)) - 2.0);
  }
  const Log log = read_log(text, "f");
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(log.columns[i].unit, "degC");
  EXPECT_EQ(log.columns[5].role, Role::measured);
  EXPECT_EQ(log.columns[5].why, "the last of the columns without names, in which unit?");
}

TEST(log, rows_without_a_time_are_numbered) {
  const Log log = read_log("a,b\n1,2\n3,5\n4,4\n", "log.csv");
  EXPECT_FALSE(log.series.has_clock);
  EXPECT_EQ(log.series.time_s, (std::vector<double>{0.0, 1.0, 2.0}));
  EXPECT_EQ(log.unclear.front(), "No column holds the time, and no line states the interval of the rows.");
  LogRecipe every;
  every.every_s = 10.0;
  EXPECT_TRUE(read_log("a,b\n1,2\n3,5\n4,4\n", "log.csv", every).series.has_clock);
  LogRecipe none;
  none.time = "none";
  EXPECT_FALSE(read_log("time_s,b\n1,2\n3,5\n2,4\n", "log.csv", none).series.has_clock);
  // A series keeps it.
  EXPECT_FALSE(read_series(write_series(log.series), "series").has_clock);
}

TEST(log, temperatures_are_told_by_names_and_by_how_they_move) {
  const std::string text = table("delta L,T0,T1,T2,Spindel fornt,Humidity,valve,count", 60, [](std::size_t i) {
    return fmt::format("{:.3f},{:.2f},{:.2f},{:.2f},{:.2f},{:.1f},{},{}", 0.1 * static_cast<double>(i), warm(i, 20.0),
                       warm(i, 20.5), warm(i, 21.0), warm(i, 22.0), 45.0 + 0.01 * static_cast<double>(i), 30, i);
  });
  const Log log = read_log(text, "log.csv");
  std::string columns;
  for (const LogColumn& column : log.columns) columns += fmt::format("{} {}; ", column.name, name_of(column.role));
  EXPECT_EQ(columns,
            "delta_L measured; T0_degC structure; T1_degC structure; T2_degC structure; Spindel_fornt_degC housing; "
            "Humidity event; valve event;  event; ");
  EXPECT_EQ(log.remarks.front(), "T0 to T2: temperatures by name and values, degC.");
}

TEST(log, what_does_not_move_as_a_temperature_is_none) {
  // From row to row as far as it ever moves; out of the range of a machine; without a name of a temperature.
  const auto unit = [](std::string_view name, const std::function<double(std::size_t)>& value) {
    const std::string text =
        table(fmt::format("time_s,{}", name), 40, [&](std::size_t i) { return fmt::format("{},{:.2f}", i, value(i)); });
    return read_log(text, "log.csv").columns.front().unit;
  };
  EXPECT_EQ(unit("T bed", [](std::size_t i) { return warm(i, 20.0); }), "degC");
  EXPECT_EQ(unit("bed", [](std::size_t i) { return i % 2 == 0 ? 10.0 : 60.0; }), "");
  EXPECT_EQ(unit("bed", [](std::size_t i) { return warm(i, 200.0); }), "");
  EXPECT_EQ(unit("bed pressure", [](std::size_t i) { return warm(i, 20.0); }), "");
  EXPECT_EQ(unit("quality", [](std::size_t i) { return warm(i, 20.0); }), "");
}

TEST(log, names_in_any_case_and_patterns_state_units_and_roles) {
  LogRecipe recipe;
  recipe.columns = {{"*", "", "um", std::nullopt, false}, {"X1", "", "", Role::event, false}};
  const Log log = read_log("time_s,x1,y1,T_degC\n0,1,2,20\n1,2,3,21\n2,3,4,22\n", "log.csv", recipe);
  EXPECT_EQ(text_of(log), "x1_um event: 1 2 3; y1_um measured: 2 3 4; T_degC structure: 20 21 22; ");
  recipe.columns = {{"mcu_pos_z", "", "2.5um", std::nullopt, false}};
  EXPECT_EQ(text_of(read_log("time_s,mcu_pos_z\n0,4\n1,8\n", "log.csv", recipe)), "mcu_pos_z_um measured: 10 20; ");
  recipe.columns = {{"mcu_pos_z", "", "2.5", std::nullopt, false}};
  EXPECT_EQ(
      said("time_s,mcu_pos_z\n0,4\n1,8\n", recipe),
      "log.csv: mcu_pos_z: expected a unit such as um, mm, degC, rpm, A, kW, bar or %, a scale such as 2.5um, or none, "
      "found \"2.5\".");
}

TEST(log, a_column_is_named_as_the_file_or_the_series_names_it_with_its_unit_or_without) {
  const Log log = read_log(
      "time_s,pos_steps,T room [\xC2\xB0"
      "C],Probe Z (um),Probe Z (mm),Last/%\n"
      "0,1,20.1,1,5,30\n1,2,20.2,2,5.1,31\n2,4,20.3,3,5.2,33\n",
      "log.csv", {.columns = {{"pos", "", "1.25um", std::nullopt, false}}});
  const auto named = [&](const std::string& typed) {
    try {
      return column_named(log.series, typed);
    } catch (const Error& error) {
      return std::string(error.what());
    }
  };
  for (const char* typed : {"pos", "pos_steps", "pos_um", "POS", "pos_steps_um"})
    EXPECT_EQ(named(typed), "pos_steps_um") << typed;
  for (const char* typed : {"T room", "t_room", "T room (C)",
                            "T room [\xC2\xB0"
                            "C]",
                            "T_room_degC"})
    EXPECT_EQ(named(typed), "T_room_degC") << typed;
  EXPECT_EQ(named("last"), "Last_percent");
  EXPECT_EQ(named("Probe Z (um)"), "Probe_Z_um");
  EXPECT_EQ(named("probe z [mm]"), "Probe_Z_2_um");
  EXPECT_EQ(named("probe Z"),
            "expected the name of one column, found \"probe Z\", which may be \"Probe Z (um)\" or \"Probe Z (mm)\"; "
            "state its unit too.");
  EXPECT_EQ(named("Probe"), "Probe");
  EXPECT_EQ(
      said("time_s,Probe Z (um),Probe Z (mm),x\n0,1,5,1\n1,2,5.1,2\n", {.columns = {{"probe z", "", "", {}, true}}}),
      "log.csv:1: expected the name of one column, found \"probe z\", which may be \"Probe Z (um)\" or \"Probe Z "
      "(mm)\"; state its unit too.");
  EXPECT_EQ(text_of(read_log("Elapsed (s),Z (um)\n0,1\n1,2\n", "log.csv", {.time = "elapsed"})),
            "Z_um measured: 1 2; ");
}

TEST(log, a_clock_is_set_by_a_shift) {
  const LogRecipe recipe{.shifts = {{"room*.csv", 21600.0}, {"other.csv", 60.0}}};
  const char* const text = "Time,Z (um)\n2026-03-09 22:00:00,1\n2026-03-09 22:01:00,2\n";
  const Log log = read_log(text, "data/room-1.csv", recipe);
  EXPECT_EQ(log.series.started, "2026-03-10T04:00:00");
  EXPECT_EQ(log.series.time_s, (std::vector<double>{0, 60}));
  EXPECT_EQ(log.remarks, (std::vector<std::string>{"Its clock is set 6 h later, as --shift states."}));
  EXPECT_EQ(read_recipe(write_recipe(log.recipe), "r.toml").shifts, recipe.shifts);
  EXPECT_EQ(read_log(text, "a.csv", recipe).series.started, "2026-03-09T22:00:00");
  EXPECT_EQ(read_log("t (s),Z (um)\n0,1\n60,2\n", "other.csv", recipe).series.time_s, (std::vector<double>{60, 120}));
  EXPECT_THROW(read_log("Z (um)\n0.5\n2\n", "other.csv", recipe), Error);
}

TEST(log, numbers_and_states_are_no_temperatures) {
  const std::string text = table("time_s,z_um,table_no,bed id,T3,T4,T5,F1,F2,F3", 200, [](std::size_t i) {
    const double t = warm(i, 20.0);
    return fmt::format("{0},{1:.2f},7,12,{1:.2f},{2:.2f},{1:.2f},{1:.2f},{1:.2f},{1:.2f}", i, t, i == 100 ? 200.0 : t);
  });
  const Log log = read_log(text, "log.csv");
  std::string units;
  for (const LogColumn& column : log.columns)
    units += fmt::format("{}{} ", column.source, column.unit.empty() ? "" : "*");
  // The spike of T4 is one value in 200.
  EXPECT_EQ(units, "z_um* table_no bed id T3* T4* T5* F1 F2 F3 ");
}

TEST(log, a_role_that_is_stated_stays) {
  const std::string text =
      table("time_s,pos_z,T9", 50, [](std::size_t i) { return fmt::format("{},{},{:.2f}", i, 3 * i, warm(i, 20.0)); });
  LogRecipe recipe;
  recipe.columns = {{"pos_z", "", "", Role::event, false}, {"T9", "", "", Role::event, false}};
  EXPECT_TRUE(read_log(text, "log.csv", recipe).series.columns[1].name == "T9");
  EXPECT_EQ(read_log(text, "log.csv", recipe).series.columns[0].role, Role::event);
  EXPECT_EQ(read_log(text, "log.csv").series.columns[0].role, Role::measured);
}

TEST(log, an_axis_is_no_probe_beside_one) {
  const Log log = read_log("time_s,z_um,X,Y\n0,1,10,20\n1,2,11,21\n2,3,12,22\n", "log.csv");
  EXPECT_EQ(text_of(log), "z_um measured: 1 2 3; X event: 10 11 12; Y event: 20 21 22; ");
}

TEST(log, delimiters_at_the_ends_of_rows_shift_no_name) {
  const Log log = read_log("Time (s),z (um),T (degC)\n0,0.1,20.00,\n1,0.2,20.10,\n2,0.3,20.20,\n", "log.csv");
  EXPECT_EQ(text_of(log), "z_um measured: 0.1 0.2 0.3; T_degC structure: 20 20.1 20.2; ");
}

TEST(log, another_file_stands_beside_row_by_row) {
  const ScratchFolder folder;
  folder.write("y.csv", "time,Dia\n5,1.5\n6,2.5\n7,3.5\n");
  LogRecipe recipe;
  recipe.join = {(folder.path() / "y.csv").string()};
  recipe.columns = {{"Dia", "", "mm", std::nullopt, false}, {"a", "", "", Role::ambient, false}};
  EXPECT_EQ(text_of(read_log("time_s,a_degC\n0,20\n10,21\n20,22\n", "x.csv", recipe)),
            "a_degC ambient: 20 21 22; Dia_um measured: 1500 2500 3500; ");
  // A row that one of them lacks would shift all behind it.
  EXPECT_EQ(said("time_s,a_degC\n0,20\n10,21\n,21\n20,22\n", recipe),
            "log.csv: expected only rows of numbers, because the files are joined row by row, found 1 other line "
            "between the first and the last row.");
  recipe.columns = {{"nosuch", "", "mm", std::nullopt, false}};
  EXPECT_EQ(
      said("time_s,a_degC\n0,20\n10,21\n20,22\n", recipe),
      "log.csv:1: expected a column \"nosuch\", as stated by the options or the recipe, found none; the nearest is "
      "\"a_degC\".");
}

TEST(log, what_is_stated_of_a_series_stands) {
  const Series series = read_series(
      "# format = \"ballbar-series 1\"\n# clock = false\n# [columns.dz]\n# role = "
      "\"measured\"\ntime_s,dz,T_degC\n0,1,20\n1,2,21\n",
      "s.csv");
  LogRecipe recipe;
  recipe.every_s = 10.0;
  recipe.columns = {{"dz", "T", "mm", std::nullopt, false}, {"T_degC", "", "", Role::ambient, false}};
  const Series stated = with_stated_columns(series, recipe, "s.csv");
  EXPECT_TRUE(stated.has_clock);
  EXPECT_EQ(stated.time_s, (std::vector<double>{0.0, 10.0}));
  EXPECT_EQ(stated.columns[0].name, "T_um");
  EXPECT_EQ(stated.columns[0].values, (std::vector<double>{1000.0, 2000.0}));
  EXPECT_EQ(stated.columns[1].role, Role::ambient);
  recipe.columns = {{"T_degC", "", "um", std::nullopt, false}};
  EXPECT_EQ(complaint(ScratchFolder(), [&] { with_stated_columns(series, recipe, "s.csv"); }),
            "s.csv: T_degC: expected no other unit than degC, which its name states, found \"um\".");
  recipe.columns.clear();
  recipe.join = {"y.csv"};
  EXPECT_EQ(complaint(ScratchFolder(), [&] { with_stated_columns(series, recipe, "s.csv"); }),
            "s.csv: expected a log for --join, found a ballbar series.");
}

TEST(log, a_few_rows_of_garbage_are_skipped_with_their_lines) {
  const auto with = [](std::size_t garbage) {
    return table("time_s,z_um,T_degC", 400, [garbage](std::size_t i) {
      return i >= 100 && i < 100 + garbage ? fmt::format("{},#!x7,21.5", i) : fmt::format("{},{}.25,21.5", i, i % 7);
    });
  };
  const Log log = read_log(with(6), "log.csv");
  EXPECT_EQ(log.series.time_s.size(), 394u);
  EXPECT_EQ(log.skipped_lines, (std::vector<std::size_t>{102, 103, 104, 105, 106, 107}));
  EXPECT_EQ(said(with(7)),
            "log.csv:102: expected a number for \"z_um\", found \"#!x7\". Use --missing to read such a text as a gap. "
            "This affects 7 of 400 rows. Use --skip-bad-rows to omit them.");
  LogRecipe all;
  all.skip_bad_rows = true;
  EXPECT_EQ(read_log(with(40), "log.csv", all).skipped_lines.size(), 40u);
}

TEST(log, a_user_states_the_line_of_the_names) {
  const std::string text =
      "t s;front degC;probe um\nn1;n2;n3\n0;20.5;1.25\n10;20.75;1.5\n20;21.25;1.75\n30;21.5;2.25\n";
  const auto sources = [&](std::size_t line) {
    LogRecipe recipe;
    recipe.header_line = line;
    std::vector<std::string> names;
    for (const LogColumn& column : read_log(text, "log.csv", recipe).columns) names.push_back(column.source);
    return names;
  };
  EXPECT_EQ(sources(1), (std::vector<std::string>{"front degC", "probe um"}));
  EXPECT_EQ(sources(2).back(), "n3");
  LogRecipe beyond;
  beyond.header_line = 90;
  EXPECT_EQ(said(text, beyond),
            "log.csv:90: expected the names of the columns, as --header-line states, found no text.");
}

TEST(log, a_line_that_ends_within_a_number_gives_no_value) {
  const std::string text = table("time_s,z_um,T_degC", 200, [](std::size_t i) {
    return i == 50 ? fmt::format("{},1.25,2", i) : fmt::format("{},1.25,21.50", i);
  });
  const Log cut = read_log(text, "log.csv");  // "2" of 21.50 is a whole row: it may be a value
  EXPECT_EQ(cut.series.columns[1].values[50], 2.0);
  const Log early =
      read_log(table("time_s,z_um,T_degC", 200,
                     [](std::size_t i) { return i == 50 ? fmt::format("{},1.", i) : fmt::format("{},1.25,21.50", i); }),
               "log.csv");
  EXPECT_TRUE(std::isnan(early.series.columns[0].values[50]));
  EXPECT_EQ(early.remarks.back(), "1 line cut off within a number, read as a gap: line 52.");
}

TEST(log, rows_in_bursts_become_their_means) {
  LogRecipe recipe;
  recipe.burst_means = true;
  const Log log = read_log("time_s,z_um\n0,1\n1,2\n2,3\n60,4\n61,\n62,6\n120,7\n121,8\n122,9\n", "log.csv", recipe);
  EXPECT_EQ(log.series.time_s, (std::vector<double>{1.0, 61.0, 121.0}));
  EXPECT_EQ(text_of(log), "z_um measured: 2 5 8; ");
  EXPECT_EQ(said("time_s,z_um\n0,1\n1,2\n2,3\n", recipe),
            "log.csv: expected rows in bursts for --burst-means, found none.");
}

TEST(log, names_one_fewer_than_the_columns_are_those_behind_the_row_names) {
  const Log log = read_log("\"dz\" \"T1\"\n\"1\" 0.5 20.5\n\"2\" 0.75 20.6\n\"3\" 1 20.7\n", "log.txt");
  EXPECT_EQ(log.columns.back().source, "T1");
  EXPECT_EQ(log.series.columns.back().values.front(), 20.5);
}

TEST(log, damaged_workbooks_and_mat_files_are_refused) {
  EXPECT_EQ(said("PK\x03\x04 and then nothing"),
            "log.csv:1: expected a whole workbook (.xlsx), found a damaged archive.");
  EXPECT_EQ(said("MATLAB 5.0 MAT-file and then nothing"),
            "log.csv:1: expected a whole .mat file, found a damaged one.");
  EXPECT_EQ(
      said("{\"a\": 1}"),
      "log.csv:1: expected JSON with rows, [{\"time_s\": 0, ...}, ...], or columns, {\"time_s\": [0, ...], ...}, found "
      "neither.");
}

TEST(log, json_rows_and_columns) {
  EXPECT_EQ(text_of(read_log("{\"points\": [{\"time_s\": 0, \"x_um\": 1.5}, {\"time_s\": 60, \"x_um\": null}, "
                             "{\"time_s\": 120, \"x_um\": 2}]}",
                             "a.json")),
            "x_um measured: 1.5 nan 2; ");
  EXPECT_EQ(text_of(read_log("{\"time_s\": [0, 1], \"n_rpm\": [100, 200]}", "a.json")), "n_rpm speed: 100 200; ");
}

TEST(log, a_recipe_keeps_what_was_found_and_what_was_said) {
  LogRecipe recipe;
  recipe.columns = {{"b", "room", "degF", Role::ambient, false}, {"c", "", "", std::nullopt, true}};
  const std::string text = "t [s],b,c\n0,32,1\n1,212,2\n";
  const Log log = read_log(text, "log.csv", recipe);
  EXPECT_EQ(text_of(log), "room_degC ambient: 0 100; ");
  const LogRecipe again = read_recipe(write_recipe(log.recipe), "recipe.toml");
  EXPECT_EQ(text_of(read_log(text, "log.csv", again)), text_of(log));
  EXPECT_EQ(write_recipe(again), write_recipe(log.recipe));
  EXPECT_EQ(
      said("t [s],x,c\n0,32,1\n1,212,2\n", recipe),
      "log.csv:1: expected a column \"b\", as stated by the options or the recipe, found none; the nearest is \"x\".");
}

TEST(log, a_series_of_it_reads_back) {
  const Log log = read_log(
      "Zeit;Raum [°C];Load [%];Ventil [%]\n22.11.2026 13:05:10;20,5;30;1\n22.11.2026 13:05:11;20,6;31;0\n", "log.csv");
  const Series again = read_series(write_series(log.series), "clean.csv");
  ASSERT_EQ(again.columns.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(again.columns[i].name, log.series.columns[i].name);
    EXPECT_EQ(again.columns[i].role, log.series.columns[i].role);
    EXPECT_EQ(again.columns[i].values, log.series.columns[i].values);
  }
  EXPECT_EQ(again.started, "2026-11-22T13:05:10");
}

// Rows of one minute: the cells of a row behind the time.
std::string minutes(std::string_view names, int rows, const std::function<std::string(int)>& cells) {
  std::string text = fmt::format("time_min,{}\n", names);
  for (int row = 0; row < rows; ++row) text += fmt::format("{},{}\n", row, cells(row));
  return text;
}

std::string columns_of(const Log& log) {
  std::string text;
  for (const Column& column : log.series.columns) text += fmt::format("{} {}; ", column.name, name_of(column.role));
  return text;
}

TEST(log, what_is_held_at_few_levels_is_no_temperature) {
  const Log log = read_log(minutes("coolant on,Chiller,chiller 2 (C),Valve_A,T_C,room", 40,
                                   [](int row) {
                                     const int on = row / 5 % 2;
                                     return fmt::format("{},{},{},{},{:.1f},{}", on, 18 + 6 * on, 18 + 6 * on, on,
                                                        20 + 0.1 * row, 20 + row / 20);
                                   }),
                           "log.csv");
  EXPECT_EQ(columns_of(log),
            "coolant_on event; Chiller event; chiller_2_degC coolant; Valve_A event; T_degC structure; room_degC "
            "ambient; ");
}

TEST(log, words_for_on_and_off_are_1_and_0) {
  const Log log = read_log(
      "time_s,door,Pumpe,Coolant,mode,z_um\n0,open,aus,off,auto,1\n1,closed,ein,off,hand,2\n2,open,ein,on,auto,3\n"
      "3,,aus,OFF,auto,3\n",
      "log.csv");
  EXPECT_EQ(text_of(log),
            "door event: 1 0 1 nan; Pumpe event: 0 1 1 0; Coolant event: 0 0 1 0; z_um measured: 1 2 3 3; ");
  EXPECT_TRUE(sentence_of(log).ends_with("1 measured column, 3 others, 1 left out: mode (text).")) << sentence_of(log);
  // Of a thermocouple, "open" is a broken wire.
  EXPECT_EQ(text_of(read_log("time_s,T1 (C),z_um\n0,20,1\n1,open,2\n2,20.5,3\n", "log.csv")),
            "T1_degC structure: 20 nan 20.5; z_um measured: 1 2 3; ");
}

TEST(log, a_room_in_degrees_fahrenheit) {
  const auto warm = [](int row) {
    return fmt::format("{:.1f},{:.1f},{:.1f}", 68 + 0.1 * row, 86 + 0.1 * row, 0.1 * row);
  };
  // 68 degF are 20 degC, 86 degF 30 degC.
  const Log log = read_log(minutes("Room F,Motor F,z (um)", 20, warm), "log.csv");
  EXPECT_EQ(columns_of(log), "Room_degC ambient; Motor_degC structure; z_um measured; ");
  EXPECT_NEAR(log.series.columns[0].values[0], 20.0, 1e-9);
  EXPECT_NEAR(log.series.columns[1].values[0], 30.0, 1e-9);
  // No letter says which unit: no room is at 68 degC.
  EXPECT_EQ(columns_of(read_log(minutes("Room,Motor,z (um)", 20, warm), "log.csv")), columns_of(log));
}

// 850 and -242 degC of a broken wire, 60 K off for one row; a pulse of one row of a pump and of a chiller stay, and so
// does what is measured.
TEST(log, failed_temperatures_are_gaps_and_pulses_are_none) {
  const auto cells = [](int row) {
    const double motor = row == 30 || row == 31 ? 850.0 : row == 60 ? -242.0 : row == 80 ? 95.0 : 20.0 + 0.1 * row;
    return fmt::format("{:.1f},{},{},{:.1f}", motor, row == 50 ? 1 : 0, row == 50 ? 24 : 18,
                       row == 70 ? 300.0 : 0.1 * row);
  };
  const Log log = read_log(minutes("motor (C),pump,chiller (C),z (um)", 100, cells), "log.csv");
  const auto gaps = [&](std::size_t column) { return log.columns[column].gaps; };
  EXPECT_EQ(gaps(0), 4U);
  EXPECT_EQ(gaps(1) + gaps(2) + gaps(3), 0U);
  ASSERT_EQ(log.remarks.size(), 2U);
  EXPECT_EQ(log.remarks[0], "motor (C): 3 times -242 and the like: read as a missing value.");
  EXPECT_EQ(log.remarks[1],
            "motor (C): 1 single value far off, such as 95 between 27.9 and 28.1: read as a missing value.");
}

TEST(log, sentinels_go_only_where_they_stand_far_outside) {
  const auto values = [](const std::string& a, const std::string& b, const std::string& c) {
    return read_log("t [s],a [°C]\n0," + a + "\n1," + b + "\n2," + c + "\n", "log.csv").series.columns.front().values;
  };
  EXPECT_TRUE(std::isnan(values("20", "-999", "21")[1]));
  EXPECT_TRUE(std::isnan(values("20", "9.9E37", "21")[1]));
  EXPECT_EQ(values("-990", "-999", "-1005")[1], -999.0);
}

TEST(log, names_and_units_of_headers) {
  const auto of = [](std::string_view header) {
    const NameAndUnit both = name_and_unit(header);
    return both.name + "|" + both.unit;
  };
  EXPECT_EQ(of("Temp 1 [°C]"), "Temp 1|°C");
  EXPECT_EQ(of("Speed (rpm)"), "Speed|rpm");
  EXPECT_EQ(of("Load/%"), "Load|%");
  EXPECT_EQ(of("Speed/U/min"), "Speed|U/min");
  EXPECT_EQ(of("Power in kW"), "Power|kW");
  EXPECT_EQ(of("t/ms"), "t|ms");
  EXPECT_EQ(of("T_min"), "T|min");  // a t is a word for time
  EXPECT_EQ(of("Temp_min"), "Temp_min|");
  EXPECT_EQ(of("Pump A"), "Pump A|");
  EXPECT_EQ(of("Temp 1 [avg]"), "Temp 1 [avg]|");
}

TEST(log, units_as_people_write_them) {
  const auto of = [](std::string_view text) {
    const auto unit = log_unit(text);
    return unit ? fmt::format("{} {:.6g}", unit->canonical, unit->factor) : std::string("none");
  };
  for (const char* text : {"°C", "º C", "degC", "℃", "[°C]", "Â°C", "deg C"}) {
    EXPECT_EQ(of(text), std::string(text) == "º C" ? "degC 1" : "degC 1") << text;
  }
  for (const char* text : {"1/min", "min-1", "min⁻¹", "U/min", "tr/min", "giri/min", "rpm", "转/分"})
    EXPECT_EQ(of(text), "rpm 1") << text;
  for (const char* text : {"µm", "μm", "um", "micron"}) EXPECT_EQ(of(text), "um 1") << text;
  EXPECT_EQ(of("nm"), "um 0.001");
  EXPECT_EQ(of("Nm"), "Nm 1");
  EXPECT_EQ(of("in"), "um 25400");
  EXPECT_EQ(of("furlong"), "none");
}

TEST(log, numbers_of_two_decimal_signs) {
  EXPECT_EQ(cell_number("1.234,5", ','), 1234.5);
  EXPECT_EQ(cell_number("1,234.5", '.'), 1234.5);
  EXPECT_EQ(cell_number("12\xC2\xA0"
                        "345,6",
                        ','),
            12345.6);
  EXPECT_EQ(cell_number("1'234.5", '.'), 1234.5);
  EXPECT_EQ(cell_number("+ 20,78", ','), 20.78);
  EXPECT_EQ(cell_number("1,5E-03", ','), 1.5e-3);
  EXPECT_EQ(cell_number("1.5D+01", '.'), 15.0);
  EXPECT_EQ(cell_number("1.5", ','), std::nullopt);  // no group of three
  EXPECT_EQ(cell_number("12,5", '.'), std::nullopt);
  EXPECT_TRUE(is_missing("#NV") && is_missing("---") && is_missing("+OVER") && is_missing("") && is_missing("NaN"));
  EXPECT_FALSE(is_missing("12") || is_missing("door open"));
}

TEST(log, stamps) {
  const auto of = [](std::string_view text) -> std::string {
    const auto stamp = time_stamp(text, DateOrder::day_first);
    if (!stamp) return "none";
    return (stamp->day ? stamp_text(static_cast<double>(*stamp->day) * 86400.0 + stamp->clock_s.value_or(0.0))
                       : fmt::format("{}", *stamp->clock_s));
  };
  for (const char* text : {"2026-11-22T13:05:10", "2026/11/22 13:05:10", "22.11.2026 13:05:10", "22/11/2026 13:05:10",
                           "11/22/2026 1:05:10 PM", "22-Nov-2026 13:05:10", "22. November 2026 13:05:10",
                           "22 nov. 2026 13:05:10", "Nov 22, 2026 13:05:10", "20261122 130510", "20261122130510",
                           "2026年11月22日 13时05分10秒", "Sun Nov 22 13:05:10 2026", "13:05:10 22.11.2026",
                           "22.11.26 13:05:10", "2026-11-22 13:05:10 CET", "22/11/2026 1:05:10 p. m."}) {
    EXPECT_EQ(of(text), "2026-11-22T13:05:10") << text;
  }
  EXPECT_EQ(of("2026-11-22 13:05:10,5"), "2026-11-22T13:05:10.500");
  EXPECT_EQ(of("05:10.3"), "310.3");
  EXPECT_EQ(of("0.5 sec"), "0.5");
  EXPECT_EQ(of("1.02:30:00"), "95400");
  for (const char* text : {"31.02.2026", "2026-13-01", "25", "abc", "22.11", "", "1e5", "10:75:00"})
    EXPECT_EQ(of(text), "none") << text;
}

TEST(log, formats_of_workbooks) {
  EXPECT_EQ(number_format("dd.mm.yyyy hh:mm"), NumberFormat::date_and_clock);
  EXPECT_EQ(number_format("[$-407]d. mmm yyyy"), NumberFormat::date);
  EXPECT_EQ(number_format("[h]:mm:ss"), NumberFormat::elapsed);
  EXPECT_EQ(number_format("0.00\" days\""), NumberFormat::plain);
  EXPECT_EQ(number_format("0.0%"), NumberFormat::percent);
  EXPECT_EQ(number_format("General"), NumberFormat::plain);
  EXPECT_EQ(shown_days(46348.5, NumberFormat::date_and_clock, false), "2026-11-22T12:00:00");
  EXPECT_EQ(shown_days(44886.5, NumberFormat::date_and_clock, true), "2026-11-22T12:00:00");  // 1462 days later
  EXPECT_EQ(shown_days(1.09375, NumberFormat::elapsed, false), "26:15:00.000");
}

std::string rows_of_states(const std::string& header, const std::vector<std::string>& states) {
  std::string text = "t_s," + header + ",Z_um\n";
  for (std::size_t i = 0; i < states.size(); ++i) text += fmt::format("{},{},{}\n", i, states[i], i % 7);
  return text;
}

// What a person ticks, and words that take turns.
TEST(log, two_words_or_one_and_nothing_are_a_switch) {
  std::vector<std::string> marks(30), pairs(30), programs(30);
  for (std::size_t i = 0; i < 30; ++i) {
    marks[i] = i >= 10 && i < 22 ? "x" : "";
    pairs[i] = i < 10 ? "AUTO" : "MANUAL";
    programs[i] = i % 3 == 0 ? "ROUGH" : i % 3 == 1 ? "FINISH" : "IDLE";
  }
  for (const auto& [states, remark] : {std::pair{marks, "Coolant: \"x\" is read as 1, an empty cell as 0."},
                                       {pairs, "Coolant: \"AUTO\" is read as 0, \"MANUAL\" as 1."}}) {
    const Log log = read_log(rows_of_states("Coolant", states), "f");
    ASSERT_EQ(log.series.columns.size(), 2U);
    EXPECT_EQ(log.series.columns[0].values[5], 0.0);
    EXPECT_EQ(log.series.columns[0].values[15], 1.0);
    EXPECT_EQ(log.remarks, std::vector<std::string>{remark});
    EXPECT_TRUE(log.series.unread.empty());
  }
  const Log log = read_log(rows_of_states("Program", programs), "f");
  EXPECT_EQ(log.series.columns.size(), 1U);
  EXPECT_EQ(log.series.unread, std::vector<std::string>{"Program"});
}

TEST(log, numbers_with_their_unit_or_an_s_in_each_cell) {
  const Log log = read_log(
      "Time,Spindle,Room,Z\n0 s,S4800,19.9 °C,1.5 µm\n1 s,S4800,20.1 °C,1.7 µm\n"
      "2 s,S8000,20.2 °C,2.5 µm\n3 s,S8000,20.4 °C,2.75 µm\n",
      "f", {.every_s = 60.0});
  ASSERT_EQ(log.series.columns.size(), 3U);
  EXPECT_EQ(log.series.columns[0].name, "Spindle_rpm");
  EXPECT_EQ(log.series.columns[0].values.back(), 8000.0);
  EXPECT_EQ(log.series.columns[1].name, "Room_degC");
  EXPECT_EQ(log.series.columns[2].name, "Z_um");
  EXPECT_EQ(log.series.columns[2].values.back(), 2.75);
}

// A power of ten before the unit scales the values.
TEST(log, units_with_a_scale) {
  for (const auto& [header, um] : {std::pair{"Z (0.0001 in)", 2.54},
                                   {"Z [1/1000 mm]", 1.0},
                                   {"Z 1/100 mm", 10.0},
                                   {"Z (0.01 mm)", 10.0},
                                   {"Z [10 um]", 10.0}}) {
    const Log log = read_log(std::string("t_s,") + header + "\n0,1\n1,2\n2,4\n", "f");
    EXPECT_EQ(log.series.columns.front().name, "Z_um") << header;
    EXPECT_NEAR(log.series.columns.front().values.back(), 4.0 * um, 1e-9) << header;
  }
  EXPECT_EQ(read_log("t_s,Probe 1 mm\n0,1\n1,2\n", "f").series.columns.front().name, "Probe_1_um");
  EXPECT_EQ(read_log("t_s,Temp [10 mm]\n0,1\n1,2\n", "f").series.columns.front().name, "Temp_10_mm_degC");
}

TEST(log, newest_row_first) {
  const Log log = read_log("Time,Z_um\n2026-03-20 06:03,4\n2026-03-20 06:02,3\n2026-03-20 06:01,1\n", "f");
  EXPECT_EQ(log.series.time_s, (std::vector<double>{0.0, 60.0, 120.0}));
  EXPECT_EQ(log.series.columns.front().values, (std::vector<double>{1.0, 3.0, 4.0}));
  EXPECT_EQ(log.series.started, "2026-03-20T06:01:00");
}

// 0 of a sensor that does not answer; a number that the user states.
TEST(log, numbers_that_stand_for_no_reading) {
  std::string text = "t_s,Room_degC,Z_um\n";
  for (int i = 0; i < 100; ++i)
    text += fmt::format("{},{},{}\n", i, i % 17 == 5 ? 0.0 : 20.0 + 0.05 * i, i % 10 == 3 ? 77.7 : 0.1 * i);
  const Log log = read_log(text, "f", {.missing = {"77.70"}});
  EXPECT_EQ(log.remarks.front(), "Room_degC: 6 times 0: read as a missing value.");
  const auto gaps = [](const std::vector<double>& values) {
    return std::count_if(values.begin(), values.end(), [](double value) { return std::isnan(value); });
  };
  EXPECT_EQ(gaps(log.series.columns[0].values), 6);
  EXPECT_EQ(gaps(log.series.columns[1].values), 10);
}

}  // namespace
}  // namespace ballbar
