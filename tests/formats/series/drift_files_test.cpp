#include "ballbar/formats/series/drift_files.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "ballbar/formats/series/series_csv.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "scratch_folder.hpp"

namespace ballbar {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

DriftSeries two_arcs() {
  DriftSeries drift;
  drift.method = Method::two_arcs;
  drift.reference_s = 0.5;
  drift.points.resize(2);
  drift.points[0].time_s = 0.5;
  drift.points[0].x = {0.0, 0.0};
  drift.points[0].z = {0.0, 0.0};
  drift.points[1].time_s = 600.0;
  drift.points[1].x = {4.4, 0.1};
  drift.points[1].y = {30.1, 0.2};
  drift.points[1].z = {4.6, kInfinity};
  drift.points[1].correlation_y_z = -0.25;
  drift.points[1].elongation_correction_um = 0.002;
  return drift;
}

TEST(drift_files, json_has_what_the_method_has) {
  DriftSeries drift = two_arcs();
  Position& position = drift.positions.emplace_back();
  position.time_s = 600.0;
  position.z = Estimate{8.5, 0.25};
  position.radius_mm = 100.5;
  position.converged = true;
  drift.not_cancelled = as_it_is("The table.");
  EXPECT_EQ(
      json_of(drift).dump(),
      R"({"method":"two_arcs","reference_s":0.5,"points":[)"
      R"({"time_s":0.5,"x_um":0.0,"x_sigma_um":0.0,"z_um":0.0,"z_sigma_um":0.0,"combined_um":0.0,"combined_sigma_um":0.0},)"
      R"({"time_s":600.0,"x_um":4.4,"x_sigma_um":0.1,"y_um":30.1,"y_sigma_um":0.2,"z_um":4.6,"z_sigma_um":null,)"
      R"("elongation_correction_um":0.002,"combined_um":30.765727685201924,"combined_sigma_um":null,"correlation_y_z":-0.25}],)"
      R"("positions":[{"time_s":600.0,"z_um":8.5,"z_sigma_um":0.25,"radius_mm":100.5,"converged":true,)"
      R"("discounted":0}],"not_cancelled":"The table."})");
}

TEST(drift_files, csv_is_a_series) {
  const ScratchFolder folder;
  const auto file = folder.path() / "drift.csv";
  write_drift(two_arcs(), file);
  const std::string csv = read_bytes(file, 10000);
  EXPECT_EQ(csv,
            "# format = \"ballbar-series 1\"\n"
            "# method = \"two_arcs\"\n"
            "# reference_s = 0.5\n"
            "time_s,x_um,x_sigma_um,y_um,y_sigma_um,z_um,z_sigma_um,elongation_correction_um\n"
            "0.5,0,0,,,0,0,\n"
            "600,4.4,0.1,30.1,0.2,4.6,,0.002\n");
  const Series series = read_series(csv, "drift.csv");
  EXPECT_EQ(series.columns.size(), 7u);
  EXPECT_EQ(find_column(series, "y_um")->values[1], 30.1);
  EXPECT_TRUE(std::isnan(find_column(series, "y_um")->values[0]));
}

TEST(drift_files, json_file_is_the_same_json) {
  const ScratchFolder folder;
  write_drift(two_arcs(), folder.path() / "drift.json");
  EXPECT_EQ(nlohmann::ordered_json::parse(read_bytes(folder.path() / "drift.json", 10000)), json_of(two_arcs()));
}

// Two axes, one of them with nothing known of its sigma, and a gap.
MeasuredDrift five_probes() {
  constexpr double kGap = std::numeric_limits<double>::quiet_NaN();
  MeasuredDrift drift;
  drift.what = "five probes, at plane 1";
  drift.method = "five_probe";
  drift.reference_s = 0.0;
  drift.time_s = {0.0, 1800.0, 3600.0, 5400.0};
  drift.axes = {{"x",
                 "um",
                 {0.0, 3.0, kGap, 1.5},
                 {{"probe resolution", {0.0, 0.3, 0.3, 0.3}}, {"probe scatter", {0.0, 0.4, 0.4, 0.4}}}},
                {"tilt_b", "urad", {0.0, -12.0, 5.0, 6.0}, {}}};
  drift.remarks = {as_it_is("y is not known: there is neither \"Y1\" nor Y2.")};
  return drift;
}

const std::vector<SpeedStep> kSteps{{0.0, 0, 2}, {8000.0, 2, 4}};

DriftSheet sheet() {
  DriftSheet of_probes = sheet_of(five_probes(), {}, kSteps);
  of_probes.test.motion_unit = "rpm";
  return of_probes;
}

TEST(drift_files, csv_of_five_probes_is_a_series) {
  const ScratchFolder folder;
  const auto file = folder.path() / "drift.csv";
  write_drift(five_probes(), kSteps, sheet(), file);
  const std::string csv = read_bytes(file, 10000);
  EXPECT_EQ(csv,
            "# format = \"ballbar-series 1\"\n"
            "# method = \"five_probe\"\n"
            "# reference_s = 0.0\n"
            "time_s,x_um,x_sigma_um,tilt_b_urad\n"
            "0,0,0,0\n"
            "1800,3,0.5,-12\n"  // sqrt(0.3^2 + 0.4^2)
            "3600,,0.5,5\n"
            "5400,1.5,0.5,6\n");
  const Series series = read_series(csv, "drift.csv");
  const MeasuredDrift again = measured(series, "drift.csv");
  ASSERT_EQ(again.axes.size(), 2u);
  EXPECT_EQ(again.axes[1].name, "tilt_b");
  EXPECT_EQ(again.axes[1].unit, "urad");
  EXPECT_EQ(again.axes[1].value, five_probes().axes[1].value);
  EXPECT_EQ(sigma_of(again.axes[0], 1), 0.5);
}

// Ranges: max - min over the first 60 min (rows 0 to 2), over the rest (row 3 alone), in total; last less first.
TEST(drift_files, json_of_five_probes) {
  const ScratchFolder folder;
  write_drift(five_probes(), kSteps, sheet(), folder.path() / "drift.json");
  const std::string text = read_bytes(folder.path() / "drift.json", 10000);
  EXPECT_EQ(text, json_text(five_probes(), kSteps, sheet()));
  const auto json = nlohmann::ordered_json::parse(text);
  EXPECT_EQ(json["method"], "five_probe");
  EXPECT_EQ(json["reference_s"], 0.0);
  ASSERT_EQ(json["points"].size(), 4u);
  EXPECT_EQ(json["points"][1].dump(), R"({"time_s":1800,"x_um":3,"x_sigma_um":0.5,"tilt_b_urad":-12})");
  EXPECT_EQ(json["points"][2].dump(), R"({"time_s":3600,"x_um":null,"x_sigma_um":0.5,"tilt_b_urad":5})");
  EXPECT_EQ(json["ranges"]["x"]["total_um"], 3.0);
  EXPECT_EQ(json["ranges"]["x"]["first_to_last_um"], 1.5);
  EXPECT_EQ(json["ranges"]["tilt_b"]["total_urad"], 18.0);
  EXPECT_TRUE(json["ranges"]["tilt_b"]["total_sigma_urad"].is_null());
  ASSERT_EQ(json["steps"].size(), 2u);
  EXPECT_EQ(json["steps"][0]["from_s"], 0.0);
  EXPECT_EQ(json["steps"][0]["to_s"], 1800.0);
  EXPECT_EQ(json["steps"][1]["speed_rpm"], 8000.0);
  EXPECT_EQ(json["steps"][1]["ranges"]["tilt_b"]["total_urad"], 1.0);
  EXPECT_EQ(json["remarks"][0], text_of(five_probes().remarks[0]));
}

TEST(drift_files, other_endings_are_refused) {
  const ScratchFolder folder;
  const auto writing = [&](std::string_view name) {
    return complaint(folder, [&] { write_drift(two_arcs(), folder.path() / name); });
  };
  EXPECT_EQ(writing("drift.xls"), "DIR/drift.xls: expected a name that ends in .csv, .json or .mat, found .xls.");
  EXPECT_EQ(complaint(folder, [&] { write_drift(five_probes(), {}, {}, folder.path() / "drift.txt"); }),
            "DIR/drift.txt: expected a name that ends in .csv, .json or .mat, found .txt.");
  EXPECT_EQ(writing("drift"), "DIR/drift: expected a name that ends in .csv, .json or .mat, found no ending.");
  EXPECT_EQ(writing("none/drift.csv"),
            "DIR/none/drift.csv: expected a folder to write to, found: No such file or directory.");
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace ballbar
