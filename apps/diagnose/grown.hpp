// What `ballbar add --auto` does where no cause can be named: a model grown to predict (growth.hpp), a few effects
// a revision.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ballbar/diagnosis/verdict/diagnosis.hpp"
#include "ballbar/model/model.hpp"
#include "ballbar/predict/growth.hpp"
#include "ballbar/revision/ledger.hpp"
#include "diagnose/revision_results.hpp"
#include "model/model_options.hpp"

namespace ballbar {

struct GrownModel {
  std::string bytes;  // of the model's file, with the revisions
  Growth growth;
  std::optional<Forecasts> train;  // of the regression on all effects, as `train` prints them
  LedgerRow before;
  std::vector<LedgerRow> rows;  // of the revisions
};

// `file`: name in messages. drivers: columns that are known to drive what is missing.
GrownModel grown_model(const std::string& bytes, const std::string& file, const Model& model, const ModelData& data,
                       const std::vector<std::string>& data_names, const std::vector<Driver>& drivers);

// "18 effects predict new rows to 1.8 um RMSE, 20.6 um today ..."; `causes`: labels that were named before.
std::string conclusion(const GrownModel& grown, const std::vector<std::string>& causes,
                       const std::vector<Driver>& drivers);

// Revision by revision: error, forecasts, and how far these are from those of all effects.
std::string tables(const GrownModel& grown, bool details);

// Without a further effect, then of each revision.
std::vector<GrowthStep> steps_of(const GrownModel& grown);

}  // namespace ballbar
