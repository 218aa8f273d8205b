// What a page asks of the program while a person works with it: calls upon one subject, which is kept from call to
// call.
#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "report/report_subject.hpp"

namespace ballbar {

// A call is an object: "call" with one of the names below, and "words" as behind `ballbar report`, which say what is
// looked at. A subject is opened anew where other data are looked at, a log is read in another way, or a file has
// changed.
//
//   report     the report with the fit, without a search
//   fitted     its parts that the model changes: check, ledger, summary, files, fit of recordings
//   search     what is missing: diagnose, summary, fit of recordings
//   hold       the fit with "settings", EFFECT.PARAMETER=VALUE each, in the place of fitted values
//   add        the fit with "effects"; the model's file stays as it was
//   with       the RMSE that "effects" would leave; the model stays
//   revise     what was added last becomes a revision of the file "model", if the data support it or "keep" is true,
//              and is taken back if not: its sentence, and the ledger
//   take_back  what was added last is gone
//   with_values  the text of the model's file with what is fitted as the start of the next fit
//   tests      the ballbar tests among the files, without a fit
//   history    machines over the tests of the files, as the page of `history`; "title": of that page
//
// The answers of fitted, search, add and revise are keys of the report, to put in the place of its own.
class PageCalls {
 public:
  // Throws Error as `ballbar report` does, and for a call that is none of these.
  nlohmann::ordered_json answer(const nlohmann::json& call);

 private:
  ReportSubject& subject_of(const nlohmann::json& call);

  std::unique_ptr<ReportSubject> subject_;
};

}  // namespace ballbar
