// A plan of a test, as it is written to a folder.
#pragma once

#include <string>
#include <vector>

#include "ballbar/diagnosis/next_test/schedule.hpp"
#include "ballbar/formats/schedules/spindle_program.hpp"

namespace ballbar {

// What one of the rival hypotheses expects of the target over the schedule.
struct PlanCurve {
  std::string label;
  double p = 0.0;                            // of the hypothesis today
  std::vector<double> time_s, um, sigma_um;  // n; sigma_um n, or empty: no band
};

struct PlanContents {
  Schedule schedule;
  std::string title, text;        // text: what the plan is expected to tell, in sentences
  std::vector<PlanCurve> curves;  // in any order
  // How well each time tells the hypotheses apart, one for each time_s of the first curve, 0 and above in any unit: the
  // picture is shaded the darker the larger it is. May be empty.
  std::vector<double> apart;
  std::vector<std::string> columns_to_log;
  ProgramOptions options;
};

}  // namespace ballbar
