// Tests whether an effect could be detected in data: adds it and diagnoses the result.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ballbar/diagnosis/injection/injection.hpp"
#include "model/model_options.hpp"

namespace ballbar {

struct InjectionOptions {
  std::string effect;                  // as `add` takes it
  std::optional<double> amplitude_um;  // range (max - min); nullopt: that from which it should be named
  std::vector<std::string> shapes;     // NAME=VALUE
  std::string out;                     // .csv; empty: none
};

// The verdicts with and without it, and the smallest detected amplitude. Throws Error: several targets, an effect that
// the model has or for which the data have no columns, --out with recordings.
void show_injection(const InjectionOptions& options, const ModelOptions& of, const Model& model, const ModelData& data,
                    bool json);

}  // namespace ballbar
