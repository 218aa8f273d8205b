// The folder of a plan: what a shop needs to run a test.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "plan/plan_contents.hpp"

namespace ballbar {

// Name and bytes of each file: schedule.csv, the program of each control, checklist.txt, plan.svg. Throws Error as
// spindle_program.
std::vector<std::pair<std::string, std::string>> plan_files(const PlanContents& contents);

// Throws Error where `folder` is a file or holds anything, another plan too: to be called before the work is done.
void expect_plan_folder(const std::filesystem::path& folder);

// Writes them to a new or an empty folder, all or nothing. Throws Error as both, and where they cannot be written.
void write_plan(const std::filesystem::path& folder, const PlanContents& contents);

}  // namespace ballbar
