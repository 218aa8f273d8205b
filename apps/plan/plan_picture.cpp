#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>

#include "ballbar/internal/number_text.hpp"
#include "plan/plan_files.hpp"
#include "plan/svg.hpp"

namespace ballbar {
namespace {

constexpr double kWidth = 960.0, kLeft = 76.0, kRight = 940.0, kLine = 18.0, kGap = 34.0;
constexpr double kSpeedHeight = 130.0, kSettingHeight = 56.0, kCurvesHeight = 300.0;
constexpr std::size_t kMostCurves = 6, kMostPoints = 500, kMostShades = 240, kLongestLine = 118;
constexpr double kLeastRange = 1e-9;
// Okabe and Ito's, which the colour-blind tell apart.
constexpr std::array<std::string_view, kMostCurves> kColours = {"#0072b2", "#d55e00", "#009e73",
                                                                "#cc79a7", "#e69f00", "#56b4e9"};

std::string shortened(std::string_view text) {
  const std::vector<std::string> lines = broken_lines(text, kLongestLine - 20);
  if (lines.empty()) return {};
  return lines.size() == 1 ? lines[0] : lines[0] + " ...";
}

constexpr std::string_view kGrid = "stroke=\"#dddddd\"", kFrame = "fill=\"none\" stroke=\"#888888\"";
constexpr std::string_view kAtEnd = " text-anchor=\"end\"", kInMiddle = " text-anchor=\"middle\"";

// Frame and lines of the times; `labels`: with their numbers below.
void time_axis(Svg& svg, const Scale& time, double top, double bottom, bool labels) {
  constexpr double kSteps_min[] = {0.1, 0.5, 1, 2, 5, 10, 15, 30, 60, 120, 240, 360, 720, 1440, 2880, 5760};
  const double range_min = time.high / 60.0;
  const auto* const step =
      std::find_if(std::begin(kSteps_min), std::end(kSteps_min), [&](double one) { return range_min / one <= 13.0; });
  const double step_min = step == std::end(kSteps_min) ? axis_step(range_min, 12) : *step;
  const bool in_hours = step_min >= 30.0;
  for (int i = 0; i * step_min <= range_min * (1.0 + 1e-9); ++i) {
    const double x = time(i * step_min * 60.0);
    svg.line(x, top, x, bottom, kGrid);
    if (labels) svg.text(x, bottom + 16.0, fmt::format("{:.4g}", i * step_min / (in_hours ? 60.0 : 1.0)), kInMiddle);
  }
  if (labels) svg.text((kLeft + kRight) / 2.0, bottom + 32.0, in_hours ? "time h" : "time min", kInMiddle);
  svg.rectangle(kLeft, top, kRight - kLeft, bottom - top, kFrame);
}

void value_axis(Svg& svg, const Scale& value, std::string_view name, int count) {
  const double step = axis_step(value.high - value.low, count);
  for (double i = std::ceil(value.low / step); i * step <= value.high; ++i) {
    svg.line(kLeft, value(i * step), kRight, value(i * step), kGrid);
    svg.text(kLeft - 6.0, value(i * step) + 4.0, fmt::format("{:.6g}", i * step == 0.0 ? 0.0 : i * step), kAtEnd);
  }
  svg.text(kLeft, value.to_px - 6.0, name);
}

std::string points_text(const Scale& time, const Scale& value, const std::vector<std::pair<double, double>>& points) {
  std::string text;
  for (const auto& [time_s, y] : points) {
    text += fmt::format("{}{:.1f},{:.1f}", text.empty() ? "" : " ", time(time_s), value(y));
  }
  return text;
}

// A quantity of the dwells, as steps.
void steps_panel(Svg& svg, const Scale& time, const Schedule& schedule, double top, double height,
                 std::string_view name, double Dwell::*member) {
  double low = 0.0, high = 0.0;
  for (const Dwell& dwell : schedule.dwells) {
    low = std::min(low, dwell.*member);
    high = std::max(high, dwell.*member);
  }
  if (!(high - low > kLeastRange)) high = low + 1.0;
  const double margin = (high - low) * 0.08;
  const Scale value{low < 0.0 ? low - margin : low, high + margin, top + height, top};
  time_axis(svg, time, top, top + height, false);
  value_axis(svg, value, name, height > kSettingHeight ? 4 : 2);
  std::vector<std::pair<double, double>> points;
  points.reserve(2 * schedule.dwells.size());
  double begin_s = 0.0;
  for (const Dwell& dwell : schedule.dwells) {
    points.emplace_back(begin_s, dwell.*member);
    begin_s += dwell.duration_s;
    points.emplace_back(begin_s, dwell.*member);
  }
  svg.add(fmt::format("<polyline fill=\"none\" stroke=\"#222222\" stroke-width=\"1.8\" points=\"{}\"/>",
                      points_text(time, value, points)));
}

bool is_drawn(double value) { return std::abs(value) < 1e12; }  // neither NaN nor out of all bounds

// The points of a curve that are drawn, and its band where it has one.
struct Drawn {
  std::vector<std::pair<double, double>> middle, above, below;
};

Drawn drawn_of(const PlanCurve& curve) {
  Drawn drawn;
  const bool has_band = !curve.sigma_um.empty();
  std::size_t count = std::min(curve.time_s.size(), curve.um.size());
  if (has_band) count = std::min(count, curve.sigma_um.size());
  const std::size_t stride = count / kMostPoints + 1;
  for (std::size_t i = 0; i < count; ++i) {
    if (i % stride != 0 && i + 1 != count) continue;
    const double sigma_um = has_band ? curve.sigma_um[i] : 0.0;
    if (!is_drawn(curve.time_s[i]) || !is_drawn(curve.um[i]) || !is_drawn(sigma_um)) continue;
    drawn.middle.emplace_back(curve.time_s[i], curve.um[i]);
    if (!has_band) continue;
    drawn.above.emplace_back(curve.time_s[i], curve.um[i] + sigma_um);
    drawn.below.emplace_back(curve.time_s[i], curve.um[i] - sigma_um);
  }
  return drawn;
}

// Darker where `separation` is larger; times of equal length each take the largest that falls into them.
bool shade(Svg& svg, const Scale& time, const PlanContents& contents, double top, double height) {
  if (contents.curves.empty()) return false;
  const std::vector<double>& time_s = contents.curves.front().time_s;
  const std::size_t count = std::min(time_s.size(), contents.separation.size());
  std::array<double, kMostShades> largest{};
  double most = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const double share = time_s[i] / time.high;
    if (!(share >= 0.0 && share <= 1.0) || !is_drawn(contents.separation[i])) continue;
    // Until the next time, so that few times leave no gaps.
    const double next = i + 1 < count && is_drawn(time_s[i + 1]) ? time_s[i + 1] / time.high : share;
    const auto place = [](double part) {
      return std::min(static_cast<std::size_t>(std::clamp(part, 0.0, 1.0) * kMostShades), kMostShades - 1);
    };
    for (std::size_t k = place(share); k == place(share) || k < place(next); ++k) {
      largest[k] = std::max(largest[k], contents.separation[i]);
    }
    most = std::max(most, contents.separation[i]);
  }
  if (most <= 0.0) return false;
  const double width = (kRight - kLeft) / kMostShades;
  for (std::size_t k = 0; k < kMostShades; ++k) {
    const double opacity = std::round(largest[k] / most * 35.0) / 100.0;
    if (opacity == 0.0) continue;
    svg.rectangle(kLeft + static_cast<double>(k) * width, top, width, height,
                  fmt::format("fill=\"#f0c000\" fill-opacity=\"{}\"", opacity));
  }
  return true;
}

struct Legend {
  std::string colour, text;  // no colour: words alone
};

std::vector<Legend> curves_panel(Svg& svg, const Scale& time, const PlanContents& contents, double top) {
  std::vector<const PlanCurve*> curves;
  for (const PlanCurve& curve : contents.curves) curves.push_back(&curve);
  std::stable_sort(curves.begin(), curves.end(), [](auto* left, auto* right) { return left->p > right->p; });
  const std::size_t left_out = curves.size() - std::min(curves.size(), kMostCurves);
  curves.resize(curves.size() - left_out);

  std::vector<Drawn> drawn;
  drawn.reserve(curves.size());
  double low = 0.0, high = 0.0;
  for (const PlanCurve* curve : curves) {
    drawn.push_back(drawn_of(*curve));
    for (const auto* points : {&drawn.back().middle, &drawn.back().above, &drawn.back().below}) {
      for (const auto& point : *points) {
        low = std::min(low, point.second);
        high = std::max(high, point.second);
      }
    }
  }
  if (!(high - low > kLeastRange)) high = low + 1.0;
  const double margin = (high - low) * 0.05;
  const Scale value{low - margin, high + margin, top + kCurvesHeight, top};
  const bool shaded = shade(svg, time, contents, top, kCurvesHeight);
  value_axis(svg, value, "expected drift um, band of one sigma", 6);
  time_axis(svg, time, top, top + kCurvesHeight, true);

  std::vector<Legend> legends;
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    const Drawn& one = drawn[i];
    if (!one.above.empty()) {
      std::vector<std::pair<double, double>> outline = one.above;
      outline.insert(outline.end(), one.below.rbegin(), one.below.rend());
      svg.add(fmt::format("<polygon fill=\"{}\" fill-opacity=\"0.18\" points=\"{}\"/>", kColours[i],
                          points_text(time, value, outline)));
    }
    svg.add(fmt::format("<polyline fill=\"none\" stroke=\"{}\" stroke-width=\"2\" points=\"{}\"/>", kColours[i],
                        points_text(time, value, one.middle)));
    legends.push_back(
        {std::string(kColours[i]), fmt::format("{}, P {}", shortened(curves[i]->label), percent_text(curves[i]->p))});
  }
  if (left_out > 0) legends.push_back({"", fmt::format("and {} less likely, not drawn", left_out)});
  if (shaded) legends.push_back({"#f0c000", "where they part: the darker, the more is told apart"});
  return legends;
}

}  // namespace

std::string plan_picture(const PlanContents& contents) {
  Svg svg;
  const Schedule& schedule = contents.schedule;
  const Scale time{0.0, duration_s(schedule), kLeft, kRight};
  double y = 26.0;
  for (const std::string& line : broken_lines(contents.title, kLongestLine - 30)) {
    svg.text(kLeft, y, line, " font-size=\"17\" font-weight=\"bold\"");
    y += 22.0;
  }
  for (const std::string& line : broken_lines(contents.text, kLongestLine)) {
    svg.text(kLeft, y, line);
    y += kLine;
  }
  y += 12.0;
  steps_panel(svg, time, schedule, y, kSpeedHeight, "spindle rpm", &Dwell::speed_rpm);
  y += kSpeedHeight + kGap;
  struct Condition {
    std::string_view name;
    double Dwell::*member;
  };
  for (const Condition& condition :
       {Condition{"load, times that of the data", &Dwell::load}, Condition{"room, K beside the data", &Dwell::room_K},
        Condition{"coolant, K beside the data", &Dwell::coolant_K}}) {
    const bool is_set = std::any_of(schedule.dwells.begin(), schedule.dwells.end(), [&](const Dwell& dwell) {
      return dwell.*condition.member != Dwell{}.*condition.member;
    });
    if (!is_set) continue;
    steps_panel(svg, time, schedule, y, kSettingHeight, condition.name, condition.member);
    y += kSettingHeight + kGap;
  }
  const std::vector<Legend> legends = curves_panel(svg, time, contents, y);
  y += kCurvesHeight + 56.0;
  for (const Legend& legend : legends) {
    if (!legend.colour.empty()) svg.rectangle(kLeft, y - 8.0, 22.0, 6.0, fmt::format("fill=\"{}\"", legend.colour));
    svg.text(kLeft + 30.0, y, legend.text);
    y += kLine;
  }
  return svg.whole(kWidth, y + 4.0, contents.title, contents.text);
}

}  // namespace ballbar
