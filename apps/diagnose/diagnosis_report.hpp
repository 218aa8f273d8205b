// What a model lacks, for the terminal, a program and the page.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "ballbar/diagnosis/next_test/next_test.hpp"
#include "ballbar/diagnosis/verdict/diagnosis.hpp"
#include "model/model_options.hpp"
#include "model/residual_report.hpp"

namespace ballbar {

struct DiagnoseOptions {
  double tolerance_um = 0.0;
  std::uint64_t seed = 1;
  std::size_t most_rows = 1500;
  bool progress = true;  // told on a terminal
};

struct DiagnosisReport {
  ResidualReport residual_report;
  Diagnosis diagnosis;
  std::vector<NextTest> next_tests;
  std::size_t surrogates = 0;  // tried of each effect
};

DiagnosisReport diagnosis_report_of(const ModelOptions& options, const DiagnoseOptions& how_to, const Model& model,
                                    const ModelData& data, std::size_t target);

// The verdict in words, whole sentences.
std::string verdict_text(const Diagnosis& found);

// "Next test: ..."; empty where nothing is left to tell.
std::string next_text(const DiagnosisReport& diagnosis_report);

// "0.4 %"
std::string chance_text(double p);

// The keys of `diagnose --json`.
nlohmann::ordered_json json_of(const DiagnosisReport& diagnosis_report);

}  // namespace ballbar
