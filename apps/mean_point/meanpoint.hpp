// Where one sensor should sit so that it tells the axial elongation: `ballbar compensate --from-picture`.
#pragma once

#include <string>

#include "mean_point/mean_point_states.hpp"

namespace ballbar {

struct MeanpointArguments {
  MeanPointOptions of;
  std::string out, plot;  // empty: none
  bool json = false;
};

// Prints the places and writes what is asked for. Throws Error with the file or the option that is at fault.
void show_mean_points(const MeanpointArguments& options);

}  // namespace ballbar
