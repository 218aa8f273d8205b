#include "measure/comparison_plot.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "ballbar/formats/text/bytes.hpp"
#include "programs/gnuplot.hpp"
#include "scratch_folder.hpp"

namespace ballbar {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

AxisComparison axis_of(const std::string& name, const std::string& unit, std::size_t samples) {
  AxisComparison axis;
  axis.name = name;
  axis.unit = unit;
  for (std::size_t i = 0; i < samples; ++i) {
    axis.time_s.push_back(60.0 * static_cast<double>(i));
    axis.a.push_back(i % 2 == 0 ? 1.0 : -1.0);
    axis.b.push_back(0.5);
    axis.difference.push_back(axis.a[i] - axis.b[i]);
    axis.sigma.push_back(i == 0 ? 0.0 : 1.0);
  }
  axis.agreement = Agreement::agrees;
  axis.within = axis.counted = samples - 1;
  return axis;
}

Comparison comparison_of(const std::vector<AxisComparison>& axes) {
  Comparison comparison;
  comparison.a = "ballbar";
  comparison.b = "probes";
  comparison.axes = axes;
  return comparison;
}

std::string svg_of(const Comparison& comparison, const std::string& heading) {
  return svg_by_gnuplot(comparison_script(comparison, heading));
}

bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(comparison_plot, shows_axes_units_names_and_heading_as_text) {
  Comparison comparison = comparison_of({axis_of("x", "um", 9), axis_of("tilt_a", "urad", 9)});
  comparison.axes[1].deviation = Deviation{.from_s = 120.0, .to_s = 120.0};
  comparison.a = "' ` system(\"touch made\") ` <script> &";
  comparison.b = "温度";
  const std::string svg = svg_of(comparison, "a ]]> b\nsecond line");
  for (const char* const text :
       {">x<", ">x: a − b<", ">tilt_a<", ">tilt_a: a − b<", ">µm<", ">µrad<", ">agrees, 8 of 8 within 2σ<",
        ">a: ' ` system(\"touch made\") ` &lt;script> &amp;<", ">b: 温度<", ">a ]] > b<", ">second line<",
        ">±2σ of a − b<", ">stretch beyond 2σ that holds the worst sample<", ">time in minutes<"}) {
    EXPECT_TRUE(holds(svg, text)) << text;
  }
  EXPECT_EQ(svg, svg_of(comparison, "a ]]> b\nsecond line"));
}

TEST(comparison_plot, has_no_band_without_sigma_and_no_shade_without_deviation) {
  AxisComparison axis = axis_of("x", "um", 9);
  axis.agreement = Agreement::cannot_tell;
  axis.sigma.assign(9, kNan);
  const std::string svg = svg_of(comparison_of({axis}), "");
  EXPECT_FALSE(holds(svg, "2σ"));
  EXPECT_TRUE(holds(svg, ">cannot tell<"));
}

// Values that leave gnuplot's own ranges empty, and a sigma that is not known everywhere.
TEST(comparison_plot, draws_whatever_the_values_are) {
  AxisComparison still = axis_of("still", "um", 3);
  still.a = still.b = {7.0, 7.0, 7.0};
  still.difference = still.sigma = {0.0, 0.0, 0.0};
  AxisComparison gaps = axis_of("gaps", "um", 3);
  gaps.a = gaps.b = gaps.difference = gaps.sigma = {kNan, kNan, kNan};
  AxisComparison partly = axis_of("partly", "um", 3);
  partly.sigma = {kNan, 1.0, std::numeric_limits<double>::infinity()};
  const Comparison comparison = comparison_of({still, gaps, partly, axis_of("one", "um", 1)});
  EXPECT_TRUE(holds(svg_of(comparison, "heading"), ">one<"));
}

// 50000 samples in 1000 groups of 50: the one of 9 is the largest of its group and is kept.
TEST(comparison_plot, of_many_samples_keeps_the_extremes_and_stays_small) {
  Comparison comparison = comparison_of({axis_of("x", "um", 50000)});
  comparison.axes[0].a[12345] = 9.0;
  const std::string script = comparison_script(comparison, "");
  EXPECT_TRUE(holds(script, "\n12345 9\n"));
  // a and a - b: two rows a group (b and sigma: one where they are constant).
  EXPECT_LT(std::count(script.begin(), script.end(), '\n'), 4 * 2000 + 200);
  EXPECT_LT(svg_by_gnuplot(script).size(), std::size_t{400000});
}

TEST(comparison_plot, wraps_a_long_heading_into_four_lines) {
  std::string words;
  for (int i = 0; i < 200; ++i) words += "温度 word ";
  const std::string script = comparison_script(comparison_of({axis_of("x", "um", 9)}), words);
  EXPECT_TRUE(holds(script, "set label 104 "));
  EXPECT_TRUE(holds(script, "…"));
  EXPECT_FALSE(holds(script, "\uFFFD"));  // no character is cut
}

TEST(comparison_plot, is_written_to_a_name_that_ends_in_svg) {
  const ScratchFolder folder;
  const Comparison comparison = comparison_of({axis_of("x", "um", 9)});
  plot_comparison(comparison, "heading", folder.path() / "a.svg");
  EXPECT_EQ(read_bytes(folder.path() / "a.svg", 1 << 20), svg_of(comparison, "heading"));
  const auto said = [&](const char* name) {
    return complaint(folder, [&] { plot_comparison(comparison, "heading", folder.path() / name); });
  };
  EXPECT_EQ(said("a.png"), "DIR/a.png: expected a name that ends in .svg, found \".png\".");
  EXPECT_EQ(said("a"), "DIR/a: expected a name that ends in .svg, found no ending.");
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "a.png"));
}

}  // namespace
}  // namespace ballbar
