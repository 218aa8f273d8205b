// A model held against data, as `check` and `diagnose` show it.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "ballbar/fit/fit.hpp"
#include "ballbar/fit/residual.hpp"
#include "model/model_options.hpp"

namespace ballbar {

struct ResidualReport {
  Fit fit;
  std::vector<Misfit> where;
  Whiteness whiteness;
};
ResidualReport residual_report_of(const ModelOptions& options, const Model& model, const ModelData& data,
                                  std::size_t target);

// "z_um, 6669 values over 27.8 h"
std::string heading(const Fit& fit);

// The three sentences, wrapped.
void print_sentences(const ResidualReport& residual_report);

// RMSE, the floor and where it comes from, how many values are independent.
std::string floor_text(const Fit& fit);

// Enough that a residual of this size shows two digits.
int decimals_of(double rmse_um);

bool has_floor(const Fit& fit);

// The keys of `check --json`.
nlohmann::ordered_json json_of(const ResidualReport& residual_report);

}  // namespace ballbar
