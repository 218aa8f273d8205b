// What a comparison of two drifts says.
#include "measure/comparison_conclusion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

namespace ballbar {
namespace {

using Values = std::vector<double>;

Values minutes(const Values& time_min) {
  Values time_s;
  for (const double one_min : time_min) time_s.push_back(60.0 * one_min);
  return time_s;
}

// One axis with the same sigma in every row but the first, the reference; sigma 0: none is stated.
MeasuredDrift drift(std::string what, Values time_s, Values value, double sigma, std::string name = "x",
                    std::string unit = "um") {
  MeasuredDrift one;
  one.what = std::move(what);
  one.time_s = std::move(time_s);
  DriftAxis axis{std::move(name), std::move(unit), std::move(value), {}};
  if (sigma > 0.0) {
    axis.budget.push_back({"sigma of " + one.what, Values(one.time_s.size(), sigma)});
    axis.budget.back().sigma.front() = 0.0;
  }
  one.axes.push_back(std::move(axis));
  return one;
}

TEST(comparison_conclusion, of_each_axis) {
  const Values time_s = minutes({0, 10, 20, 30, 40});
  const Values zero(5, 0.0);
  struct Axis {
    const char* name;
    Values d;
    double sigma;
  };
  struct {
    std::vector<Axis> axes;
    const char* sentence;
  } const cases[] = {
      {{{"x", zero, 0.1}}, "x agrees within the stated uncertainty."},
      {{{"x", zero, 0.1}, {"y", zero, 0.1}, {"z", zero, 0.1}}, "x, y, z agree within the stated uncertainty."},
      {{{"x", {0, 0, 1.234, 1.5, 0}, 0.1}},
       "Beyond the stated uncertainty: x from 20 min to 30 min, by 1.50 ± 0.10 um at 30 min."},
      {{{"x", {0, 0, 0, -1.0, -0.5}, 0.1}},
       "Beyond the stated uncertainty: x from 30 min to the end, by -1.00 ± 0.10 um at 30 min."},
      {{{"x", {0, 0, 1.0, 0, 0}, 0.1}}, "Beyond the stated uncertainty: x at 20 min, by 1.00 ± 0.10 um at 20 min."},
      {{{"x", {0, 0, 0, 0, 1.0}, 0.1}},
       "Beyond the stated uncertainty: x from 40 min to the end, by 1.00 ± 0.10 um at 40 min."},
      {{{"x", zero, 0.1}, {"y", {0, 0, 0, 0, 1.0}, 0.1}, {"z", {0, 1.0, 0, 0, 0}, 0.1}},
       "Beyond the stated uncertainty: y from 40 min to the end, by 1.00 ± 0.10 um at 40 min; z at 10 min, by 1.00 ± "
       "0.10 um at 10 min. x agrees."},
      {{{"x", zero, 0.1}, {"y", zero, 0.1}, {"z", {0, 1.0, 0, 0, 0}, 0.1}},
       "Beyond the stated uncertainty: z at 10 min, by 1.00 ± 0.10 um at 10 min. x, y agree."},
      {{{"x", zero, 0.0}, {"y", zero, 0.0}}, "x, y: agreement unknown, because no uncertainty is stated."},
      {{{"x", zero, 0.1}, {"y", zero, 0.0}},
       "x agrees within the stated uncertainty. y: agreement unknown, because no uncertainty is stated."},
      {{{"x", {0, 1.0, 0, 0, 0}, 0.1}, {"y", zero, 0.0}, {"z", zero, 0.1}},
       "Beyond the stated uncertainty: x at 10 min, by 1.00 ± 0.10 um at 10 min. z agrees. y: agreement unknown, "
       "because no uncertainty is stated."},
  };
  for (const auto& [axes, sentence] : cases) {
    MeasuredDrift a, b;
    a.time_s = b.time_s = time_s;
    for (const Axis& axis : axes) {
      a.axes.push_back(drift("a", time_s, axis.d, axis.sigma, axis.name).axes[0]);
      b.axes.push_back(drift("b", time_s, zero, 0.0, axis.name).axes[0]);
    }
    EXPECT_EQ(text_of(conclusion(compare(a, b))), sentence);
  }
}

AxisComparison axis_with(DifferenceKind kind, double value, double sigma) {
  AxisComparison axis;
  axis.name = "z";
  axis.unit = "um";
  axis.agreement = Agreement::disagrees;
  axis.samples_agree = true;
  axis.structure.emplace();
  axis.structure->stands_out = true;
  DifferencePart part;
  part.value = value;
  part.sigma = sigma;
  part.named = true;
  axis.structure->parts[static_cast<std::size_t>(kind)] = part;
  return axis;
}

TEST(comparison_conclusion, of_each_kind) {
  struct {
    DifferenceKind kind;
    double value, sigma;
    const char* sentence;
  } const cases[] = {
      {DifferenceKind::offset, -1.0, 0.1,
       "z of B is 1.00 ± 0.10 um below A from the first sample on. Check the "
       "reference point."},
      {DifferenceKind::gain, 1.04, 0.01,
       "z of B is 4.0 ± 1.0 % larger than A. Check the scale, the bar length and the "
       "place along the spindle."},
      {DifferenceKind::lag, -300.0, 60.0, "z of B is 5.0 ± 1.0 min late. Check the clocks."},
      {DifferenceKind::drift, 0.4, 0.1,
       "z of B drifts up from A by 0.40 ± 0.10 um/h. Check the stand and the fixture "
       "for creep."},
  };
  for (const auto& [kind, value, sigma, sentence] : cases) {
    Comparison comparison;
    comparison.axes = {axis_with(kind, value, sigma)};
    EXPECT_EQ(text_of(conclusion(comparison)), sentence);
  }
}

}  // namespace
}  // namespace ballbar
