// The folder of a plan: what a shop needs to run a test.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
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
  std::vector<double> separation;
  std::vector<std::string> columns_to_log;
  ProgramOptions options;
};

// Name and bytes of each file: schedule.csv, the program of each control, checklist.txt, plan.svg. Throws Error as
// spindle_program.
std::vector<std::pair<std::string, std::string>> plan_files(const PlanContents& contents);

// Throws Error where `folder` is a file or holds anything, another plan too: to be called before the work is done.
void expect_plan_folder(const std::filesystem::path& folder);

// Writes them to a new or an empty folder, all or nothing. Throws Error as both, and where they cannot be written.
void write_plan(const std::filesystem::path& folder, const PlanContents& contents);

// SVG of 960 px: title and text, the schedule's speed (and load, room and coolant, where they are set), below it what
// each hypothesis expects with a band of one sigma, the six of the largest p; shaded where they part. Any text is
// escaped, what is not finite is left out, a long curve is drawn by 500 of its points.
std::string plan_picture(const PlanContents& contents);

}  // namespace ballbar
