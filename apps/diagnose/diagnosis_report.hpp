// The report of a diagnosis, for the terminal, programs and the page.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ballbar/diagnosis/verdict/diagnosis.hpp"
#include "ballbar/machine_errors/next_measurement.hpp"
#include "ballbar/workbench/workbench.hpp"
#include "diagnose/next_command.hpp"
#include "model/model_options.hpp"
#include "model/residual_report.hpp"

namespace ballbar {

struct DiagnoseOptions {
  DiagnosisOptions diagnosis;  // tolerance, most rows
  bool progress = true;        // show progress on a terminal
};

// An effect of the model that other effects replace.
struct StandIn {
  std::string effect;   // its label
  std::string by;       // labels of the others
  std::string command;  // that replaces it
};

// What the columns of the most probable set predict better than a regression on all effects.
struct PredictedByColumns {
  std::vector<std::string> columns;  // an effect without columns: its name
  double left_out_um = 0.0;          // RMSE in left-out cycles, with the set
  // Without it; nullopt: more than the range of the readings, so that it says nothing.
  std::optional<double> model_left_out_um;
};

struct DiagnosisReport {
  ResidualReport residual_report;
  Diagnosis diagnosis;
  std::optional<NextMeasurement> next_measurement;  // of recordings: that would separate the effects in question
  std::string command;                              // the next command; empty: none
  std::optional<NextAction> next_action;            // what it does, or what else is to do; nullopt: nothing
  bool is_for_plan = false;                         // whether another test of the series could decide more
  std::string plan_command;                         // plans such a test; empty: none, or the data have no name
  std::optional<Predictability> predicted;          // if a part remains unexplained
  std::optional<PredictedByColumns> predicted_by;   // likewise, and the columns predict better than the regression
  std::string train_command;                        // trains a predictor; empty: not better, or the data have no name
  std::string hint;                                 // a sentence, if the next step is not a command; or empty
  std::vector<StandIn> stand_ins;
  std::vector<std::string> unsupported;  // labels of effects of the model that no data
                                         // supported
};

// Examines the effects that were added to the model's file again: those that other effects replace.
std::vector<StandIn> stand_ins_of(const ModelOptions& options, const DiagnoseOptions& how_to, const Model& model,
                                  const ModelData& data);

// The options of the search, with progress texts that begin with the target.
DiagnosisOptions diagnosis_options(const DiagnoseOptions& how_to, const std::string& target);

// Throws Error with the faulty file.
DiagnosisReport diagnosis_report_of(const ModelOptions& options, Workbench& bench);

// An effect of the diagnosis as a term, with its onset, its period and its held shapes (an exponent) at the values of
// the search.
Term as_diagnosed(const BoundEffect& bound, const Diagnosis& found);

// The named or probable effects of the verdict; empty: none.
const std::vector<BoundEffect>& best_of(const Diagnosis& found);

// Whole sentences: the test that could decide the open question; empty: no open question.
std::string next_text(const DiagnosisReport& diagnosis_report);

// One sentence: the effects of the model that are not supported; empty: none.
std::string unsupported_text(const DiagnosisReport& report);

// One sentence: whether the unexplained part can be predicted; empty: not known.
std::string predicted_text(const DiagnosisReport& report);

// The first few, and how many more there are: "A or B or one of 3 more".
std::string labels(const std::vector<BoundEffect>& bounds, std::string_view between);

// The effects whose column choices were not all searched: "gradient_bending on 16 of 528 choices of columns".
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
