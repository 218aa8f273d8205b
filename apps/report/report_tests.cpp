// All ballbar tests of a folder, a row each.
#include <algorithm>
#include <array>
#include <iterator>
#include <string_view>
#include <utility>

#include "ballbar/error.hpp"
#include "errors/tolerance_check.hpp"
#include "measure/recording_fits.hpp"
#include "report/report_data.hpp"
#include "report/report_results.hpp"

namespace ballbar {
namespace {

constexpr std::array<std::string_view, 8> kShown{"g_ccw_um",    "g_cw_um",      "bidirectional_2005_um",
                                                 "d_um",        "f_max_ccw_um", "f_min_ccw_um",
                                                 "f_max_cw_um", "f_min_cw_um"};

std::vector<Compared> shown_of(const std::vector<Compared>& results) {
  std::vector<Compared> shown;
  std::copy_if(results.begin(), results.end(), std::back_inserter(shown),
               [](const Compared& one) { return std::find(kShown.begin(), kShown.end(), one.key) != kShown.end(); });
  return shown;
}

// Of the first pair of its recordings, else of the only direction.
std::vector<Compared> numbers_of(const MachineTest& test, const StatedCircle& stated) {
  std::vector<Source> files{test.file};
  if (!test.second_file.empty()) files.emplace_back(test.second_file);
  try {
    const Fitted fitted = fit_files(files, {}, Faults::end_all, stated);
    if (!fitted.pairs.empty()) return shown_of(fitted.pairs.front().results);
    if (!fitted.results_alone.empty()) return shown_of(stored_iso(fitted.results_alone.front().b5r));
    for (const FittedRecording& one : fitted.recordings) {
      for (const Compared& result : one.results) {
        if (result.key != "circularity_um") continue;
        Compared alone = result;
        alone.key = one.recording.direction == Direction::CW ? "g_cw_um" : "g_ccw_um";
        return {alone};
      }
    }
  } catch (const Error&) {  // the test is fitted: its other columns are worth showing
  }
  return {};
}

// By the limits of its file alone: of the numbers that are shown, and of those that it stores.
std::optional<bool> within_limits(const TestRow& row) {
  if (!row.test.beyond_limits.empty()) return false;
  std::optional<bool> passes;
  for (const Compared& one : row.numbers) {
    if (!one.judgement) continue;
    if (*one.judgement == Judgement::fail) return false;
    passes = true;
  }
  return passes;
}

}  // namespace

TestsReport tests_report(const std::string& title, const std::vector<std::string>& files, const StatedCircle& stated) {
  TestFiles found = read_tests(files, false, stated);
  TestsReport report{report_head(title), {{}, std::move(found.skipped), std::move(found.remarks), {}}};
  for (MachineTest& test : found.tests) {
    std::vector<Compared> numbers = numbers_of(test, stated);
    report.rows.tests.push_back({std::move(test), std::move(numbers), {}});
  }
  for (const std::filesystem::path& file : found.files) report.head.files.push_back(file_name(file));
  return report;
}

TestsReport judged(TestsReport report, std::optional<double> tolerance_um) {
  report.rows.tolerance_um = tolerance_um;
  for (TestRow& row : report.rows.tests)
    row.passes = tolerance_um ? passes(row.test, *tolerance_um) : within_limits(row);
  return report;
}

}  // namespace ballbar
