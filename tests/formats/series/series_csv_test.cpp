#include "ballbar/formats/series/series_csv.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "bad_text.hpp"
#include "ballbar/error.hpp"

namespace ballbar {
namespace {

TEST(series, columns_roles_and_gaps) {
  const Series series = read_series(good_text("series"), "file");
  EXPECT_EQ(series.time_s, (std::vector<double>{0.0, 10.0, 20.0}));
  ASSERT_EQ(series.columns.size(), 2u);
  EXPECT_EQ(series.columns[0].name, "speed_rpm");
  EXPECT_EQ(series.columns[0].role, Role::speed);
  EXPECT_EQ(series.columns[0].values, (std::vector<double>{3000.0, 3000.0, 3000.0}));
  EXPECT_EQ(series.columns[1].role, Role::ambient);
  EXPECT_EQ(series.columns[1].values[0], 20.5);
  EXPECT_TRUE(std::isnan(series.columns[1].values[1]));
  EXPECT_EQ(series.columns[1].values[2], 20.7);
  EXPECT_EQ(series.five_probe->spacing_mm, 60.0);
}

TEST(series, five_probes_of_other_names) {
  const Series series = read_series(good_text("probes"), "file");
  ASSERT_TRUE(series.five_probe);
  EXPECT_EQ(series.five_probe->spacing_mm, 60.0);
  EXPECT_EQ(series.five_probe->plane_1_from_nose_mm, -12.5);
  EXPECT_EQ(series.five_probe->resolution_um, 0.05);
  EXPECT_EQ(series.five_probe->linearity_percent, 0.5);
  EXPECT_EQ(series.five_probe->columns, (std::array<std::string, 5>{"ch1_um", "ch2_um", "Y1_um", "Y2_um", "ch3_um"}));
  EXPECT_EQ(series.columns[0].role, Role::measured);
}

TEST(series, probes_are_stated_only_where_the_header_says_so) {
  EXPECT_FALSE(read_series("time_s,X1_um\n0,0\n", "file").five_probe);
  const Series series = read_series("# format = \"ballbar-series 1\"\n# [five_probe]\ntime_s,X1_um\n0,0\n", "file");
  ASSERT_TRUE(series.five_probe);
  EXPECT_FALSE(series.five_probe->spacing_mm);
  EXPECT_EQ(series.five_probe->columns, FiveProbe{}.columns);
}

TEST(series, plain_table_with_prose_in_its_comments) {
  const Series series =
      read_series("# measured by hand, unit = minutes\n#format of the shop\ntime_min,x_um\n0,0\n1.5,-3\n", "file");
  EXPECT_EQ(series.time_s, (std::vector<double>{0.0, 90.0}));
  EXPECT_EQ(series.columns[0].values, (std::vector<double>{0.0, -3.0}));
  EXPECT_EQ(series.columns[0].role, Role::measured);
}

TEST(series, a_row_may_be_all_gaps) {
  const Series series = read_series("time_s,x_um,y_um\n0,,\n1, ,\t\r\n2,1,", "file");
  EXPECT_EQ(series.time_s.size(), 3u);
  EXPECT_TRUE(std::isnan(series.columns[1].values[2]));
  EXPECT_EQ(series.columns[0].values[2], 1.0);
}

// Several MiB, which are read in parts: rows stand in their order, and the first fault is said.
TEST(series, a_long_table_is_read_in_parts) {
  constexpr std::size_t kRows = 200'000;
  std::string text = "time_s,a_um,b_um\n";
  std::vector<std::size_t> begins;
  for (std::size_t i = 0; i < kRows; ++i) {
    begins.push_back(text.size());
    text += fmt::format("{},{},{}\r\n", i, 0.25 * static_cast<double>(i), i % 3 == 0 ? "" : "7.5");
  }
  const Series series = read_series(text, "long.csv");
  ASSERT_EQ(series.time_s.size(), kRows);
  for (std::size_t i = 0; i < kRows; ++i) {
    ASSERT_EQ(series.time_s[i], static_cast<double>(i));
    ASSERT_EQ(series.columns[0].values[i], 0.25 * static_cast<double>(i));
    ASSERT_EQ(std::isnan(series.columns[1].values[i]), i % 3 == 0);
  }
  text[begins[150'000]] = 'x';
  text[begins[60'000]] = '\n';
  try {
    read_series(text, "long.csv");
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "long.csv:60002:1: expected a row of 3 values, found an empty line.");
  }
}

TEST(series, an_event_needs_no_unit) {
  const Series series = read_series(
      "# format = \"ballbar-series 1\"\n# [columns.\"coolant on\"]\n# role = \"event\"\ntime_s,coolant on\n0,1\n",
      "file");
  EXPECT_EQ(series.columns[0].name, "coolant on");
  EXPECT_EQ(series.columns[0].role, Role::event);
}

bool same_bits(const std::vector<double>& left, const std::vector<double>& right) {
  if (left.size() != right.size()) return false;
  for (std::size_t i = 0; i < left.size(); ++i) {
    if (std::isnan(left[i]) != std::isnan(right[i])) return false;
    if (!std::isnan(left[i]) && std::memcmp(&left[i], &right[i], sizeof(double)) != 0) return false;
  }
  return true;
}

// Any finite bit pattern; NaN stands for a gap.
double any_double() {
  const auto bits = *rc::gen::arbitrary<std::uint64_t>() * 0x9E3779B97F4A7C15u;
  double value = 0.0;
  std::memcpy(&value, &bits, sizeof value);
  return std::isfinite(value) ? value : std::numeric_limits<double>::quiet_NaN();
}

TEST(series, written_and_read_again_is_the_same) {
  const bool passed = rc::check([] {
    const auto rows = *rc::gen::inRange<std::size_t>(1, 50);
    Series series;
    for (std::size_t i = 0; i < rows; ++i) {
      series.time_s.push_back(static_cast<double>(i) + *rc::gen::inRange(0, 1000) * 1e-3 - 5.0);
    }
    int index = 0;
    for (const std::string_view end : {"x_um", "T_degC", "n_rpm", "P_W", "\xC3\xA9_K", "a b_mm"}) {
      Column column{std::to_string(index++) + std::string(end),
                    *rc::gen::element(Role::coolant, Role::measured, Role::event),
                    {}};
      for (std::size_t i = 0; i < rows; ++i) column.values.push_back(any_double());
      series.columns.push_back(column);
    }
    if (*rc::gen::arbitrary<bool>()) {
      FiveProbe probe;
      probe.spacing_mm = *rc::gen::inRange(1, 500) / 7.0;
      if (*rc::gen::arbitrary<bool>()) probe.plane_1_from_nose_mm = *rc::gen::inRange(-500, 500) / 7.0;
      if (*rc::gen::arbitrary<bool>()) probe.resolution_um = *rc::gen::inRange(1, 500) / 7.0;
      if (*rc::gen::arbitrary<bool>()) probe.linearity_percent = *rc::gen::inRange(1, 500) / 7.0;
      for (std::size_t i = 0; i < kProbes.size(); ++i) {
        if (*rc::gen::arbitrary<bool>()) probe.columns[i] = series.columns[i].name;
      }
      series.five_probe = probe;
    }
    const Series again = read_series(write_series(series), "file");
    RC_ASSERT(same_bits(again.time_s, series.time_s));
    RC_ASSERT(again.five_probe.has_value() == series.five_probe.has_value());
    if (series.five_probe) {
      RC_ASSERT(again.five_probe->spacing_mm == series.five_probe->spacing_mm);
      RC_ASSERT(again.five_probe->plane_1_from_nose_mm == series.five_probe->plane_1_from_nose_mm);
      RC_ASSERT(again.five_probe->resolution_um == series.five_probe->resolution_um);
      RC_ASSERT(again.five_probe->linearity_percent == series.five_probe->linearity_percent);
      RC_ASSERT(again.five_probe->columns == series.five_probe->columns);
    }
    RC_ASSERT(again.columns.size() == series.columns.size());
    for (std::size_t i = 0; i < series.columns.size(); ++i) {
      RC_ASSERT(again.columns[i].name == series.columns[i].name);
      RC_ASSERT(again.columns[i].role == series.columns[i].role);
      RC_ASSERT(same_bits(again.columns[i].values, series.columns[i].values));
    }
  });
  EXPECT_TRUE(passed);
}

}  // namespace
}  // namespace ballbar
