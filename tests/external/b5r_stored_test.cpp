// Results that instrument software stored in `.b5r` files, against ours: --polar and ISO 230-4.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "ballbar/circle/circle.hpp"
#include "ballbar/formats/recordings/recording_file.hpp"
#include "ballbar/units.hpp"
#include "external_data.hpp"

namespace ballbar {
namespace {

struct Count {
  int compared = 0;
  int agree = 0;
};

// Printed with 0.1 um: the stored value is ours rounded to that digit (half a digit, plus what a number in
// binary loses).
void compare(Count& count, const std::string& what, double ours_um, const std::optional<double>& stored_um) {
  if (!stored_um) return;
  ++count.compared;
  const bool agree = std::abs(ours_um - *stored_um) <= 0.05 + 1e-6;
  count.agree += agree ? 1 : 0;
  fmt::print("  {:<34} ours {:10.3f}  stored {:10.1f}  {}\n", what, ours_um, *stored_um, agree ? "" : "DIFFERS");
  EXPECT_TRUE(agree) << what << " ours " << ours_um << " stored " << *stored_um;
}

std::optional<double> um(const std::optional<double>& value_mm) {
  return value_mm ? std::optional(um_from_mm(*value_mm)) : std::nullopt;
}

std::vector<std::filesystem::path> b5r_files(const std::filesystem::path& data) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(data / "ballbar-b5r")) {
    if (entry.path().extension() == ".b5r") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

TEST(StoredResults, RunValuesOfThePolarCircle) {
  REQUIRE_EXTERNAL_DATA(data);
  Count count;
  for (const auto& path : b5r_files(data)) {
    const RecordingFile file = open_recording(path);
    for (std::size_t i = 0; i < file.recordings.size(); ++i) {
      const Recording& recording = file.recordings[i];
      CircleOptions polar;
      polar.model = CircleModel::polar;
      const Circle circle = fit_circle(recording, polar);
      const std::string run = fmt::format("run {}", i);
      const auto stored = [&](const char* name) { return um(stored_value(*file.b5r, run, name, "UT_LENGTH_MM")); };
      fmt::print("{} {}\n", path.filename().string(), name_of(recording.direction));
      compare(count, "centre A um", circle.centre_a_um, stored("AF_CENTRE_OFFSET_A"));
      compare(count, "centre B um", circle.centre_b_um, stored("AF_CENTRE_OFFSET_B"));
      compare(count, "radius um", um_from_mm(circle.radius_mm), stored("AF_BEST_RADIUS"));
      compare(count, "circularity um", circularity(recording, circle).circular_deviation_um, stored("AF_CIRCULARITY"));
    }
  }
  fmt::print("stored run values reproduced to the printed 0.1 um: {} of {}\n", count.agree, count.compared);
  EXPECT_GE(count.compared, 16);
}

TEST(StoredResults, Iso230_4) {
  REQUIRE_EXTERNAL_DATA(data);
  Count count;
  for (const auto& path : b5r_files(data)) {
    const RecordingFile file = open_recording(path);
    ASSERT_EQ(file.recordings.size(), 2U) << path;
    const bool first_is_ccw = file.recordings[0].direction == Direction::CCW;
    const Recording& ccw = file.recordings[first_is_ccw ? 0 : 1];
    const Recording& cw = file.recordings[first_is_ccw ? 1 : 0];
    CircleOptions polar;
    polar.model = CircleModel::polar;
    const Circle ccw_circle = fit_circle(ccw, polar);
    const Circle cw_circle = fit_circle(cw, polar);
    const Circularity g_ccw = circularity(ccw, ccw_circle);
    const Circularity g_cw = circularity(cw, cw_circle);
    const Bidirectional both = bidirectional(ccw, ccw_circle, cw, cw_circle);
    const auto stored = [&](const char* edition, const char* name, const char* unit = "UT_LENGTH_UM") {
      return stored_value(*file.b5r, edition, name, unit);
    };
    fmt::print("{} (software {})\n", path.filename().string(), file.b5r->software_version);
    for (const char* edition : {"ISO230_4 1996", "ISO230_4 2005"}) {
      compare(count, "G CCW um", g_ccw.circular_deviation_um, stored(edition, "AF_CIRCULAR_DEVIATION_CCW"));
      compare(count, "G CW um", g_cw.circular_deviation_um, stored(edition, "AF_CIRCULAR_DEVIATION_CW"));
      compare(count, "G max CCW um", g_ccw.max_circular_um, stored(edition, "AF_MAX_CIRCULAR_DEVIATION_CCW"));
      compare(count, "G min CCW um", g_ccw.min_circular_um, stored(edition, "AF_MIN_CIRCULAR_DEVIATION_CCW"));
      compare(count, "G max CW um", g_cw.max_circular_um, stored(edition, "AF_MAX_CIRCULAR_DEVIATION_CW"));
      compare(count, "G min CW um", g_cw.min_circular_um, stored(edition, "AF_MIN_CIRCULAR_DEVIATION_CW"));
      compare(count, "F max CCW um", g_ccw.max_radial_um, stored(edition, "AF_MAX_RADIAL_DEVIATION_CCW"));
      compare(count, "F min CCW um", g_ccw.min_radial_um, stored(edition, "AF_MIN_RADIAL_DEVIATION_CCW"));
      compare(count, "F max CW um", g_cw.max_radial_um, stored(edition, "AF_MAX_RADIAL_DEVIATION_CW"));
      compare(count, "F min CW um", g_cw.min_radial_um, stored(edition, "AF_MIN_RADIAL_DEVIATION_CW"));
    }
    compare(count, "bidirectional 1996 um", both.bidirectional_1996_um,
            stored("ISO230_4 1996", "AF_CIRCULAR_DEVIATION_BIDIRECTIONAL"));
    compare(count, "bidirectional 2005 um", both.bidirectional_2005_um,
            stored("ISO230_4 2005", "AF_BIDIRECTIONAL_CIRCULAR_DEVIATION"));
    compare(count, "D um", both.mean_radial_um, stored("ISO230_4 2005", "AF_MEAN_BIDIRECTIONAL_RADIAL_DEVIATION"));
    compare(count, "H at deg", both.hysteresis_at_deg,
            stored("ISO230_4 1996", "AF_CIRCULAR_HYSTERESIS_LOCATION", "UT_ANGLE"));
    // Version 5.09 stores 0.0 where about 3 um is right, at the right angle: a known defect, shown and left out.
    if (file.b5r->software_version.starts_with("5.09")) {
      fmt::print("  H um ours {:.3f}, stored {:.1f}: known defect of version 5.09\n", both.hysteresis_um,
                 stored("ISO230_4 1996", "AF_CIRCULAR_HYSTERESIS").value_or(NAN));
      continue;
    }
    compare(count, "H um", both.hysteresis_um, stored("ISO230_4 1996", "AF_CIRCULAR_HYSTERESIS"));
  }
  fmt::print("stored ISO 230-4 values reproduced to the printed digit: {} of {}\n", count.agree, count.compared);
  EXPECT_GE(count.compared, 30);
}

TEST(StoredResults, LimitsJudgeAsTheStatusesDo) {
  REQUIRE_EXTERNAL_DATA(data);
  int judgements = 0;
  for (const auto& path : b5r_files(data)) {
    const RecordingFile file = open_recording(path);
    EXPECT_EQ(file.remarks, std::vector<std::string>{}) << path;
    EXPECT_GE(file.b5r->limits.size(), 3U) << path;
    EXPECT_FALSE(file.b5r->last_calibrated.empty()) << path;
    for (const StoredFeature& feature : file.b5r->stored) {
      const auto found = judged(file.b5r->limits, feature.name, feature.value, feature.data_type, "RUN_SPEC");
      if (!feature.parent.starts_with("run ")) continue;
      EXPECT_EQ(found.has_value(), !feature.status.empty()) << path << feature.name;
      if (!found) continue;
      ++judgements;
      EXPECT_EQ(*found == Judgement::pass, feature.status == "AF_TOLERANCE_OK") << path << feature.name;
    }
  }
  EXPECT_GE(judgements, 12);
}

// A curve is the software's own fit to the readings.
TEST(StoredResults, SimulatedCurvesFollowTheReadings) {
  REQUIRE_EXTERNAL_DATA(data);
  for (const auto& path : b5r_files(data)) {
    const RecordingFile file = open_recording(path);
    for (const Recording& recording : file.recordings) {
      const SimulatedCurve* const curve = simulated_curve(*file.b5r, recording.direction);
      ASSERT_NE(curve, nullptr) << path;
      const std::size_t n = recording.length_mm.size();
      ASSERT_EQ(curve->deviation_um.size(), n) << path;
      double squares = 0.0;
      for (std::size_t i = 0; i < n; ++i) {
        const double deviation_um = um_from_mm(recording.length_mm[i] - recording.nominal_length_mm);
        squares += std::pow(deviation_um - curve->deviation_um[i], 2);
      }
      const double rms_um = std::sqrt(squares / static_cast<double>(n));
      fmt::print("{} {}: readings less curve {:.3f} um rms\n", path.filename().string(), name_of(recording.direction),
                 rms_um);
      EXPECT_LT(rms_um, 2.0) << path;
    }
  }
}

}  // namespace
}  // namespace ballbar
