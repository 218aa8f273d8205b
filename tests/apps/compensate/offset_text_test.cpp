// Offsets as text, and the whole way from a line of sensors to a line of offsets.
#include "compensate/offset_text.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>

#include "allocations.hpp"
#include "ballbar/formats/series/live_rows.hpp"

namespace ballbar {
namespace {

constexpr double kGap = std::numeric_limits<double>::quiet_NaN();

Model expansion(std::string target, std::string column) {
  Model model;
  model.targets = {std::move(target)};
  model.terms = {term_of("expansion", {std::move(column)})};
  model.terms[0].settings[0].start = 2.0;
  return model;
}

CompensatedAxes two_axes(std::string column_of_y = "T_b_degC") {
  return {{{"z", expansion("z_um", "T_a_degC")}, {"y", expansion("y_um", std::move(column_of_y))}}, {}};
}

Offset offset_of(std::int64_t counts, double resolution_um, double predicted_um, bool limited) {
  return {counts, static_cast<double>(counts) * resolution_um, predicted_um, Hold::none, 0, limited};
}

Offset held(std::int64_t counts, Hold hold) {
  return {counts, 0.1 * static_cast<double>(counts), kGap, hold, 0, false};
}

template <class Append>
std::string text_of(const Append& append) {
  fmt::memory_buffer out;
  append(out);
  return fmt::to_string(out);
}

TEST(offset_text, csv) {
  const CompensatedAxes axes = two_axes();
  EXPECT_EQ(text_of([&](auto& out) { append_csv_names(out, axes); }),
            "time_s,z_um,z_counts,z_predicted_um,z_limited,z_hold,y_um,y_counts,y_predicted_um,y_limited,y_hold\n");
  const Offset row[] = {offset_of(-31, 0.1, 3.12, false), offset_of(7, 0.25, -1.75, true)};
  EXPECT_EQ(text_of([&](auto& out) { append_csv(out, 12.5, row); }), "12.5,-3.1,-31,3.12,0,none,1.75,7,-1.75,1,none\n");
  const Offset hold[] = {held(-31, Hold::out_of_range), held(0, Hold::no_time)};
  EXPECT_EQ(text_of([&](auto& out) { append_csv(out, kGap, hold); }), ",-3.1,-31,,0,out_of_range,0,0,,0,no_time\n");
}

// 3 times 0.1 is 0.30000000000000004 in doubles: it is an offset of 0.3.
TEST(offset_text, an_offset_has_no_dust) {
  const Offset row[] = {offset_of(3, 0.1, 0.1 + 0.2, false)};
  EXPECT_EQ(text_of([&](auto& out) { append_csv(out, 0.0, row); }), "0,0.3,3,0.3,0,none\n");
}

TEST(offset_text, rows_go_behind_what_is_there) {
  const Offset row[] = {offset_of(0, 0.1, 0.0, false)};
  EXPECT_EQ(text_of([&](auto& out) {
              append_csv(out, 0.0, row);
              append_csv(out, 1.0, row);
            }),
            "0,0,0,0,0,none\n1,0,0,0,0,none\n");
}

TEST(offset_text, json_lines_are_json) {
  const CompensatedAxes axes = two_axes();
  const Offset row[] = {offset_of(-31, 0.1, 3.12, false), held(5, Hold::spike)};
  const std::string text = text_of([&](auto& out) { append_jsonl(out, 12.0, row, axes); });
  EXPECT_EQ(text.find('\n'), text.size() - 1);
  const nlohmann::json json = nlohmann::json::parse(text);
  EXPECT_EQ(json, nlohmann::json::parse(R"({"time_s": 12.0,
    "z": {"offset_um": -3.1, "counts": -31, "predicted_um": 3.12, "limited": false, "hold": "none"},
    "y": {"offset_um": 0.5, "counts": 5, "predicted_um": null, "limited": false, "hold": "spike",
          "column": "T_b_degC"}})"));
  const Offset no_time[] = {held(-31, Hold::no_time), held(5, Hold::clock_gap)};
  EXPECT_EQ(nlohmann::json::parse(text_of([&](auto& out) { append_jsonl(out, kGap, no_time, axes); })),
            nlohmann::json::parse(R"({"time_s": null,
    "z": {"offset_um": -3.1, "counts": -31, "predicted_um": null, "limited": false, "hold": "no_time"},
    "y": {"offset_um": 0.5, "counts": 5, "predicted_um": null, "limited": false, "hold": "clock_gap"}})"));
}

TEST(offset_text, json_lines_with_a_column_of_any_name) {
  const std::pair<std::string, std::string> names[] = {
      {"a \"b\"\\ {}_degC", "a \"b\"\\ {}_degC"},
      {"two\nlines\r\t\x01_degC", "two\nlines\r\t\x01_degC"},
      {"\xE6\xB8\xA9_degC", "\xE6\xB8\xA9_degC"},
      {"caf\xE9_degC", "caf\xEF\xBF\xBD_degC"},  // no UTF-8
      {std::string("nul\0_degC", 9), std::string("nul\0_degC", 9)},
  };
  for (const auto& [name, said] : names) {
    const CompensatedAxes axes = two_axes(name);
    const Offset row[] = {held(0, Hold::stuck), held(0, Hold::no_value)};
    const std::string text = text_of([&](auto& out) { append_jsonl(out, 0.0, row, axes); });
    EXPECT_EQ(text.find('\n'), text.size() - 1) << name;
    EXPECT_EQ(nlohmann::json::parse(text)["y"]["column"], said);
  }
}

// 16 lines, bit 0 the least, two's complement: 65536 - n for -n.
TEST(offset_text, words) {
  const CompensatedAxes axes = two_axes();
  EXPECT_EQ(text_of([&](auto& out) { append_word_names(out, axes); }),
            "time_s,z_word,z_hex,z_status,y_word,y_hex,y_status\n");
  const auto words = [](std::int64_t z, std::int64_t y) {
    const Offset row[] = {held(z, Hold::none), held(y, Hold::none)};
    return text_of([&](auto& out) { append_words(out, 1.5, row); });
  };
  EXPECT_EQ(words(0, 1), "1.5,0,0x0000,0,1,0x0001,0\n");
  EXPECT_EQ(words(-1, -2), "1.5,65535,0xFFFF,0,65534,0xFFFE,0\n");
  EXPECT_EQ(words(32767, -32767), "1.5,32767,0x7FFF,0,32769,0x8001,0\n");
  EXPECT_EQ(words(256, -256), "1.5,256,0x0100,0,65280,0xFF00,0\n");
  for (std::int64_t counts = -32767; counts <= 32767; ++counts) {
    const std::string text = words(counts, 0);
    const long word = std::stol(text.substr(4));
    ASSERT_EQ(word < 32768 ? word : word - 65536, counts) << text;
    ASSERT_EQ(std::stol(text.substr(text.find('x') + 1), nullptr, 16), word) << text;
  }
}

// The reason of a hold, 4 for out_of_range, and 16 where the offset is on its way.
TEST(offset_text, status_of_a_word) {
  const Offset row[] = {held(1, Hold::out_of_range), offset_of(2, 0.1, 5.0, true)};
  EXPECT_EQ(text_of([&](auto& out) { append_words(out, 0.0, row); }), "0,1,0x0001,4,2,0x0002,16\n");
}

// kLargestWord times any resolution is as many counts, not one more nor one less.
TEST(offset_text, the_largest_word_is_reached_and_not_passed) {
  for (const double resolution_um : {1e-3, 0.01, 0.1, 0.3, 1.0 / 3.0, 0.7, 1.0, 10.0}) {
    CompensationLimits limits;
    limits.resolution_um = resolution_um;
    limits.largest_um = kLargestWord * resolution_um;
    limits.rate_um_per_s = limits.step_um = limits.spike_K = 1e9;
    CompensatedAxes axes({{"z", expansion("z_um", "T_a_degC")}}, limits);
    axes.next(0.0, {{0.0}});
    EXPECT_EQ(axes.next(1.0, {{1e6}})[0].counts, -32767) << resolution_um;
    EXPECT_EQ(axes.next(2.0, {{-1e6}})[0].counts, 32767) << resolution_um;
  }
}

// Bytes in, bytes out, as `compensate --signals` does it: after the first rows no row takes memory, held or not.
TEST(offset_text, no_memory_a_row_from_text_to_text) {
  Model warm = expansion("z_um", "T_a_degC");
  warm.terms.push_back(term_of("lagged_expansion", {"T_b_degC"}));
  warm.terms.push_back(term_of("speed_heating", {"speed_rpm"}));
  Model across;
  across.targets = {"x_um"};
  across.terms = {term_of("axial_crosstalk", {"z_um"})};
  CompensatedAxes axes({{"z", warm}, {"x", across}}, {});
  LiveRows rows("live.csv", {axes.columns().begin(), axes.columns().end()});
  std::string text = "time_s,T_a_degC,T_b_degC,note,speed_rpm\n";
  for (int i = 0; i < 3000; ++i) {
    if (i % 97 == 0) text += "torn li\n";
    text += fmt::format("{},{:.6f},{},hello,{}\n", 1000.0 + 0.5 * i, 22.0 + std::sin(0.01 * i),
                        i % 13 == 0 ? "" : fmt::format("{:.5f}", 30.0 + std::cos(0.02 * i)), 3000 + i % 7);
  }
  fmt::memory_buffer out;
  std::size_t before = 0, written = 0, found = 0, held_rows = 0;
  constexpr std::size_t kPiece = 512;
  for (std::size_t at = 0; at < text.size(); at += kPiece) {
    rows.add(std::string_view(text).substr(at, kPiece));
    while (const LiveRow* row = rows.next()) {
      const std::span<const Offset> offsets = axes.next(row->time_s, row->values);
      append_csv(out, row->time_s, offsets);
      append_words(out, row->time_s, offsets);
      held_rows += offsets[0].hold == Hold::none ? 0 : 1;
      ++found;
    }
    written += out.size();
    out.clear();
    if (at < 40 * kPiece) before = allocations();
  }
  EXPECT_EQ(allocations(), before);
  EXPECT_EQ(found, 3031u);
  EXPECT_GT(held_rows, 200u);
  EXPECT_GT(written, 100'000u);
}

}  // namespace
}  // namespace ballbar
