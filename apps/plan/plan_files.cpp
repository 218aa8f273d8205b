#include "plan/plan_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "ballbar/error.hpp"
#include "ballbar/formats/schedules/check_list.hpp"
#include "ballbar/formats/schedules/dry_run.hpp"
#include "ballbar/formats/schedules/schedule_csv.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "ballbar/formats/text/new_folder.hpp"

namespace ballbar {
namespace {

constexpr const char* kSchedule = "schedule.csv";

bool holds_a_plan(const std::filesystem::path& folder) {
  try {
    read_schedule_csv(read_bytes(folder / kSchedule, kLargestText), kSchedule);
    return true;
  } catch (const Error&) {  // none, or one that is not ours
    return false;
  }
}

// What is handed to a machine has been read back: the speeds and dwells of the schedule, and nothing else.
void expect_driven(const Schedule& schedule, const DryRun& run, Dialect dialect) {
  const std::vector<Dwell> expected = driven_dwells(schedule);
  const bool same = std::equal(run.dwells.begin(), run.dwells.end(), expected.begin(), expected.end(),
                               [](const Dwell& left, const Dwell& right) {
                                 return left.duration_s == right.duration_s && left.speed_rpm == right.speed_rpm;
                               });
  if (!same) throw std::logic_error(fmt::format("the program for {} is not the schedule", name_of(dialect)));
}

}  // namespace

std::vector<std::pair<std::string, std::string>> plan_files(const PlanContents& contents) {
  ProgramOptions options = contents.options;
  if (options.title.empty()) options.title = contents.title;
  std::vector<std::pair<std::string, std::string>> files{{kSchedule, write_schedule_csv(contents.schedule)}};
  for (const Dialect dialect : kDialects) {
    std::string program = spindle_program(contents.schedule, dialect, options);
    expect_driven(contents.schedule, dry_run_of(program, dialect, file_name_of(dialect)), dialect);
    files.emplace_back(file_name_of(dialect), std::move(program));
  }
  files.emplace_back("checklist.txt",
                     check_list(contents.schedule, contents.options, contents.columns_to_log, contents.title));
  files.emplace_back("plan.svg", plan_picture(contents));
  return files;
}

void expect_plan_folder(const std::filesystem::path& folder) {
  if (holds_a_plan(folder)) {
    throw Error(fmt::format(
        "{}: expected a new or an empty folder, found one that holds a plan; name another, or remove this one.",
        folder.string()));
  }
  expect_new_folder(folder);
}

void write_plan(const std::filesystem::path& folder, const PlanContents& contents) {
  expect_plan_folder(folder);
  write_folder(folder, plan_files(contents));
}

}  // namespace ballbar
