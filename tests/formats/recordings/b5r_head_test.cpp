// What a `.b5r` says beside its readings: head, limits, curves, and a file of results alone.
#include <gtest/gtest.h>

#include <regex>

#include "bad_text.hpp"
#include "ballbar/error.hpp"
#include "ballbar/formats/recordings/recording_file.hpp"
#include "ballbar/formats/sessions/data_file.hpp"
#include "ballbar/formats/sessions/session_toml.hpp"
#include "ballbar/formats/text/keys.hpp"
#include "scratch_folder.hpp"

namespace ballbar {
namespace {

// 4 September 2025, 16:10:49: day 20335 of the epoch.
constexpr std::int64_t kStarted_s = std::int64_t{20335} * 86400 + 16 * 3600 + 10 * 60 + 49;

// Both runs without readings.
std::string results_alone() {
  std::string text = changed("both", "<READINGS>+0.05 +0.01 -0.02 +0.03 +0.05</READINGS>", "");
  const std::string_view second = "<READINGS>+0.04 +0.06</READINGS>";
  return text.replace(text.find(second), second.size(), "<READINGS></READINGS>");
}

void expect_same(const B5r& left, const B5r& right) {
  EXPECT_EQ(left.test_name, right.test_name);
  EXPECT_EQ(left.machine, right.machine);
  EXPECT_EQ(left.operator_name, right.operator_name);
  EXPECT_EQ(left.comment, right.comment);
  EXPECT_EQ(left.started_s, right.started_s);
  EXPECT_EQ(left.completed_s, right.completed_s);
  EXPECT_EQ(left.ballbar_model, right.ballbar_model);
  EXPECT_EQ(left.serial_number, right.serial_number);
  EXPECT_EQ(left.certificate, right.certificate);
  EXPECT_EQ(left.last_calibrated, right.last_calibrated);
  EXPECT_EQ(left.scale_factor, right.scale_factor);
  EXPECT_EQ(left.calibrator.model, right.calibrator.model);
  EXPECT_EQ(left.calibrator.serial_number, right.calibrator.serial_number);
  EXPECT_EQ(left.calibrator.certificate, right.calibrator.certificate);
  EXPECT_EQ(left.calibrator.last_calibrated, right.calibrator.last_calibrated);
  EXPECT_EQ(left.calibrator.calibrated_length_mm, right.calibrator.calibrated_length_mm);
  EXPECT_EQ(left.calibrator.expansion_ppm_per_K, right.calibrator.expansion_ppm_per_K);
  EXPECT_EQ(left.calibrator.temperature_degC, right.calibrator.temperature_degC);
  EXPECT_EQ(left.software_title, right.software_title);
  EXPECT_EQ(left.software_version, right.software_version);
  EXPECT_EQ(left.plane, right.plane);
  EXPECT_EQ(left.nominal_length_mm, right.nominal_length_mm);
  EXPECT_EQ(left.test_radius_mm, right.test_radius_mm);
  EXPECT_EQ(left.start_deg, right.start_deg);
  EXPECT_EQ(left.end_deg, right.end_deg);
  EXPECT_EQ(left.overshoot_deg, right.overshoot_deg);
  EXPECT_EQ(left.programmed_feed_mm_per_min, right.programmed_feed_mm_per_min);
  EXPECT_EQ(left.material_expansion_ppm_per_K, right.material_expansion_ppm_per_K);
  EXPECT_EQ(left.spindle_number, right.spindle_number);
  EXPECT_EQ(left.nc_program, right.nc_program);
  ASSERT_EQ(left.run_results.size(), right.run_results.size());
  for (std::size_t i = 0; i < left.run_results.size(); ++i) {
    EXPECT_EQ(left.run_results[i].parent, right.run_results[i].parent);
    EXPECT_EQ(left.run_results[i].direction, right.run_results[i].direction);
    EXPECT_EQ(left.run_results[i].recording, right.run_results[i].recording);
  }
  ASSERT_EQ(left.stored.size(), right.stored.size());
  for (std::size_t i = 0; i < left.stored.size(); ++i) {
    EXPECT_EQ(left.stored[i].parent, right.stored[i].parent);
    EXPECT_EQ(left.stored[i].name, right.stored[i].name);
    EXPECT_EQ(left.stored[i].value, right.stored[i].value);
    EXPECT_EQ(left.stored[i].status, right.stored[i].status);
  }
  ASSERT_EQ(left.limits.size(), right.limits.size());
  for (std::size_t i = 0; i < left.limits.size(); ++i) {
    EXPECT_EQ(left.limits[i].parent, right.limits[i].parent);
    EXPECT_EQ(left.limits[i].name, right.limits[i].name);
    EXPECT_EQ(left.limits[i].data_type, right.limits[i].data_type);
    EXPECT_EQ(left.limits[i].level, right.limits[i].level);
    EXPECT_EQ(left.limits[i].lower, right.limits[i].lower);
    EXPECT_EQ(left.limits[i].upper, right.limits[i].upper);
  }
  ASSERT_EQ(left.simulated_um.size(), right.simulated_um.size());
  for (std::size_t i = 0; i < left.simulated_um.size(); ++i) {
    EXPECT_EQ(left.simulated_um[i].direction, right.simulated_um[i].direction);
    EXPECT_EQ(left.simulated_um[i].deviation_um, right.simulated_um[i].deviation_um);
  }
  EXPECT_EQ(left.remarks, right.remarks);
}

TEST(b5r_head, holds_machine_instrument_and_test) {
  const B5r test = read_b5r(good_text("both"), "file");
  EXPECT_EQ(test.remarks, std::vector<std::string>{});
  EXPECT_EQ(test.machine, "mill 7");
  EXPECT_EQ(test.operator_name, "A. Meier");
  EXPECT_EQ(test.comment, "cold & dry; door open");
  EXPECT_EQ(test.started_s, kStarted_s);
  EXPECT_EQ(test.completed_s, kStarted_s + 60);
  EXPECT_EQ(test.runs[1].started_s, kStarted_s);
  EXPECT_EQ(test.ballbar_model, "QC20");
  EXPECT_EQ(test.serial_number, "B-12");
  EXPECT_EQ(test.certificate, "C-34");
  EXPECT_EQ(test.last_calibrated, "2024-04-16");
  EXPECT_EQ(test.scale_factor, 1.0);
  EXPECT_EQ(test.calibrator.model, "50MM_BALLBAR_CALIBRATOR");
  EXPECT_EQ(test.calibrator.serial_number, "K-56");
  EXPECT_EQ(test.calibrator.certificate, "");  // "-"
  EXPECT_EQ(test.calibrator.last_calibrated, "2024-04-26");
  EXPECT_EQ(test.calibrator.calibrated_length_mm, 50.0031);
  EXPECT_EQ(test.calibrator.expansion_ppm_per_K, 0.0);
  EXPECT_EQ(test.calibrator.temperature_degC, 20.0);
  EXPECT_EQ(test.software_title, "Ballbar 20");
  EXPECT_EQ(test.software_version, "20.00");
  EXPECT_EQ(test.plane, Plane::XY);
  EXPECT_EQ(test.nominal_length_mm, 50.0);
  EXPECT_EQ(test.test_radius_mm, 49.5);
  EXPECT_EQ(test.start_deg, 330.0);
  EXPECT_EQ(test.end_deg, 30.0);
  EXPECT_EQ(test.overshoot_deg, 45.0);
  EXPECT_EQ(test.programmed_feed_mm_per_min, 1500.0);
  EXPECT_EQ(test.material_expansion_ppm_per_K, 8.0);
  EXPECT_EQ(test.spindle_number, "1");
  EXPECT_EQ(test.nc_program, "8014");
}

// An element under another name is not read: the test that comes of it, or the complaint, is another.
TEST(b5r_head, every_documented_element_is_read) {
  const auto all_of = [](const std::string& text) {
    try {
      const B5r test = read_b5r(text, "file");
      std::string all = write_b5r(test);
      for (const std::string& remark : test.remarks) all += remark;
      return all;
    } catch (const Error& error) {
      return std::string(error.what());
    }
  };
  const std::string whole = all_of(good_text("both"));
  for (const KeyTable& table : b5r_keys()) {
    for (const Key& key : table.keys) {
      const std::string name(key.name);
      const std::string renamed =
          std::regex_replace(good_text("both"), std::regex("(</?)" + name + "(?=[ >])"), "$1X_" + name);
      EXPECT_NE(all_of(renamed), whole) << name;
    }
  }
}

TEST(b5r_head, that_is_not_stated_is_empty) {
  const B5r test = read_b5r(good_text("b5r"), "file");
  EXPECT_EQ(test.machine + test.operator_name + test.comment + test.serial_number + test.last_calibrated, "");
  EXPECT_EQ(test.calibrator.calibrated_length_mm, std::nullopt);
  EXPECT_EQ(test.test_radius_mm, std::nullopt);
  EXPECT_EQ(read_b5r(changed("both", "\"mill 7\"", "\" - \""), "file").machine, "");
}

TEST(b5r_limits, keep_level_parent_and_ends) {
  const B5r test = read_b5r(good_text("both"), "file");
  ASSERT_EQ(test.limits.size(), 3u);  // one without an end is none
  EXPECT_EQ(test.limits[0].parent, "RUN_SPEC");
  EXPECT_EQ(test.limits[0].name, "AF_OFFSET_A");
  EXPECT_EQ(test.limits[0].data_type, "UT_LENGTH_MM");
  EXPECT_EQ(test.limits[0].level, "WARNING");
  EXPECT_EQ(test.limits[0].lower, -0.1);
  EXPECT_EQ(test.limits[0].upper, 0.1);
  EXPECT_EQ(test.limits[1].level, "ERROR");
  EXPECT_EQ(test.limits[1].lower, std::nullopt);
  EXPECT_EQ(test.limits[1].upper, 0.2);
  EXPECT_EQ(test.limits[2].parent, "RENISHAW_DIAGNOSTICS");
  EXPECT_EQ(test.limits[2].lower, std::nullopt);  // "-"
  EXPECT_EQ(test.limits[2].upper, 10.0);
  // What the software said of its own values.
  EXPECT_EQ(test.stored[0].status, "AF_TOLERANCE_OK");
  EXPECT_EQ(judged(test.limits, test.stored[0].name, test.stored[0].value, test.stored[0].data_type), Judgement::pass);
  EXPECT_EQ(test.stored[1].status, "AF_TOLERANCE_WARNING");
  EXPECT_EQ(judged(test.limits, test.stored[1].name, test.stored[1].value, test.stored[1].data_type),
            Judgement::warning);
}

TEST(b5r_curves, are_deviations_in_um_by_direction) {
  const B5r test = read_b5r(good_text("both"), "file");
  const SimulatedCurve* const ccw = simulated_curve(test, Direction::CCW);
  const SimulatedCurve* const cw = simulated_curve(test, Direction::CW);
  ASSERT_TRUE(ccw != nullptr && cw != nullptr);
  EXPECT_EQ(ccw->deviation_um, (std::vector<double>{0.01001 * 1e3, -0.02002 * 1e3, 0.03003 * 1e3}));
  EXPECT_EQ(cw->deviation_um, (std::vector<double>{0.04004 * 1e3, 0.06006 * 1e3}));
  EXPECT_EQ(simulated_curve(read_b5r(good_text("b5r"), "file"), Direction::CW), nullptr);
}

TEST(b5r_head, written_and_read_again_is_the_same) {
  const B5r test = read_b5r(good_text("both"), "file");
  expect_same(read_b5r(write_b5r(test), "file"), test);
  const B5r without = read_b5r(results_alone(), "file");
  B5r again = read_b5r(write_b5r(without), "file");
  again.remarks = without.remarks;  // their lines differ
  expect_same(again, without);
  B5r undated = test;
  undated.last_calibrated = "spring";
  EXPECT_EQ(read_b5r(write_b5r(undated), "file").last_calibrated, "spring");
}

TEST(b5r_head, in_utf16_is_the_same) {
  const std::string utf8 = changed("both", "mill 7", "Fräse \xF0\x9F\x94\xA7");
  for (const bool big : {false, true}) {
    std::string utf16 = big ? "\xFE\xFF" : "\xFF\xFE";
    const auto put = [&](unsigned unit) {
      const char high = static_cast<char>(unit >> 8), low = static_cast<char>(unit & 0xFFu);
      utf16 += big ? std::string{high, low} : std::string{low, high};
    };
    for (std::size_t i = 0; i < utf8.size(); ++i) {
      if (utf8.compare(i, 2, "ä") == 0) {
        put(0xE4);
        i += 1;
      } else if (utf8[i] == '\xF0') {  // U+1F527 is the pair D83D DD27
        put(0xD83D);
        put(0xDD27);
        i += 3;
      } else {
        put(static_cast<unsigned char>(utf8[i]));
      }
    }
    expect_same(read_b5r(utf16, "file"), read_b5r(utf8, "file"));
    const ScratchFolder folder;
    EXPECT_EQ(open_recording(folder.write("utf16.b5r", utf16)).b5r->machine, "Fräse \xF0\x9F\x94\xA7");
    // Its beginning alone: the fault is found at the same place as in UTF-8.
    EXPECT_EQ(complaint(folder, [&] { read_b5r(utf16.substr(0, 900), "file"); }).substr(0, 60),
              complaint(folder, [&] { read_b5r(utf8.substr(0, 449), "file"); }).substr(0, 60));
  }
}

TEST(b5r_results_alone, are_read) {
  const B5r test = read_b5r(results_alone(), "file");
  EXPECT_TRUE(test.runs.empty());
  EXPECT_TRUE(test.simulated_um.empty());
  EXPECT_EQ(stored_value(test, "run 1", "AF_CENTRE_OFFSET_A", "UT_LENGTH_MM"), 0.15);
  EXPECT_EQ(test.run_results[1].direction, Direction::CW);
  EXPECT_EQ(test.run_results[1].recording, std::nullopt);
  EXPECT_EQ(test.started_s, kStarted_s);
  EXPECT_EQ(test.limits.size(), 3u);
}

TEST(b5r_results_alone, of_one_run_leave_the_other_its_place) {
  const B5r test = read_b5r(
      changed("both", "<READINGS>+0.05 +0.01 -0.02 +0.03 +0.05</READINGS>", "<READINGS>\n</READINGS>"), "file");
  ASSERT_EQ(test.runs.size(), 1u);
  EXPECT_EQ(test.runs[0].direction, Direction::CW);
  EXPECT_EQ(test.run_results[0].recording, std::nullopt);
  EXPECT_EQ(test.run_results[1].recording, 0u);
  EXPECT_EQ(parent_of(test, 0), "run 1");
  EXPECT_EQ(stored_value(test, parent_of(test, 0), "AF_CENTRE_OFFSET_A", "UT_LENGTH_MM"), 0.15);
}

TEST(b5r_results_alone, are_refused_where_readings_are_needed) {
  const ScratchFolder folder;
  const auto alone = folder.write("tests/alone.b5r", results_alone());
  const RecordingFile file = open_recording(alone);
  EXPECT_TRUE(file.recordings.empty());
  EXPECT_EQ(file.remarks.size(), 1u);
  const std::string expected =
      "DIR/tests/alone.b5r: expected readings, found only stored results. Show them with ballbar fit.";
  EXPECT_EQ(complaint(folder, [&] { expect_readings(file, alone); }), expected);
  EXPECT_EQ(complaint(folder, [&] { open_session(folder.path() / "tests"); }),
            "DIR/tests/alone.b5r: expected readings, or the stored centre and radius of a run (AF_CENTRE_OFFSET_A, "
            "AF_CENTRE_OFFSET_B, AF_BEST_RADIUS), found neither.");
  EXPECT_EQ(complaint(folder, [&] { open_model_data({alone}, {}, 0.0); }), expected);
  EXPECT_EQ(complaint(folder, [&] { expect_readings(RecordingFile(), "log"); }), "log: expected readings, found none.");
}

}  // namespace
}  // namespace ballbar
