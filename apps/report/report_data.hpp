// The parts of a report about the data, without a model.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "ballbar/formats/recordings/recording_file.hpp"
#include "ballbar/formats/sessions/data_file.hpp"
#include "diagnose/diagnosis_report.hpp"
#include "measure/five_probe_drift.hpp"
#include "model/model_options.hpp"
#include "report/report_results.hpp"

namespace ballbar {

// What a report is to be of.
struct ReportRequest {
  ModelOptions model;
  std::vector<Source> compare;  // another drift; or the tests after those of the data
  FiveProbeOptions probes;
  DiagnoseOptions how;
  bool diagnose = false;      // without a model too
  bool no_diagnosis = false;  // with one neither
  bool anyway = false;        // a model of `train` though a sensor looks broken
};

void add_report_options(CLI::App& command, ReportRequest& request);

// A report as it grows, with all files that it is made of.
struct Report {
  PageReport page;
  std::vector<std::filesystem::path> files;
  std::vector<SkippedFile> skipped;

  void conclude(Paragraph sentences) { page.head.summary.push_back(std::move(sentences)); }
};

// Of a part that the first thing in it makes.
template <class Part>
Part& value_of(std::optional<Part>& part) {
  return part ? *part : part.emplace();
}

// A page is mailed: where its files lay stays at home.
std::string file_name(const std::filesystem::path& path);

struct ReportData {
  Report report;
  std::shared_ptr<const ModelData> for_model;  // null: there is no model of effects, and none is asked for
};

// The data are opened once. Of folders and archives the request has the files in them from here on. Throws Error, and
// CLI::ValidationError where an option would do nothing.
ReportData report_data(ReportRequest& options);

}  // namespace ballbar
