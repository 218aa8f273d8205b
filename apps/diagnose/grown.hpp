// What `ballbar add --auto` does where no cause can be named: a model grown to predict (growth.hpp), a revision an
// effect.
#pragma once

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
  LedgerRow before;
  std::vector<LedgerRow> rows;  // of the revisions
};

// `file`: name in messages. drivers: columns that are known to drive what is missing.
GrownModel grown_model(const std::string& bytes, const std::string& file, const Model& model, const ModelData& data,
                       const std::vector<std::string>& data_names, const std::vector<Driver>& drivers);

// "From 8.52 to 0.56 um with 12 effects, 2.72 um expected on new cycles ..."; `causes`: labels that were named before.
std::string conclusion(const GrownModel& grown, const std::vector<std::string>& causes,
                       const std::vector<Driver>& drivers);

// Revision by revision: error, forecasts, and what a surrogate would have bought.
std::string tables(const GrownModel& grown);

// With no effect more, with one, and so on.
std::vector<GrowthStep> steps_of(const GrownModel& grown);

}  // namespace ballbar
