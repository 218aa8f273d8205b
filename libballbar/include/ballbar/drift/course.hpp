// The course of readings without any input, such as the sizes of a shift's parts: a trend, a curve that settles, steps.
//
//   y(t) = a + b t + steps             trend        (wear of a tool; a drift that goes on)
//   y(t) = a + c exp(-t / tau) + steps decay        (warming up; running in)
//   y(t) = a + steps                   still
//
// Least squares. At most three steps, each where it lowers the sum of squares most beside the others, at least three
// readings from the ends and from each other. If the best of them leaves more than twice the scatter of neighbouring
// rows, none is the course. Shapes and steps by BIC, where a step costs three parameters (Zhang and Siegmund,
// Biometrics 63 (2007) 22) and the n readings count as n (1 - r) / (1 + r), r the correlation of neighbouring
// residuals. The probability of a shape is exp(-BIC / 2) over the sum of the three. The sigmas are those of the fit,
// times (1 + r) / (1 - r) in variance.
//
// Readings alone do not tell why a size changes: thermal growth, wear and a changed set-up may have one course.
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "ballbar/drift/drift.hpp"

namespace ballbar {

enum class CourseShape { still, trend, decay, none };
std::string_view name_of(CourseShape shape);

struct CourseStep {
  double time_s = 0.0;  // of the first reading after it
  Estimate size;
};

struct Course {
  CourseShape shape = CourseShape::still;  // the most probable
  double probability = 0.0;
  Estimate trend_um_per_h;       // of the shape trend, whatever the most probable one is
  Estimate decay;                // decay: -c, the change in the end
  double time_constant_s = 0.0;  // tau
  std::vector<CourseStep> steps;
  double noise_um = 0.0;  // standard deviation of the residual; none: scatter of neighbouring rows
  double left_um = 0.0;   // none: what the best of the shapes leaves
};

// Of rows with rising times, NaN: a gap. More than 2000 rows: means of neighbours. nullopt: fewer than 8 rows.
std::optional<Course> course_of(std::span<const double> time_s, std::span<const double> value_um);

}  // namespace ballbar
