// The errors of a machine from its ballbar files, fitted and as stored, for the terminal, programs and the page.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "ballbar/formats/recordings/b5r.hpp"
#include "ballbar/formats/recordings/recording_file.hpp"
#include "ballbar/formats/recordings/test_folder.hpp"
#include "ballbar/machine_errors/machine_errors.hpp"
#include "ballbar/message.hpp"
#include "errors/feed_forecast.hpp"
#include "errors/tolerance_check.hpp"
#include "measure/recording_fits.hpp"

namespace ballbar {

struct ErrorsOptions {
  bool prior = true;
  bool strict = false;                 // an unreadable file is an error
  std::optional<double> tolerance_um;  // of the circularity
  std::set<std::string> in_the_model;  // effects that the model already has
  StatedCircle circle;                 // for files that do not state it
};

// One group of recordings: one plane and one bar, with any feed.
struct ErrorsReport {
  std::vector<std::string> files;
  std::vector<Recording> recordings;
  std::optional<B5r> b5r;  // the only file, if it is a `.b5r`; its runs are in `recordings`
  MachineErrors found;
  ErrorsOptions options;
};

// A file without readings, by the tolerance and by its limits.
struct StoredAlone {
  ResultsAlone of;
  ToleranceCheck check;
};

struct ErrorsReports {
  std::vector<ErrorsReport> groups;
  std::vector<StoredAlone> results_alone;
  std::vector<SkippedFile> skipped;
  std::vector<std::string> remarks;
};

// Reads and fits the files. Throws Error for an unreadable file if it is the only one, or with `strict`.
ErrorsReports errors_reports_of(const std::vector<Source>& files, const ErrorsOptions& options);

// The members of a group with the value that each would have alone, and why these readings cannot separate them.
Message group_sentence(const ErrorsReport& report, const ErrorGroup& group);

// The stored values of the file for each row and effect.
std::optional<double> stored_value_of(const ErrorsReport& report, const MachineError& error);
std::optional<int> stored_rank_of(const ErrorsReport& report, const RankedError& ranked);

// Whether the stored value equals that of our estimator of the instrument's software, within 0.1 um, 1 um/m, 0.01 ms
// and half of the last printed digit.
std::optional<bool> same_as_stored(const ErrorsReport& report, const MachineError& error);

// The error to correct first: the first rank, else the first significant one; nullptr: none.
const RankedError* first_of(const MachineErrors& found);

// One line for each value that differs from the instrument's by more than 2 sigma and 0.3 um, with the reason.
std::vector<std::string> difference_texts(const ErrorsReport& report);

// Whole sentences: the most important errors, and the residual.
Paragraph conclusion(const ErrorsReport& report);
Paragraph left_sentences(const ErrorsReport& report);

// "named", "equivalent", "unexplained", "nothing": as the other verdicts.
std::string verdict_of(const ErrorsReport& report);

ToleranceCheck check_of(const ErrorsReport& report);

// Of a circularity beyond the tolerance that was given.
std::optional<FeedForecast> forecast_of(const ErrorsReport& report);

// Whether a test of these fails.
bool any_fails(const ErrorsReports& reports);

void print_text(const ErrorsReports& reports, bool details = false);  // details: all rows

}  // namespace ballbar
