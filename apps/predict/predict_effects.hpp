// `ballbar predict` with a regression on effects (effect_regression.hpp).
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace ballbar {

struct EffectPredictOptions {
  std::string data;   // file, session, or - for the standard input
  std::string model;  // file
  std::string state;  // where a live prediction stands; empty: none
  std::vector<std::string> out;
  std::optional<double> max_gap_s;
  bool json = false;
};

bool is_effect_regression(const std::string& model);

void predict_effects(const EffectPredictOptions& options);

}  // namespace ballbar
