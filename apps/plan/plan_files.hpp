// The folder of a plan: everything needed to run a test.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "ballbar/diagnosis/next_test/plan.hpp"

namespace ballbar {

// The curve of the target over the schedule that one hypothesis predicts.
struct PlanCurve {
  std::string label;
  double p = 0.0;                            // of the hypothesis today
  std::vector<double> time_s, um, sigma_um;  // n; sigma_um n, or empty: no band
};

struct PlanContents {
  Schedule schedule;
  std::string title, text;        // text: sentences on the expected outcome of the plan
  std::vector<PlanCurve> curves;  // in any order
  // How well the hypotheses are separated at each time_s of the first curve, >= 0 in any unit; a larger value gives a
  // darker shade in the picture. May be empty.
  std::vector<double> separation;
  std::vector<std::string> columns_to_log;
  std::optional<double> max_rpm;
};

// Throws Error if `folder` is a file or is not empty. Call it before doing the work.
void expect_plan_folder(const std::filesystem::path& folder);

// Writes schedule.csv, program.nc, checklist.txt and plan.svg to a new or an empty folder, completely or not at all.
// Throws Error as expect_plan_folder() and iso_program(), and if they cannot be written.
void write_plan(const std::filesystem::path& folder, const PlanContents& contents);

// An SVG of 960 px: title and text; speed of the schedule (and load, room and coolant if set); below them the predicted
// curves of the six hypotheses with the largest p, with a band of one sigma, shaded where they differ. Text is escaped,
// values that are not finite are left out, and a long curve is drawn with 500 points.
std::string plan_picture(const PlanContents& contents);

}  // namespace ballbar
