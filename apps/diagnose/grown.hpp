// The last step of `ballbar add --auto`, if no cause can be named: grows the model for prediction (growth.hpp), with a
// few effects per revision.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ballbar/diagnosis/verdict/diagnose.hpp"
#include "ballbar/internal/predict/growth.hpp"
#include "ballbar/model/model.hpp"
#include "ballbar/revision/revision.hpp"
#include "diagnose/revision_results.hpp"
#include "model/model_options.hpp"

namespace ballbar {

struct GrownModel {
  std::string bytes;  // content of the model's file with the revisions
  Growth growth;
  std::optional<Forecasts> train;  // of the regression on all effects, as `train` prints them
  LedgerRow before;
  std::vector<LedgerRow> rows;  // of the revisions
};

// `file`: name in messages. drivers: columns that are known to drive the missing part.
GrownModel grown_model(const std::string& bytes, const std::string& file, const Model& model, const ModelData& data,
                       const std::vector<std::string>& data_names, const std::vector<Driver>& drivers,
                       const Catalogue& catalogue);

// "18 effects predict new rows to 1.8 um RMSE, 20.6 um today ..."; `causes`: labels named earlier.
std::string conclusion(const GrownModel& grown, const std::vector<std::string>& causes,
                       const std::vector<Driver>& drivers);

// For each revision: error, error of forecasts, and the difference from the forecasts of all effects.
std::string tables(const GrownModel& grown, bool details);

// Without further effects, then for each revision.
std::vector<GrowthStep> steps_of(const GrownModel& grown);

}  // namespace ballbar
