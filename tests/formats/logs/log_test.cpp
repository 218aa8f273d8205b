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
            "log.csv:1: expected the unit of the time \"time\", found none; state --time-unit s, ms, min or h.");
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
  EXPECT_EQ(
      said("Tag;Zeit;Wert\nn;10:00:00;0,5\nT;10:00:00;20,5\nn;10:00:01;1,5\nT;10:00:01;20,5\nn;10:00:02;0,5\nT;10:00:"
           "02;20,5\n"),
      "log.csv:2: expected one column per quantity, found rows of 2 quantities below each other, named in \"Tag\". "
      "Export them side by side.");
}

double warm(std::size_t row, double start) { return start + 8.0 * (1.0 - std::exp(-static_cast<double>(row) / 30.0)); }

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
  EXPECT_EQ(columns_of(read_log(minutes("Room,Motor,z (um)", 20, warm), "log.csv")).substr(0, 11), "Room event;");
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

}  // namespace
}  // namespace ballbar
