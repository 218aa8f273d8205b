// Effects hidden in made data: does the diagnosis name them, and nothing else?
//
//   study_diagnosis [SEEDS [CELL...]]     cells by number; in the environment
//                                         VERBOSE     every data set is printed
//                                         STUDY_DATE  stands in the last line
//
// Prints the table of what the diagnosis has to reach, a cell as soon as it is done: shares in per cent with their
// Wilson 95 % intervals. Right, wrong, in set, called: outcome.hpp. Separable: what the data allow, oracle.hpp. Below a
// cell what four usual ways to select effects make of the same data (baselines.hpp), how near amplitudes and time
// constants are, and how far the error falls. Fails where a gate is clearly missed, or a data set cannot be
// diagnosed.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <vector>

#include "tally.hpp"

namespace study = ballbar::study;

int main(int argc, char** argv) {
  const int seeds = argc > 1 ? std::atoi(argv[1]) : 20;
  std::vector<std::size_t> wanted;
  for (int k = 2; k < argc; ++k) wanted.push_back(static_cast<std::size_t>(std::atoi(argv[k])));
  const std::vector<study::Cell> cells = study::cells();
  bool failed = false;
  fmt::print("{}", study::heading());
  std::fflush(stdout);
  for (std::size_t number = 0; number < cells.size(); ++number) {
    if (!wanted.empty() && std::find(wanted.begin(), wanted.end(), number) == wanted.end()) continue;
    study::Tally tally;
    for (int seed = 1; seed <= seeds; ++seed) {
      try {
        const auto outcome = cells[number].outcome(static_cast<std::uint64_t>(seed));
        if (outcome) tally.add(*outcome);
      } catch (const std::exception& error) {
        fmt::print("     seed {}: {}\n", seed, error.what());
        failed = true;
      }
    }
    fmt::print("{}", study::lines_of(number, cells[number], tally));
    std::fflush(stdout);
    if (!study::clearly_missed(cells[number].gate, tally)) continue;
    fmt::print("     clearly missed\n");
    failed = true;
  }
  const char* date = std::getenv("STUDY_DATE");
  fmt::print("seeds 1 to {}, ballbar {}{}\n", seeds, BALLBAR_VERSION, date != nullptr ? std::string(", ") + date : "");
  return failed ? 1 : 0;
}
