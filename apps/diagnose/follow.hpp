// `ballbar diagnose --follow`: repeated diagnosis of a growing log.
#pragma once

#include <optional>

#include "diagnose/diagnosis_report.hpp"
#include "model/model_options.hpp"

namespace CLI {
class App;
}

namespace ballbar {

struct FollowOptions {
  bool follow = false;
  std::optional<double> planned_hours;
  std::optional<double> every_s;     // interval of checks of the file; nullopt: 1
  std::optional<double> patience_s;  // end if no rows arrive for so long
  bool keep = false;                 // continue after a decision or stop
};

void add_follow_options(CLI::App& command, FollowOptions& options);

// Throws CLI::ValidationError if one of these options is given without --follow.
void expect_follow(const FollowOptions& options);

// Prints one row per look on the standard output (with json one line of JSON), then the decision. Ends when a decision
// is made or impossible, at the end of the standard input, and on SIGINT or SIGTERM. Throws Error for more than one
// file or target, and the errors of GrowingLog and of opening DATA and the model.
void follow(const ModelOptions& model, const DiagnoseOptions& how, const FollowOptions& options, bool json);

}  // namespace ballbar
