// Verdicts on data sets by code written apart from the product's own: other physics code, other logging, other noise,
// so that a diagnosis is not judged by data that its own library, or the laboratory beside it, made.
//
//   study_verdicts [N [CELL...]] [--first SEED] [--verbose]
//   study_verdicts --list                      names of the cells
//   study_verdicts --write FOLDER CELL SEED    data.csv, model.toml and truth.json of one set, and of its twin
//
// N seeds a cell (24), from SEED (1) on. CELL: a name, or 'one*' for all that begin so; without one all cells.
// --verbose prints a line a set. Prints shares in per cent with their Wilson 95 % intervals, a cell as soon as it is
// done:
//   right         one or two effects: verdict `named`, and exactly the truth; nothing hidden: nothing said; outside the
//                 catalogue: `unexplained`, or a right driver; an own value: that value said with P >= 0.9; a twin: the
//                 same verdict and the same names
//   wrong         a named effect that is not there, an own value that is right; where nothing of the catalogue is
//                 hidden also a wrong driver
//   driver right  all columns that drive (outside the catalogue: one of them) are those of named effects, or drivers
//                 said with P >= 0.9
//   prob.         verdict `probable`, and exactly the truth;   in set: all truths named, probable or in a set
//   any           something named, and nothing wrong;          open: outside, neither right, wrong nor `nothing`
//   clear         one who knows the noise, and of two effects the other, could state a truth with P >= 0.9: about the
//                 most that can be right;   of: of these so many are right
// then how true stated probabilities are, and what intervals hold, of sets whose truth is in the catalogue.
#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "options.hpp"
#include "tally.hpp"
#include "written.hpp"

namespace verdicts = ballbar::verdicts;

namespace {

verdicts::Judged examined(const verdicts::Cell& cell, std::uint64_t seed, bool is_verbose) {
  const verdicts::Made made = cell.make(seed);
  const verdicts::Said said = verdicts::verdict_of(made);
  verdicts::Judged judged = verdicts::judged(made, said);
  if (!cell.change) {
    if (is_verbose) fmt::print("{}", verdicts::line_of(made, said, judged));
    return judged;
  }
  const verdicts::Twin twin = verdicts::twin_of(made, cell);
  const verdicts::Said after = verdicts::verdict_of(twin.made);
  const bool is_same = verdicts::is_same_verdict(said, after, twin);
  if (is_verbose) {
    fmt::print("{}{}{}", is_same ? "" : "OTHER\n", verdicts::line_of(made, said, judged),
               verdicts::line_of(twin.made, after, verdicts::judged(twin.made, after)));
  }
  judged.right = is_same;
  return judged;
}

void write_one(const verdicts::Options& options) {
  for (const verdicts::Cell& cell : verdicts::cells()) {
    if (!verdicts::is_wanted(options, cell.name)) continue;
    const verdicts::Made made = cell.make(options.first);
    verdicts::write(made, options.folder);
    if (cell.change) verdicts::write(verdicts::twin_of(made, cell).made, options.folder + "/twin");
    fmt::print("{}\n", made.what);
  }
}

bool study(const verdicts::Options& options) {
  bool succeeds = true;
  std::vector<verdicts::Judged> all;
  fmt::print("{}", verdicts::heading());
  for (const verdicts::Cell& cell : verdicts::cells()) {
    if (!verdicts::is_wanted(options, cell.name)) continue;
    std::vector<verdicts::Judged> sets;
    for (std::uint64_t seed = options.first; seed < options.first + options.count; ++seed) {
      try {
        sets.push_back(examined(cell, seed, options.is_verbose));
      } catch (const std::exception& error) {
        fmt::print("  {} seed {}: {}\n", cell.name, seed, error.what());
        succeeds = false;
      }
      std::fflush(stdout);
    }
    fmt::print("{}", verdicts::row_of(cell, sets));
    std::fflush(stdout);
    all.insert(all.end(), sets.begin(), sets.end());
  }
  fmt::print("{}{}", verdicts::reliability(all), verdicts::coverage(all));
  return succeeds;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const verdicts::Options options = verdicts::options_of({argv + 1, argv + argc});
    if (options.lists) {
      for (const verdicts::Cell& cell : verdicts::cells()) fmt::print("{}\n", cell.name);
      return 0;
    }
    if (options.folder.empty()) return study(options) ? 0 : 1;
    write_one(options);
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "study_verdicts: {}\n", error.what());
    return 2;
  }
}
