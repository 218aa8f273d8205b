// `ballbar train DATA --effects`: a regression on the effects of the catalogue (effect_regression.hpp).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ballbar/formats/text/source.hpp"
#include "batches/batches.hpp"

namespace ballbar {

// A regression over batches in the same contest.
struct OtherMethod {
  std::string label;
  double left_out_um = 0.0, worst_um = 0.0;
  std::string worst;
  double trained_um = 0.0;
};

struct TrainEffectsOptions {
  Source data;  // list of runs, series or session
  std::string target;
  std::vector<std::string> without, without_sensor;
  std::optional<double> max_gap_s;
  bool few = false;
  std::string out;
  bool json = false;
};

// Whether it is a list of runs, by its first column.
bool is_run_list(const Source& source);

// others: none where the data are no list. files, remarks: of the list, what was opened and what was left out.
void train_effects(const TrainEffectsOptions& options, const std::vector<std::filesystem::path>& files,
                   const std::vector<OtherMethod>& others, const std::vector<std::string>& remarks);

}  // namespace ballbar
