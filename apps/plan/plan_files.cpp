#include "plan/plan_files.hpp"

#include <fmt/format.h>

#include "ballbar/error.hpp"
#include "ballbar/formats/schedules/check_list.hpp"
#include "ballbar/formats/schedules/iso_program.hpp"
#include "ballbar/formats/schedules/schedule_csv.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "ballbar/formats/text/new_folder.hpp"

namespace ballbar {
namespace {

constexpr const char* kSchedule = "schedule.csv";

bool holds_a_plan(const std::filesystem::path& folder) {
  try {
    return read_bytes(folder / kSchedule, kLargestText).starts_with("# format = \"ballbar-schedule");
  } catch (const Error&) {  // none
    return false;
  }
}

}  // namespace

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
  write_folder(folder, {{kSchedule, write_schedule_csv(contents.schedule)},
                        {"program.nc", iso_program(contents.schedule, contents.title, contents.max_rpm)},
                        {"checklist.txt", check_list(contents.schedule, contents.columns_to_log, contents.title)},
                        {"plan.svg", plan_picture(contents)}});
}

}  // namespace ballbar
