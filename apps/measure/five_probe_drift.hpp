// `ballbar drift` of five probes: what it prints and writes.
#pragma once

#include <string>
#include <vector>

#include "ballbar/drift/five_probes.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

struct FiveProbeReport {
  std::string title;
  Series series;
  FivePointOptions how;
  std::vector<std::string> out;
  bool json = false;
};

void report_five_probe(const FiveProbeReport& report);

}  // namespace ballbar
