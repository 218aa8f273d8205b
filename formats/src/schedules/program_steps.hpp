// The steps of a program for a schedule, independent of the language of a control.
#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "ballbar/formats/schedules/spindle_program.hpp"

namespace ballbar::steps {

struct Comment {
  std::string text;
};
struct Turn {
  int speed_rpm = 0;
};
struct Rest {};    // M5
struct Orient {};  // at rest
struct Wait {
  long long duration_ms = 0;
};
struct Stop {  // for the operator, until he starts again
  std::string message;
};
struct Line {  // Y = 0
  double x_mm = 0.0, feed_mm_per_min = 0.0;
};
struct Circle {  // a full one about zero, from and to x_mm, Y = 0
  double x_mm = 0.0;
  bool is_ccw = true;
};
using Step = std::variant<Comment, Turn, Rest, Orient, Wait, Stop, Line, Circle>;

// Throws Error where an option is not what it may be, or a dwell is above max_rpm.
void expect_options(const Schedule& schedule, const ProgramOptions& options);

// `schedule` and `options` are checked.
std::vector<Step> steps_of(const Schedule& schedule, const ProgramOptions& options);

// Letters, digits and "+-.,=" in capitals, all else blanks, of which never two follow; at most `most` characters.
std::string plain_text(std::string_view text, std::size_t most);

int whole_rpm(double speed_rpm);

}  // namespace ballbar::steps
