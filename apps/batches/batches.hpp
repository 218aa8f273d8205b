// The recorded batches that `train` works on.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "ballbar/batches/batch_selection.hpp"
#include "ballbar/formats/text/source.hpp"
#include "ballbar/series/series.hpp"

namespace CLI {
class App;
}

namespace ballbar {

struct BatchOptions {
  Source list;  // runs.csv
  std::string target;
  std::optional<std::string> room;
  std::size_t inputs = 0;  // of InputKind
  std::vector<std::string> without, without_sensor;
  Source job;  // file of the job at hand: left out where it is listed too
  bool keep_broken = false;
};

// RUNS and what is said of its columns.
void add_batch_options(CLI::App& command, BatchOptions& options);

// --method; nothing: none was asked for.
void add_method_option(CLI::App& command, std::optional<std::size_t>& method, const std::string& otherwise);

struct OpenedBatches {
  BatchColumns columns;
  std::vector<Batch> batches;
  std::vector<std::filesystem::path> files;  // of the batches, same order; then the list
  std::vector<std::string> remarks;          // whole sentences: sensors left out, steps of the target
};

// Every batch is read, condensed and let go. Throws Error with the file: columns that differ from the first batch's, a
// batch to leave out that is not listed, as batch_columns and batch_of.
OpenedBatches open_batches(const BatchOptions& options);

Series read_batch(const Source& source);

}  // namespace ballbar
