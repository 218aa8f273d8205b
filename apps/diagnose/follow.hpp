// `ballbar diagnose --follow`: a diagnosis again and again while a log grows.
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
  std::optional<double> every_s;     // between looks at the file; without: 1
  std::optional<double> patience_s;  // ends where nothing came for so long
  bool keep = false;                 // goes on once it is decided, or will not be
};

void add_follow_options(CLI::App& command, FollowOptions& options);

// Throws CLI::ValidationError where one of them is given without --follow.
void expect_follow(const FollowOptions& options);

// A row a look on the standard output (with json a line of JSON each), then what is decided. Ends where that is so, or
// it will not be; with the standard input; with SIGINT or SIGTERM. Throws Error: more than one file or target, what
// GrowingLog throws, what opening DATA and its model throws.
void follow(const ModelOptions& model, const DiagnoseOptions& how, const FollowOptions& options, bool json);

}  // namespace ballbar
