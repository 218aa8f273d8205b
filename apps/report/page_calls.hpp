// The calls from an interactive page to the program. They refer to one subject, which is kept between calls.
#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "report/report_results.hpp"
#include "report/report_subject.hpp"

namespace ballbar {

// A call is an object: "call" with one of the names below, and "words" as behind `ballbar report`, which say what is
// looked at. A subject is opened anew where other data are looked at, a log is read in another way, or a file has
// changed.
//
//   report     the report with the fit, without a search
//   fitted     its parts that the model changes: check, ledger, summary, files, fit of recordings
//   search     the diagnosis: diagnose, summary, fit of recordings
//   hold       the fit with "settings", EFFECT.PARAMETER=VALUE each, in the place of fitted values
//   add        the fit with "effects"; the model's file stays as it was
//   with       the RMSE that "effects" would leave; the model stays
//   change     the fit without the effects "removed", with parameters "held" at EFFECT.PARAMETER=VALUE or "freed" from
//              there; the model's file stays as it was
//   revise     what was added or changed last becomes a revision of the file "model", its sentence, and the ledger; an
//              addition that the data do not support is taken back, but where "keep" is true
//   take_back  what was added or changed last is gone
//   choices    what could be added, with the columns that suit
//   compare    the fits with each of "hypotheses", a list of effects each; the model stays
//   text       the text of the model's file, with fitted values to start from
//   table      all ballbar tests of the files, a row each, as a page; "title": of that page, "tolerance_um": of the
//              circularity, may lack
//   gaps       where a fit is refused for the rows within gaps of signals: the longest gap
//   tests      the ballbar tests among the files, without a fit
//   history    machines over the tests of the files, as the page of `history`; "title": of that page
//
// The answers of fitted, search, add, change and revise are keys of the report, to put in the place of its own.
class PageCalls {
 public:
  // Throws Error as `ballbar report` does, and for a call that is none of these.
  nlohmann::ordered_json answer(const nlohmann::json& call);

 private:
  ReportSubject& subject_of(const nlohmann::json& call);
  TestsReport table_of(const nlohmann::json& call);

  std::unique_ptr<ReportSubject> subject_;
  std::vector<std::string> words_of_tests_;  // what the tests are of
  std::optional<TestsReport> tests_;         // fitted
};

}  // namespace ballbar
