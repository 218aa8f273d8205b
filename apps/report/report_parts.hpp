// The parts of a report page (report_results.hpp); keys that a command prints with --json are the same here.
#pragma once

#include <string>
#include <vector>

#include "ballbar/drift/drift.hpp"
#include "ballbar/drift/measured_drift.hpp"
#include "ballbar/formats/sessions/data_file.hpp"
#include "ballbar/formats/sessions/session_toml.hpp"
#include "ballbar/series/series.hpp"
#include "diagnose/diagnosis_report.hpp"
#include "measure/fit_result.hpp"
#include "model/residual_report.hpp"
#include "predict/predicted_job.hpp"
#include "report/report_results.hpp"

namespace ballbar {

FitPart recordings_part(const Fitted& fitted);

// With the times of the tests: fitted.recordings are those of session.recordings.
FitPart recordings_part(const Fitted& fitted, const SessionFiles& session);

// What an effect adds to recordings, beside the trace of each: values_um at the rows of a fit to trace_of() the same
// recordings.
void overlay(FitPart& part, const std::string& effect, const std::vector<double>& values_um, const Fit& fit,
             const Series& trace);

// The errors of a machine from each test of two linear axes among these, with the curves that the page draws. One that
// cannot be fitted is a remark.
struct MachineErrorsPart {
  std::vector<MachineErrorsOfTest> tests;
  std::vector<std::string> conclusions;  // one a test
  std::vector<std::string> remarks;
};
MachineErrorsPart machine_errors_part(const Fitted& fitted, const StatedCircle& stated);

// The tests of a plane, those of `after`, by the names of their files, against the others; of several of a plane the
// two that were made most alike. Sentences on those that have no other go to `without`. Throws Error where no two are
// of one plane.
std::vector<ComparedTests> compared_tests_of(const Fitted& fitted, const std::vector<MachineErrorsOfTest>& errors,
                                             const std::vector<std::string>& after, std::vector<std::string>& without);

SignalsPart signals_part(const std::string& source, const Series& series);
CheckPart check_part(const ResidualReport& residual_report, const Model& model, const ModelData& data);
DiagnosisPart diagnosis_part(const DiagnosisReport& diagnosis_report, const ModelData& data);

// What a candidate alone would draw, at the rows of the fit; empty where it cannot be drawn.
std::vector<double> curve_of(const Candidate& candidate, const Fit& fit, const Series& data);

}  // namespace ballbar
