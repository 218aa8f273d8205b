// `ballbar compensate --on`: what the error would have been with the model on line.
#pragma once

#include <string>

#include "compensate/compensation_options.hpp"

namespace ballbar {

struct ReplayOptions {
  Source data;  // a session, or a series with its signals
  std::vector<std::string> out;
  bool json = false;
};

void compensate_replay(const CompensationOptions& options, const ReplayOptions& replay);

}  // namespace ballbar
