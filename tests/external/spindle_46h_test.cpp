// The shipped run of measured drift against the recording it was taken from: the same rows, and the same drift where
// the columns are mapped by hand.
#include <array>
#include <cmath>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include "ballbar/drift/five_probes.hpp"
#include "ballbar/formats/sessions/drift_data.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "external_data.hpp"

namespace ballbar {
namespace {

namespace fs = std::filesystem;

// From the line of column names on.
std::string_view table_of(std::string_view bytes) {
  const std::size_t at = bytes.find("\ntime_s,");
  return at == std::string_view::npos ? std::string_view() : bytes.substr(at + 1);
}

// Equal bits, gaps included.
bool same(const std::vector<double>& left, const std::vector<double>& right) {
  return left.size() == right.size() && std::memcmp(left.data(), right.data(), left.size() * sizeof(double)) == 0;
}

TEST(Spindle46h, RowsAreThoseOfTheSource) {
  REQUIRE_EXTERNAL_DATA(data);
  const std::string source = read_bytes(data / "spindle-46h" / "measured.csv", kLargestTable);
  const std::string shipped = read_bytes(fs::path(BALLBAR_SAMPLE_RUNS) / "spindle-46h" / "measured.csv", kLargestTable);
  EXPECT_GT(table_of(source).size(), 1'000'000u);
  EXPECT_TRUE(table_of(shipped) == table_of(source)) << "compared byte for byte";
  EXPECT_EQ(read_bytes(fs::path(BALLBAR_SAMPLE_RUNS) / "spindle-46h" / "LICENSE", kLargestText),
            read_bytes(data / "spindle-46h" / "LICENSE", kLargestText));
}

TEST(Spindle46h, HeaderMapsTheColumnsAsDoneByHand) {
  REQUIRE_EXTERNAL_DATA(data);
  Series source = open_series(data / "spindle-46h" / "measured.csv");
  EXPECT_FALSE(source.five_probe);
  source.five_probe = FiveProbe{};
  source.five_probe->columns = {"ch1_um", "ch2_um", "ch3_um", "ch4_um", "ch5_um"};
  const Series shipped = open_series(fs::path(BALLBAR_SAMPLE_RUNS) / "spindle-46h" / "measured.csv");
  EXPECT_EQ(find_column(shipped, "T16_degC")->role, Role::ambient);
  EXPECT_EQ(find_column(shipped, "T4_degC")->role, Role::coolant);

  const MeasuredDrift by_hand = five_point(source).drift;
  const MeasuredDrift by_header = five_point(shipped).drift;
  ASSERT_EQ(by_hand.axes.size(), 5U) << "x, y, z and the two differences of a pair";
  ASSERT_EQ(by_header.axes.size(), by_hand.axes.size());
  EXPECT_TRUE(same(by_header.time_s, by_hand.time_s));
  for (std::size_t i = 0; i < by_hand.axes.size(); ++i) {
    const DriftAxis& expected = by_hand.axes[i];
    const DriftAxis& found = by_header.axes[i];
    EXPECT_EQ(found.name, expected.name);
    EXPECT_TRUE(same(found.value, expected.value)) << expected.name;
    ASSERT_EQ(found.budget.size(), expected.budget.size()) << expected.name;
    for (std::size_t k = 0; k < expected.budget.size(); ++k) {
      EXPECT_TRUE(same(found.budget[k].sigma, expected.budget[k].sigma)) << expected.name;
    }
  }
}

// Without a spacing the drift is the reading of plane 1 less its first one: nothing else is done to the numbers.
TEST(Spindle46h, DriftIsTheReadingLessTheFirst) {
  REQUIRE_EXTERNAL_DATA(data);
  const Series source = open_series(data / "spindle-46h" / "measured.csv");
  const MeasuredDrift drift =
      five_point(open_series(fs::path(BALLBAR_SAMPLE_RUNS) / "spindle-46h" / "measured.csv")).drift;
  constexpr std::array<std::pair<const char*, const char*>, 3> kAxes{
      {{"x", "ch1_um"}, {"y", "ch3_um"}, {"z", "ch5_um"}}};
  for (const auto& [axis, column] : kAxes) {
    const std::vector<double>& reading_um = find_column(source, column)->values;
    const std::vector<double>& drift_um = find_axis(drift, axis)->value;
    ASSERT_EQ(drift_um.size(), 6669U);
    for (std::size_t row = 0; row < drift_um.size(); ++row) {
      ASSERT_NEAR(drift_um[row], reading_um[row] - reading_um[0], 1e-12) << axis << " row " << row;
    }
  }
}

}  // namespace
}  // namespace ballbar
