// What `simulate --json` prints.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "ballbar/formats/results/result_type.hpp"

namespace ballbar {

struct SimulatedRun {
  std::string method;
  MayLack<std::size_t> rows, tests;
  std::uint64_t seed = 0;
  std::string folder;
  std::vector<std::string> files;
  std::string truth;
};

template <>
struct ResultType<SimulatedRun> {
  static constexpr std::string_view name = "Simulated";
  static constexpr std::string_view meaning = "What was simulated.";
  static constexpr std::tuple fields{Field{"method", &SimulatedRun::method, "of the session; series: of a series"},
                                     Field{"rows", &SimulatedRun::rows, "of a series"},
                                     Field{"tests", &SimulatedRun::tests, "of a session"},
                                     Field{"seed", &SimulatedRun::seed, "of the noise"},
                                     Field{"folder", &SimulatedRun::folder, "that was written"},
                                     Field{"files", &SimulatedRun::files, "in it"},
                                     Field{"truth", &SimulatedRun::truth, "file of the truth, beside the folder"}};
};

struct SimulatedFleet {
  std::size_t machines = 0, months = 0;
  std::uint64_t seed = 0;
  std::string folder;
  std::size_t files = 0;
  std::string truth;
};

template <>
struct ResultType<SimulatedFleet> {
  static constexpr std::string_view name = "SimulatedFleet";
  static constexpr std::string_view meaning = "A plant that was simulated.";
  static constexpr std::tuple fields{Field{"machines", &SimulatedFleet::machines, "how many"},
                                     Field{"months", &SimulatedFleet::months, "how many"},
                                     Field{"seed", &SimulatedFleet::seed, "of all that is drawn"},
                                     Field{"folder", &SimulatedFleet::folder, "that was written"},
                                     Field{"files", &SimulatedFleet::files, "how many"},
                                     Field{"truth", &SimulatedFleet::truth, "file of the truth, beside the folder"}};
};

}  // namespace ballbar
