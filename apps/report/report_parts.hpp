// The parts of a report page as JSON. apps/page/src/report.ts lists the keys; those that a command prints with --json
// are the same here.
#pragma once

#include <nlohmann/json.hpp>
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
#include "predict/predict_batch.hpp"

namespace ballbar {

// Seven digits: what a picture and its numbers need of a reading, at half the size.
nlohmann::ordered_json bulk(const std::vector<double>& values);

nlohmann::ordered_json recordings_part(const Fitted& fitted);

// With the times of the tests: fitted.recordings are those of session.recordings.
nlohmann::ordered_json recordings_part(const Fitted& fitted, const SessionFiles& session);

// What an effect adds to recordings, beside the trace of each: values_um at the rows of a fit to trace_of() the same
// recordings.
void overlay(nlohmann::ordered_json& recordings, const std::string& effect, const std::vector<double>& values_um,
             const Fit& fit, const Series& trace);

// The errors of a machine from each test of two linear axes among these, with the curves that the page draws. One that
// cannot be fitted is a remark.
struct MachineErrorsPart {
  nlohmann::ordered_json tests;
  std::vector<std::string> conclusions;  // one a test
  std::vector<std::string> remarks;
};
MachineErrorsPart machine_errors_part(const Fitted& fitted, const StatedCircle& stated);

nlohmann::ordered_json probes_part(const MeasuredDrift& drift);
nlohmann::ordered_json signals_part(const std::string& source, const Series& series);
nlohmann::ordered_json check_part(const ResidualReport& residual_report, const Model& model, const ModelData& data);
nlohmann::ordered_json diagnosis_part(const DiagnosisReport& diagnosis_report, const ModelData& data);

// What a candidate alone would draw, at the rows of the fit; empty where it cannot be drawn.
std::vector<double> curve_of(const Candidate& candidate, const Fit& fit, const Series& data);
nlohmann::ordered_json batch_part(const BatchJob& job);

}  // namespace ballbar
