// What `ballbar train` is told, the recorded tests that it works on, and its ways to train.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "ballbar/formats/text/source.hpp"
#include "ballbar/predict/train.hpp"
#include "ballbar/series/series.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar {

struct TrainOptions {
  std::vector<Source> data;  // runs.csv; with `effects` series or sessions, too
  std::string target;        // empty: the only measured column
  std::optional<std::string> room;
  InputKind inputs = InputKind::temperature;
  std::vector<std::string> without, without_sensor;
  bool keep_broken = false;

  std::optional<RegressionMethod> method;
  std::optional<std::size_t> components;
  std::optional<double> share, penalty_K2;
  std::string model;  // of effects: to compare with, or whose effects are named
  std::string start;  // a trained model of effects, .json
  bool effects = false, few = false;
  std::optional<std::size_t> sensors;  // as many temperatures are chosen
  std::optional<double> max_gap_s;

  Source job;  // --for: a series of its temperatures; with the target, the prediction is checked

  std::string out;  // .json; empty: no model is written
  bool details = false, json = false;

  [[nodiscard]] std::string title() const;  // of the data, for messages
  // A batch of the list, read as the options of logs say.
  [[nodiscard]] Source batch(const std::filesystem::path& file) const { return data.front().like(file); }
};

// Whether the data are a list of batches, by the first column of the file.
bool lists_batches(const std::vector<Source>& data);

struct OpenedBatches {
  BatchColumns columns;
  std::vector<Batch> batches;
  std::vector<std::filesystem::path> files;  // of the batches, same order; then the list
  std::vector<std::string> remarks;          // whole sentences: sensors left out, steps of the target
};

// Every batch is read, condensed and let go. The job is left out where it is listed too. Throws Error with the file:
// columns that differ from the first batch's, a batch to leave out that is not listed, as batch_columns and batch_of.
OpenedBatches open_batches(const TrainOptions& options);

// `says_how`: a log was read.
Series read_batch(const Source& source, const std::optional<double>& max_gap_s, bool says_how = false);

// The only measured column, where the options name none. Throws Error.
std::string target_of(const TrainOptions& options, const Series& run);

// One method with the settings it is trained with.
struct Contender {
  std::string label;            // "pcr, 7 components"
  RegressionSettings settings;  // of a regression on temperatures
  HeldOutErrors held_out;       // of batches left out
  std::string worst;            // name of the worst of them; empty: not known
  double rmse_um = 0.0;         // of all batches, trained on
  bool taken = false;
};

Contender contender_of(const OpenedBatches& opened, const RegressionSettings& settings);

// The table, and what its columns are.
std::string contest_text(const std::vector<Contender>& contenders);

// One line or more each; empty where there are none.
ScreenPart remarks_part(const std::vector<std::string>& remarks);

// Prints what `train --effects` prints, and writes the model. Throws Error with the file that is at fault, as the next.
void train_effects(const TrainOptions& options);

// Leaves of the temperatures of the runs those that are chosen, at most `most`.
SensorChoice keep_chosen_sensors(std::vector<Series>& runs, const std::string& target, std::size_t most);

// What is said of a regression on the chosen sensors is what the choice has tested: its errors, and of the sensors
// which are needed and which will do in place of which.
void take_tests_of(const SensorChoice& choice, TrainedRegression& trained);

// The conclusion, errors by number of sensors, and what each of the chosen ones is worth.
std::vector<ScreenPart> sensor_choice_parts(const SensorChoice& choice, const std::string& target,
                                            const std::string& unit, bool predicted, bool details);

// Prints the batches by their likeness to the job and what they predict, weighted by it and all alike; writes the model
// with weights.
void train_for_job(const TrainOptions& options);

}  // namespace ballbar
