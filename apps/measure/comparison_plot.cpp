#include "measure/comparison_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <vector>

#include "ballbar/error.hpp"
#include "ballbar/formats/text/bytes.hpp"
#include "ballbar/units.hpp"
#include "programs/gnuplot.hpp"

namespace ballbar {
namespace {

using Values = std::vector<double>;

// Lengths in pixels.
constexpr int kWidth = 1200;
constexpr int kRow = 230;      // one axis
constexpr int kRowTitle = 34;  // of it, above the panels
constexpr int kRowTics = 34;   // of it, below the panels
constexpr int kHeadingLine = 22;
constexpr int kLegendLine = 20;
constexpr int kTimeLabel = 26;  // below the last row
struct Panel {
  int left, right;
};
constexpr Panel kSeries{90, 590};
constexpr Panel kDifference{690, 1180};

constexpr std::size_t kHeadingColumns = 130;
constexpr std::size_t kHeadingLines = 4;
constexpr std::size_t kNameColumns = 58;
constexpr std::size_t kMostSamples = 2000;  // of a series drawn as they are
constexpr std::size_t kMostMarks = 300;     // of the difference; more are a line only
constexpr std::size_t kGroups = 1000;       // else; a panel is 500 pixels wide

// Colours that all kinds of colour vision tell apart (Okabe, Ito 2008).
constexpr const char* kBlue = "#0072B2";
constexpr const char* kVermillion = "#D55E00";
constexpr const char* kSkyBlue = "#56B4E9";
constexpr const char* kOrange = "#E69F00";

// Columns of text; wide characters (Chinese, Japanese, Korean) take two.
std::size_t columns(std::string_view text) {
  std::size_t count = 0;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if ((byte & 0xC0U) != 0x80U) count += byte >= 0xE3 ? 2 : 1;
  }
  return count;
}

// The first characters that fit into `width` columns, at least one.
std::string_view start_of(std::string_view text, std::size_t width) {
  std::size_t end = 0;
  while (end < text.size()) {
    std::size_t next = end + 1;
    while (next < text.size() && (static_cast<unsigned char>(text[next]) & 0xC0U) == 0x80U) ++next;
    if (end > 0 && columns(text.substr(0, next)) > width) break;
    end = next;
  }
  return text.substr(0, end);
}

std::string shortened(std::string_view text, std::size_t width) {
  if (columns(text) <= width) return std::string(text);
  return std::string(start_of(text, width - 1)) + "…";
}

std::vector<std::string> heading_lines(std::string_view text) {
  std::vector<std::string> lines;
  while (!text.empty()) {
    if (lines.size() + 1 == kHeadingLines) {
      std::string rest(text.substr(0, text.find_last_not_of(" \n") + 1));
      std::replace(rest.begin(), rest.end(), '\n', ' ');
      if (!rest.empty()) lines.push_back(shortened(rest, kHeadingColumns));
      break;
    }
    std::string_view line = text.substr(0, text.find('\n'));
    if (columns(line) > kHeadingColumns) {
      line = start_of(line, kHeadingColumns);
      const std::size_t space = line.rfind(' ');
      if (space != std::string_view::npos && space > 0) line = line.substr(0, space);
    }
    text.remove_prefix(line.size());
    if (!text.empty() && (text.front() == ' ' || text.front() == '\n')) text.remove_prefix(1);
    if (!line.empty()) lines.emplace_back(line);
  }
  return lines;
}

std::string shown_unit(const std::string& unit) {
  if (unit == "um") return "µm";
  if (unit == "urad") return "µrad";
  if (unit == "degC") return "°C";
  return unit;
}

struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
};

void widen(Range& range, double value) {
  if (!std::isfinite(value)) return;
  range.low = std::min(range.low, value);
  range.high = std::max(range.high, value);
}

// gnuplot refuses an empty range.
Range with_margin(Range range, double margin) {
  if (range.low > range.high) return {-1.0, 1.0};
  const double span = range.high - range.low;
  const double more = span > 0.0 ? margin * span : std::max(1.0, 0.1 * std::abs(range.low));
  return {range.low - more, range.high + more};
}

bool any_finite(const Values& values) {
  return std::any_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
}

// The rows to draw, rising. A group without any finite value keeps one row, which is a gap.
std::vector<std::size_t> drawn_rows(const Values& values) {
  const std::size_t n = values.size();
  std::vector<std::size_t> rows;
  if (n <= kMostSamples) {
    for (std::size_t i = 0; i < n; ++i) rows.push_back(i);
    return rows;
  }
  for (std::size_t group = 0; group < kGroups; ++group) {
    const std::size_t begin = group * n / kGroups;
    const std::size_t end = (group + 1) * n / kGroups;
    std::size_t least = begin;
    std::size_t largest = begin;
    for (std::size_t i = begin; i < end; ++i) {
      if (!std::isfinite(values[i])) continue;
      if (!(values[i] >= values[least])) least = i;  // also where that is NaN
      if (!(values[i] <= values[largest])) largest = i;
    }
    rows.push_back(std::min(least, largest));
    if (least != largest) rows.push_back(std::max(least, largest));
  }
  return rows;
}

// Rows "minutes value"; NaN breaks a line and a band.
std::string datablock(const std::string& name, const Values& time_s, const Values& values) {
  std::string text = "$" + name + " << EOD\n";
  for (const std::size_t row : drawn_rows(values)) {
    const double value = std::isfinite(values[row]) ? values[row] : std::numeric_limits<double>::quiet_NaN();
    text += fmt::format("{:.7g} {:.6g}\n", min_from_s(time_s[row]), value);
  }
  return text + "EOD\n";
}

std::string verdict(const AxisComparison& axis) {
  switch (axis.agreement) {
    case Agreement::agrees:
      return fmt::format("agrees, {} of {} within 2σ", axis.within, axis.counted);
    case Agreement::disagrees:
      return fmt::format("disagrees, {} of {} within 2σ", axis.within, axis.counted);
    case Agreement::cannot_tell:
      break;
  }
  return "cannot tell";
}

struct Layout {
  int height, top;  // top: of the first row
  double time_low, time_high;
};

std::string at_screen(const Layout& layout, int x, int y) {
  return fmt::format("screen {:.6f},{:.6f}", x / double{kWidth}, 1.0 - y / double(layout.height));
}

std::string panel_place(const Layout& layout, std::size_t row, Panel panel) {
  const int top = layout.top + static_cast<int>(row) * kRow;
  const auto from_below = [&](int y) { return 1.0 - y / double(layout.height); };
  return fmt::format(
      "set lmargin at screen {:.6f}\nset rmargin at screen {:.6f}\nset tmargin at screen {:.6f}\n"
      "set bmargin at screen {:.6f}\n",
      panel.left / double{kWidth}, panel.right / double{kWidth}, from_below(top + kRowTitle),
      from_below(top + kRow - kRowTics));
}

std::string y_range(Range range) { return fmt::format("set yrange [{:.9g}:{:.9g}]\n", range.low, range.high); }

std::string panel_title(const std::string& name, const std::string& more) {
  std::string text = fmt::format("set label 1 {} at graph 0,1 offset 0,0.8 left font ',14'\n", gnuplot_quoted(name));
  if (!more.empty()) {
    text += fmt::format("set label 2 {} at graph 1,1 offset 0,0.8 right tc rgb '#444444'\n", gnuplot_quoted(more));
  }
  return text;
}

// Smaller marks where they stand close.
double mark_size(std::size_t samples) { return samples <= 60 ? 0.55 : samples <= 300 ? 0.4 : 0.22; }

std::string series_panel(const AxisComparison& axis, std::size_t row) {
  Range range;
  for (const double value : axis.a) widen(range, value);
  for (const double value : axis.b) widen(range, value);
  std::string text = panel_title(shortened(axis.name, 40), "") + y_range(with_margin(range, 0.06));
  text += "plot 0 with lines lc rgb '#888888' lw 1 notitle";
  const bool reduced = axis.a.size() > kMostSamples;
  const std::string a =
      any_finite(axis.a)
          ? fmt::format(", $a{} with {} lc rgb '{}' notitle", row,
                        reduced ? "lines lw 1" : fmt::format("points pt 7 ps {:.2f}", mark_size(axis.a.size())), kBlue)
          : "";
  const std::string b =
      any_finite(axis.b) ? fmt::format(", $b{} with lines lc rgb '{}' lw 2 notitle", row, kVermillion) : "";
  // Marks stand on the line; least and largest are joined to an area, which the line crosses.
  return text + (reduced ? a + b : b + a) + "\n";
}

std::string deviation_shade(const Deviation& deviation, const Layout& layout) {
  // A single sample has no width: at least 3 pixels to each side.
  const double least = 3.0 / (kDifference.right - kDifference.left) * (layout.time_high - layout.time_low);
  const double from = std::max(layout.time_low, min_from_s(deviation.from_s) - least);
  const double to = std::min(layout.time_high, min_from_s(deviation.to_s) + least);
  return fmt::format(
      "set object 1 rectangle from first {:.7g},graph 0 to first {:.7g},graph 1 behind fc rgb '{}' "
      "fs transparent solid 0.25 noborder\n",
      from, to, kOrange);
}

std::string difference_panel(const AxisComparison& axis, std::size_t row, const Layout& layout) {
  Range range;
  for (const double value : axis.difference) widen(range, value);
  for (const double sigma : axis.sigma) {
    widen(range, 2.0 * sigma);
    widen(range, -2.0 * sigma);
  }
  std::string text = panel_title(shortened(axis.name, 20) + ": a − b", verdict(axis));
  text += y_range(with_margin(range, 0.06));
  if (axis.deviation) text += deviation_shade(*axis.deviation, layout);
  const bool band = any_finite(axis.sigma);
  text += "plot ";
  if (band) {
    text += fmt::format(
        "$s{} using 1:(-2*$2):(2*$2) with filledcurves fc rgb '{}' fs transparent solid 0.35 noborder "
        "notitle, ",
        row, kSkyBlue);
  }
  text += "0 with lines lc rgb '#888888' lw 1 notitle";
  if (any_finite(axis.difference)) {
    text += fmt::format(", $d{} with lines lc rgb 'black' lw 1 notitle", row);
    if (axis.difference.size() <= kMostMarks) {
      text += fmt::format(", $d{} with points pt 7 ps {:.2f} lc rgb 'black' notitle", row,
                          0.8 * mark_size(axis.difference.size()));
    }
  }
  // Its edges stay in sight where the difference is dense.
  if (band) {
    text +=
        fmt::format(", for [side in '-2 2'] $s{} using 1:(side*$2) with lines lc rgb '{}' lw 1 notitle", row, kSkyBlue);
  }
  return text + "\nunset object 1\n";
}

// Drawn once, with the first panel, which stands before every `unset` of these numbers.
std::string heading_and_legend(const Comparison& comparison, const std::vector<std::string>& lines,
                               const Layout& layout) {
  std::string text;
  int number = 100;
  const auto label = [&](const std::string& words, int x, int y, const std::string& style) {
    text +=
        fmt::format("set label {} {} at {} left {}\n", ++number, gnuplot_quoted(words), at_screen(layout, x, y), style);
  };
  const auto has = [&](auto what) { return std::any_of(comparison.axes.begin(), comparison.axes.end(), what); };
  int y = 24;
  for (const std::string& one : lines) {
    label(one, 20, y, "font ',15'");
    y += kHeadingLine;
  }
  y += 4;
  const int sample = kSeries.left + 12;
  const int words = kSeries.left + 32;
  const auto line = [&](int x, int line_y, const std::string& style) {
    text += fmt::format("set arrow {} from {} to {} nohead {}\n", ++number, at_screen(layout, x - 12, line_y),
                        at_screen(layout, x + 12, line_y), style);
  };
  if (has([](const AxisComparison& axis) { return axis.a.size() > kMostSamples; })) {
    line(sample, y, fmt::format("lc rgb '{}' lw 1", kBlue));
  } else {
    label(" ", sample, y, fmt::format("point pt 7 ps 0.6 lc rgb '{}'", kBlue));
  }
  label("a: " + shortened(comparison.a, kNameColumns), words, y, "");
  line(sample, y + kLegendLine, fmt::format("lc rgb '{}' lw 2", kVermillion));
  label("b: " + shortened(comparison.b, kNameColumns), words, y + kLegendLine, "");

  const auto box = [&](int x, int box_y, const char* colour, double density) {
    text += fmt::format("set object {} rectangle from {} to {} fc rgb '{}' fs transparent solid {:.2f} noborder\n",
                        ++number, at_screen(layout, x - 12, box_y + 6), at_screen(layout, x + 12, box_y - 6), colour,
                        density);
  };
  int x = kDifference.left + 12;
  line(x, y, "lc rgb 'black' lw 1");
  label(" ", x, y, "point pt 7 ps 0.5 lc rgb 'black'");
  label("a − b", x + 20, y, "");
  if (has([](const AxisComparison& axis) { return any_finite(axis.sigma); })) {
    box(x + 120, y, kSkyBlue, 0.35);
    label("±2σ of a − b", x + 140, y, "");
  }
  if (has([](const AxisComparison& axis) { return axis.deviation.has_value(); })) {
    box(x, y + kLegendLine, kOrange, 0.25);
    label("stretch beyond 2σ that holds the worst sample", x + 20, y + kLegendLine, "");
  }
  return text;
}

}  // namespace

void expect_svg(const std::filesystem::path& path) {
  const std::string ending = path.extension().string();
  if (ending == ".svg") return;
  throw Error(fmt::format("{}: expected a name that ends in .svg, found {}.", path.string(),
                          ending.empty() ? "no ending" : fmt::format("\"{}\"", ending)));
}

std::string comparison_script(const Comparison& comparison, const std::string& heading) {
  const std::vector<std::string> lines = heading_lines(heading);
  Range time;
  for (const AxisComparison& axis : comparison.axes) {
    for (const double time_s : axis.time_s) widen(time, min_from_s(time_s));
  }
  time = with_margin(time, 0.01);
  Layout layout{.height = 0, .top = 0, .time_low = time.low, .time_high = time.high};
  layout.top = 20 + static_cast<int>(lines.size()) * kHeadingLine + 2 * kLegendLine;
  layout.height = layout.top + static_cast<int>(comparison.axes.size()) * kRow + kTimeLabel;

  std::string script = fmt::format(
      "set encoding utf8\n"
      "set terminal svg size {},{} noenhanced font 'sans-serif,13' name 'ballbar' background 'white'\n",
      kWidth, layout.height);
  for (std::size_t row = 0; row < comparison.axes.size(); ++row) {
    const AxisComparison& axis = comparison.axes[row];
    script += datablock(fmt::format("a{}", row), axis.time_s, axis.a);
    script += datablock(fmt::format("b{}", row), axis.time_s, axis.b);
    script += datablock(fmt::format("d{}", row), axis.time_s, axis.difference);
    script += datablock(fmt::format("s{}", row), axis.time_s, axis.sigma);
  }
  script += fmt::format(
      "unset key\n"
      "set border 3 lc rgb '#444444'\n"
      "set tics nomirror out scale 0.6 textcolor rgb 'black'\n"
      "set grid lc rgb '#E4E4E4' lw 1 lt 1\n"
      "set ytics autofreq\n"
      "set samples 2\n"
      "set xrange [{:.9g}:{:.9g}]\n"
      "set multiplot\n",
      layout.time_low, layout.time_high);
  script += heading_and_legend(comparison, lines, layout);
  for (std::size_t row = 0; row < comparison.axes.size(); ++row) {
    const AxisComparison& axis = comparison.axes[row];
    script += fmt::format("set ylabel {} offset 1,0\n", gnuplot_quoted(shortened(shown_unit(axis.unit), 12)));
    if (row + 1 == comparison.axes.size()) script += "set xlabel 'time in minutes'\n";
    script += panel_place(layout, row, kSeries) + series_panel(axis, row);
    script += "unset label\nunset arrow\nunset object\n";
    script += panel_place(layout, row, kDifference) + difference_panel(axis, row, layout);
    script += "unset label\n";
  }
  return script + "unset multiplot\n";
}

void plot_comparison(const Comparison& comparison, const std::string& heading, const std::filesystem::path& path) {
  expect_svg(path);
  write_bytes(path, svg_by_gnuplot(comparison_script(comparison, heading)));
}

}  // namespace ballbar
