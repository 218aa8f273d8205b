// Verdicts on data sets by code written apart from the product's own: other physics code, other logging, other noise.
//
//   study_verdicts N [CELL...] [--first SEED] [--verbose] [--list]
//
// N seeds a cell, from SEED (1) on. CELL: a name, or "one*" for all that begin so; without one all cells. --verbose
// prints a line a set. Prints shares in per cent with their Wilson 95 % intervals, a cell as soon as it is done:
//   right         one or two effects: verdict `named`, and exactly the truth; nothing hidden: nothing said; outside the
//                 catalogue: `unexplained`, or a right driver; an own value: that value said with P >= 0.9
//   wrong         a named effect that is not there, an own value that is right; where nothing of the catalogue is
//                 hidden also a wrong driver
//   driver right  all columns that drive (outside the catalogue: one of them) are those of named effects, or drivers
//                 said with P >= 0.9
//   prob.         verdict `probable`, and exactly the truth;   in set: all truths named, probable or in a set
//   any           something named, and nothing wrong;          open: outside, neither right, wrong nor `nothing`
// then how true stated probabilities are, and what intervals hold.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <string_view>
#include <vector>

#include "tally.hpp"

namespace verdicts = ballbar::verdicts;

int main(int argc, char** argv) {
  std::uint64_t first = 1;
  bool is_verbose = false;
  std::size_t count = 24;
  std::vector<std::string> wanted;
  bool has_count = false;
  for (int k = 1; k < argc; ++k) {
    const std::string_view word = argv[k];
    if (word == "--verbose") {
      is_verbose = true;
    } else if (word == "--list") {
      for (const verdicts::Cell& cell : verdicts::cells()) fmt::print("{}\n", cell.name);
      return 0;
    } else if (word == "--first" && k + 1 < argc) {
      first = std::strtoull(argv[++k], nullptr, 10);
    } else if (!has_count) {
      count = std::strtoull(argv[k], nullptr, 10);
      has_count = true;
    } else {
      wanted.emplace_back(word);
    }
  }
  bool failed = false;
  std::vector<verdicts::Judged> all;
  fmt::print("{}", verdicts::heading());
  for (const verdicts::Cell& cell : verdicts::cells()) {
    const auto is_wanted = [&](const std::string& name) {
      return name.ends_with('*') ? cell.name.starts_with(name.substr(0, name.size() - 1)) : cell.name == name;
    };
    if (!wanted.empty() && std::none_of(wanted.begin(), wanted.end(), is_wanted)) continue;
    std::vector<verdicts::Judged> sets;
    for (std::uint64_t seed = first; seed < first + count; ++seed) {
      try {
        const verdicts::Made made = cell.make(seed);
        const verdicts::Said said = verdicts::verdict_of(made);
        sets.push_back(verdicts::judged(made, said));
        if (is_verbose) fmt::print("{}", verdicts::line_of(made, said, sets.back()));
      } catch (const std::exception& error) {
        fmt::print("  {} seed {}: {}\n", cell.name, seed, error.what());
        failed = true;
      }
      std::fflush(stdout);
    }
    fmt::print("{}", verdicts::row_of(cell, sets));
    std::fflush(stdout);
    all.insert(all.end(), sets.begin(), sets.end());
  }
  fmt::print("{}{}", verdicts::reliability(all), verdicts::coverage(all));
  return failed ? 1 : 0;
}
