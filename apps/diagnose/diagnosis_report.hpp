// What a model lacks, for the terminal, a program and the page.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ballbar/diagnosis/next_test/next_test.hpp"
#include "ballbar/diagnosis/verdict/diagnosis.hpp"
#include "ballbar/workbench/workbench.hpp"
#include "model/model_options.hpp"
#include "model/residual_report.hpp"

namespace ballbar {

struct DiagnoseOptions {
  DiagnosisOptions diagnosis;  // tolerance, seed, most rows
  bool progress = true;        // shown on a terminal
};

// An effect of the model that stood in for others.
struct StandIn {
  std::string effect;   // its label
  std::string by;       // labels of the others
  std::string command;  // that replaces it
};

struct DiagnosisReport {
  ResidualReport residual_report;
  Diagnosis diagnosis;
  std::vector<NextTest> next_tests;
  std::string command;                      // to paste next; empty: none
  bool is_for_plan = false;                 // whether a test of a series would decide more
  std::string plan_command;                 // that plans it; empty: none, or data that nobody can type
  std::optional<Predictability> predicted;  // where something is left that nothing is named for
  std::string train_command;                // that makes what predicts it; empty: not better, or nobody can type it
  std::string hint;                         // what to do where no command does it, a sentence; or empty
  std::vector<StandIn> stand_ins;
  std::vector<std::string> unsupported;  // labels of effects of the model that were kept although no data
                                         // supported them
};

// The effects that were added to the model's file, each a hypothesis again: what stood in for others.
std::vector<StandIn> stand_ins_of(const ModelOptions& options, const DiagnoseOptions& how_to, const Model& model,
                                  const ModelData& data);

// What is searched for, and its progress, which begins with the target.
DiagnosisOptions diagnosis_options(const DiagnoseOptions& how_to, const std::string& target);

// Throws Error, with the file that is at fault.
DiagnosisReport diagnosis_report_of(const ModelOptions& options, Workbench& bench);

// An effect of the diagnosis as a term, with its moment and its held shapes (an exponent) where the search found them.
Term as_diagnosed(const BoundEffect& bound, const Diagnosis& found);

// What the verdict names, or calls probable; empty where it does neither.
const std::vector<BoundEffect>& best_of(const Diagnosis& found);

// The test that would tell what is left open, whole sentences; empty where nothing is left to tell.
std::string next_text(const DiagnosisReport& diagnosis_report);

// What of the model is not supported, a sentence; empty: nothing.
std::string unsupported_text(const DiagnosisReport& report);

// Whether what is left can be predicted, a sentence; empty: not known.
std::string predicted_text(const DiagnosisReport& report);

// The first few, and how many more there are: "A or B or one of 3 more".
std::string labels(const std::vector<BoundEffect>& bounds, std::string_view between);

// What was not searched of the columns that the data offer: "gradient_bending on 16 of 528 choices of columns".
std::string not_searched_text(const Diagnosis& found);

// How much of a diagnosis is printed: a screen, less of each of several targets, or all.
struct TextLength {
  bool details = false;
  std::size_t targets = 1;  // that are printed
};

// The same for the terminal, the verdict first. title: empty: printed already.
void print_text(const DiagnosisReport& diagnosis_report, const std::string& title, const TextLength& length);

// What --details shows, a phrase.
std::string_view details_of_diagnosis();

}  // namespace ballbar
