// What a report is to be of.
#pragma once

#include <string>

#include "diagnose/diagnosis_report.hpp"
#include "measure/five_probe_drift.hpp"
#include "model/model_options.hpp"

namespace ballbar {

struct ReportRequest {
  ModelOptions model;
  Source compare;  // another drift; empty: none
  FiveProbeOptions probes;
  DiagnoseOptions how;
  bool diagnose = false;      // without a model too
  bool no_diagnosis = false;  // with one neither
  bool anyway = false;        // a model of `train` though a sensor looks broken
};

void add_report_options(CLI::App& command, ReportRequest& request);

}  // namespace ballbar
