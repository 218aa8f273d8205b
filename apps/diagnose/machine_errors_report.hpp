// The errors of a machine from its ballbar files: fitted, beside what the files store, for the terminal, a program and
// the page.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "ballbar/formats/recordings/b5r.hpp"
#include "ballbar/formats/recordings/recording_file.hpp"
#include "ballbar/formats/recordings/test_folder.hpp"
#include "ballbar/machine_errors/machine_errors.hpp"

namespace ballbar {

struct ErrorsOptions {
  bool prior = true;
  bool strict = false;                 // a file that cannot be read ends all
  std::optional<double> tolerance_um;  // of the circularity
  std::set<std::string> in_the_model;  // effects that a model has already
  StatedCircle circle;                 // of files that do not state theirs
};

// One group of recordings: those of one plane and one bar, whatever their feed.
struct ErrorsReport {
  std::vector<std::string> files;
  std::vector<Recording> recordings;
  std::optional<B5r> b5r;  // of the only file, where it is a `.b5r`; its runs are in `recordings`
  MachineErrors found;
  ErrorsOptions options;
};

// A file that stores results without readings: those that are valid.
struct StoredAlone {
  std::string file;
  std::vector<StoredFeature> stored;
};

struct ErrorsReports {
  std::vector<ErrorsReport> groups;
  std::vector<StoredAlone> results_alone;
  std::vector<SkippedFile> skipped;
  std::vector<std::string> remarks;
};

// Reads and fits. Throws Error where a file cannot be read and is the only one, or with `strict`.
ErrorsReports errors_reports_of(const std::vector<Source>& files, const ErrorsOptions& options);

// What stands in the file about each row and effect.
std::optional<double> stored_value_of(const ErrorsReport& report, const MachineError& error);
std::optional<int> stored_rank_of(const ErrorsReport& report, const RankedError& ranked);

// Whether the file stores what our estimator of the instrument's software says: within 0.1 um, 1 um/m, 0.01 ms and half
// of the digit it is printed with.
std::optional<bool> same_as_stored(const ErrorsReport& report, const MachineError& error);

// The one to mend first: the first rank, else the first that is significant; nullptr: none.
const RankedError* first_of(const MachineErrors& found);

// Where ours and the instrument's value differ by more than 2 sigma and 0.3 um: both, and what makes the difference. A
// line each.
std::vector<std::string> difference_texts(const ErrorsReport& report);

// Whole sentences: what is out most, and what is left.
std::string conclusion(const ErrorsReport& report);
std::string left_text(const ErrorsReport& report);

// "named", "unexplained", "nothing": as the other verdicts.
std::string verdict_of(const ErrorsReport& report);

// "pass: circularity 6.6 um, at most 10 um": of the tolerance that was given, else of the limits in the file; one a
// line.
std::vector<std::string> tolerance_texts(const ErrorsReport& report);

void print_text(const ErrorsReports& reports, bool details = false);  // details: all rows

}  // namespace ballbar
