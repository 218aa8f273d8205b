#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <pugixml.hpp>

#include "plan/plan_files.hpp"
#include "plan/svg.hpp"

namespace ballbar {
namespace {

// Two hours of two curves, which part in the second.
PlanContents sample() {
  PlanContents contents{.schedule = {.dwells = {{.duration_s = 3600.0}, {.duration_s = 3600.0, .speed_rpm = 8000.0}}},
                        .title = "Which of two",
                        .text = "One text."};
  for (const double slope : {1.0, 3.0}) {
    PlanCurve curve{.label = slope > 1.0 ? "steep" : "flat", .p = slope > 1.0 ? 0.3 : 0.7};
    for (int i = 0; i <= 120; ++i) {
      curve.time_s.push_back(i * 60.0);
      curve.um.push_back(i < 60 ? 0.0 : slope * (i - 60) / 6.0);
      curve.sigma_um.push_back(1.0);
    }
    contents.curves.push_back(curve);
  }
  for (int i = 0; i <= 120; ++i) contents.separation.push_back(i < 60 ? 0.0 : (i - 60) / 60.0);
  return contents;
}

pugi::xml_document parsed(const std::string& svg) {
  pugi::xml_document document;
  const pugi::xml_parse_result result = document.load_buffer(svg.data(), svg.size());
  EXPECT_TRUE(result) << result.description() << "\n" << svg.substr(0, 2000);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("inf"), std::string::npos);
  return document;
}

std::vector<std::string> texts_of(const pugi::xml_document& document) {
  std::vector<std::string> texts;
  for (const pugi::xml_node node : document.child("svg").children("text")) texts.emplace_back(node.text().get());
  return texts;
}

std::vector<std::pair<double, double>> points_of(const pugi::xml_node& node) {
  std::vector<std::pair<double, double>> points;
  std::istringstream stream(node.attribute("points").value());
  double x = 0.0, y = 0.0;
  char comma = 0;
  while (stream >> x >> comma >> y) points.emplace_back(x, y);
  return points;
}

bool has(const std::vector<std::string>& texts, const std::string& text) {
  return std::find(texts.begin(), texts.end(), text) != texts.end();
}

TEST(plan_picture, schedule_curves_bands_and_where_they_part) {
  const pugi::xml_document document = parsed(plan_picture(sample()));
  const pugi::xml_node svg = document.child("svg");
  const std::vector<std::string> texts = texts_of(document);
  for (const char* text : {"Which of two", "One text.", "spindle rpm", "flat, P 70 %", "steep, P 30 %",
                           "where they part: the darker, the more is told apart"}) {
    EXPECT_TRUE(has(texts, text)) << text;
  }
  EXPECT_FALSE(has(texts, "load, times that of the data"));
  std::vector<std::vector<std::pair<double, double>>> lines;
  for (const pugi::xml_node node : svg.children("polyline")) lines.push_back(points_of(node));
  ASSERT_EQ(lines.size(), 3u);  // the speed and two curves
  ASSERT_EQ(lines[0].size(), 4u);
  EXPECT_EQ(lines[0][0].first, lines[1].front().first);  // one axis of time
  EXPECT_EQ(lines[0][3].first, lines[1].back().first);
  EXPECT_NEAR(lines[0][1].first, (lines[0][0].first + lines[0][3].first) / 2.0, 0.1);
  EXPECT_LT(lines[0][2].second, lines[0][1].second);          // up is faster
  EXPECT_LT(lines[2].back().second, lines[1].back().second);  // the steep one ends above
  EXPECT_EQ(lines[2].front().second, lines[1].front().second);
  const pugi::xml_node band = svg.child("polygon");
  EXPECT_EQ(points_of(band).size(), 242u);
  // 30 um and one sigma at the top, -1 at the bottom: a band of two sigma is 2 / 32 of their distance.
  double low = 0.0, high = 1e9;
  for (const pugi::xml_node node : svg.children("polygon")) {
    for (const auto& point : points_of(node)) {
      low = std::max(low, point.second);
      high = std::min(high, point.second);
    }
  }
  const auto outline = points_of(band);
  EXPECT_NEAR(outline.back().second - outline.front().second, (low - high) * 2.0 / 32.0, 0.3);

  double first = 1e9, darkest = 0.0, last = 0.0;
  for (const pugi::xml_node node : svg.children("rect")) {
    if (!node.attribute("fill-opacity")) continue;
    first = std::min(first, node.attribute("x").as_double());
    if (node.attribute("fill-opacity").as_double() >= darkest) {
      darkest = node.attribute("fill-opacity").as_double();
      last = node.attribute("x").as_double();
    }
  }
  EXPECT_GE(first, lines[0][1].first);  // none before they part
  EXPECT_EQ(darkest, 0.35);
  EXPECT_GT(last, lines[0][3].first - 10.0);
}

TEST(plan_picture, what_is_set_has_a_panel_of_its_own) {
  PlanContents contents = sample();
  contents.schedule.dwells[1].load = 1.5;
  contents.schedule.dwells[1].coolant_K = -2.0;
  const std::vector<std::string> texts = texts_of(parsed(plan_picture(contents)));
  EXPECT_TRUE(has(texts, "load, times that of the data"));
  EXPECT_TRUE(has(texts, "coolant, K beside the data"));
  EXPECT_FALSE(has(texts, "room, K beside the data"));
}

TEST(plan_picture, any_text_and_any_number) {
  PlanContents contents = sample();
  contents.title = "<script>alert(1)</script> & \"so\" \x01\xff\xEF\xBF\xBF on";
  contents.text = fmt::format("{:x>1000} \xC3\xA4\xE2\x82\xAC\nnext", "");
  contents.curves[0].label = std::string(500, '<');
  contents.curves[0].um[7] = NAN;
  contents.curves[0].sigma_um[8] = INFINITY;
  contents.curves[0].um[9] = 1e300;
  contents.curves[1].time_s[5] = NAN;
  contents.curves[1].sigma_um.clear();
  contents.separation[100] = NAN;
  contents.separation.resize(110);
  const pugi::xml_document document = parsed(plan_picture(contents));
  const std::vector<std::string> texts = texts_of(document);
  EXPECT_TRUE(has(texts, "<script>alert(1)</script> & \"so\"  ?? on"));
  EXPECT_TRUE(has(texts, "next"));
  EXPECT_FALSE(document.child("svg").child("script"));
  EXPECT_EQ(points_of(document.child("svg").child("polygon")).size(), 2u * 118u);
}

TEST(plan_picture, six_curves_at_most_and_none_at_least) {
  PlanContents contents = sample();
  for (int i = 0; i < 7; ++i) {
    contents.curves.push_back(contents.curves[0]);
    contents.curves.back().p = 0.01 * i;
  }
  const pugi::xml_document many = parsed(plan_picture(contents));
  EXPECT_TRUE(has(texts_of(many), "and 3 less likely, not drawn"));
  contents.curves.clear();
  parsed(plan_picture(contents));
  contents.schedule = {.dwells = {{.duration_s = 31.0 * 86400.0}}};
  parsed(plan_picture(contents));
}

TEST(plan_picture, lines_break_at_blanks) {
  EXPECT_EQ(broken_lines("one two three", 7), (std::vector<std::string>{"one two", "three"}));
  EXPECT_EQ(broken_lines("one\n\ntwo", 7), (std::vector<std::string>{"one", "two"}));
  EXPECT_EQ(broken_lines("abcdefgh", 3), (std::vector<std::string>{"abc", "def", "gh"}));
  EXPECT_EQ(broken_lines("a bcdefgh i", 3), (std::vector<std::string>{"a", "bcd", "efg", "h i"}));
  EXPECT_TRUE(broken_lines("", 7).empty());
}

TEST(plan_picture, steps_are_round) {
  EXPECT_DOUBLE_EQ(axis_step(32.0, 6), 10.0);
  EXPECT_DOUBLE_EQ(axis_step(12.0, 6), 2.0);
  EXPECT_DOUBLE_EQ(axis_step(0.9, 6), 0.2);
  EXPECT_DOUBLE_EQ(axis_step(5.0, 5), 1.0);
}

}  // namespace
}  // namespace ballbar
