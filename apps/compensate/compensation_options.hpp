// What runs live: models, their axes and the limits of the offsets. Shared by `ballbar compensate` and `ballbar-hal`.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "ballbar/compensation/compensation.hpp"
#include "ballbar/formats/models/compensation_state.hpp"
#include "ballbar/formats/text/file_lock.hpp"
#include "model/model_options.hpp"

namespace CLI {
class App;
}

namespace ballbar {

struct CompensationOptions {
  std::vector<Source> models;
  std::vector<std::string> axes;  // names, one a target; empty: the targets' own
  std::vector<Source> fit;        // DATA
  ModelOptions fitting;           // how
  CompensationLimits limits;
  std::string state;  // file; empty: none
};

void add_compensation_options(CLI::App& command, CompensationOptions& options);

// One axis a target of the models, in order; with --fit fitted to DATA, its values held and its columns' ranges stated.
// Throws Error, with the file: a parameter that is free without --fit, a regression on effects with it, as many axes as
// targets not given.
std::vector<CompensatedAxis> axes_of(const CompensationOptions& options);

// Whether the parameters come from the data that they are judged by; and that as a sentence, or that it is not known.
bool is_in_sample(const CompensationOptions& options, const std::vector<std::filesystem::path>& files);
std::string parameters_text(const CompensationOptions& options, const std::vector<std::filesystem::path>& files);

// The state's file, read at the start and written as the counts change, by no other program meanwhile.
class KeptState {
 public:
  // Takes the axes to where the file says they stood; nothing where there is no file. Throws Error where it is that of
  // other axes or models, and where another program keeps it.
  KeptState(const std::string& file, const std::vector<CompensatedAxis>& axes, CompensatedAxes& machine);

  bool resumed() const { return resumed_; }

  // How much of these signals had been taken when the state was written; 0 where it was of others.
  std::uint64_t bytes_of(const std::optional<SignalsPlace>& signals) const;

  // Writes where counts have changed since it was written last, or after `at_least_s` of real time. Throws Error where
  // the first one cannot be written; later ones are said, once.
  void keep(const CompensatedAxes& machine, const std::optional<SignalsPlace>& signals, double at_least_s);

 private:
  std::string file_;
  std::optional<FileLock> lock_;
  std::vector<std::string> models_;  // a digest each
  std::vector<std::int64_t> counts_;
  std::optional<SignalsPlace> signals_;
  double written_s_ = 0.0;
  bool resumed_ = false;
  bool written_ = false, failed_ = false;
};

}  // namespace ballbar
