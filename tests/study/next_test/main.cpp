// How often the next test settles what a verdict leaves open: sets of study_verdicts' generator, whose machines run
// again under the schedule that is proposed.
//
//   study_next_test [N [CELL...]] [--hours H] [--tests K] [--plan NAME] [--first SEED] [--max-rpm N] [--own-places]
//                   [--threads T] [--verbose]
//   study_next_test --list      names of the cells and of the plans
//
// N seeds a cell (24), from SEED (1) on; CELL: a name, or 'poor*' for all that begin so; without one all cells. At most
// K (1) tests of H (12) hours a set, on T (2) threads. NAME: design, what the library proposes; staircase,
// pseudo-random speeds of up to --max-rpm (18000); a fixed plan, over and over until H is full (0: once); or fixed, all
// of these one after another. --own-places: kinks and viscosities are reckoned from the first temperature of each run,
// in place of staying where they were in the first.
//
// A row is the state after so many tests, over all sets; a set whose verdict is `named` needs no more tests.
//   right, wrong, prob., in set, driver   as in study_verdicts, in per cent with Wilson 95 % intervals
//   tested, right of these                sets that made the test of that number
//   h                                     hours of all tests so far: median of the tested, mean of all
// then how true the promised probabilities are. Fails where a set cannot be made or diagnosed.
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>

#include "next_test/options.hpp"
#include "next_test/plans.hpp"
#include "next_test/tally.hpp"

namespace next_test = ballbar::next_test;

namespace {

bool is_wanted(const next_test::Options& options, const std::string& cell) {
  return options.cells.empty() || std::any_of(options.cells.begin(), options.cells.end(), [&](const std::string& name) {
           return name.ends_with('*') ? cell.starts_with(name.substr(0, name.size() - 1)) : cell == name;
         });
}

// In the order of the seeds; without those that failed.
std::vector<next_test::Looped> all_of(const next_test::Cell& cell, const next_test::Options& options,
                                      std::atomic<bool>& succeeds) {
  std::vector<std::optional<next_test::Looped>> sets(options.count);
  std::atomic<std::size_t> next{0};
  std::mutex printing;
  const auto work = [&] {
    for (std::size_t k = next++; k < sets.size(); k = next++) {
      try {
        sets[k] = next_test::looped(cell, options.first + k, options.loop);
        sets[k]->made.data.columns.clear();  // large, and no longer needed
        if (!options.is_verbose) continue;
        const std::lock_guard lock(printing);
        fmt::print("{}", next_test::lines_of(*sets[k]));
      } catch (const std::exception& error) {
        const std::lock_guard lock(printing);
        fmt::print("  {} seed {}: {}\n", cell.name, options.first + k, error.what());
        succeeds = false;
      }
      std::fflush(stdout);
    }
  };
  std::vector<std::jthread> threads;
  for (std::size_t k = 1; k < options.threads; ++k) threads.emplace_back(work);
  work();
  threads.clear();  // waits
  std::vector<next_test::Looped> done;
  for (std::optional<next_test::Looped>& set : sets) {
    if (set) done.push_back(std::move(*set));
  }
  return done;
}

std::vector<std::string> plans_of(const next_test::Options& options) {
  if (options.loop.plan != "fixed") return {options.loop.plan};
  std::vector<std::string> names;
  for (const next_test::FixedPlan& plan : next_test::fixed_plans({}, 0.0, 1.0)) names.push_back(plan.name);
  return names;
}

bool study(next_test::Options options) {
  std::atomic<bool> succeeds = true;
  std::vector<next_test::Looped> all;
  fmt::print("{}", next_test::heading());
  for (const next_test::Cell& cell : next_test::cells()) {
    if (!is_wanted(options, cell.name)) continue;
    for (const std::string& plan : plans_of(options)) {
      next_test::Options one = options;
      one.loop.plan = plan;
      std::vector<next_test::Looped> sets = all_of(cell, one, succeeds);
      fmt::print("{}", next_test::rows_of(cell.name, plan, sets));
      std::fflush(stdout);
      std::move(sets.begin(), sets.end(), std::back_inserter(all));
    }
  }
  fmt::print("{}", next_test::reliability(all));
  return succeeds;
}

void list() {
  for (const next_test::Cell& cell : next_test::cells()) fmt::print("{}\n", cell.name);
  fmt::print("\ndesign\nstaircase\nfixed\n");
  for (const next_test::FixedPlan& plan : next_test::fixed_plans({}, 0.0, 1.0)) fmt::print("{}\n", plan.name);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const next_test::Options options = next_test::options_of({argv + 1, argv + argc});
    if (!options.lists) return study(options) ? 0 : 1;
    list();
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "study_next_test: {}\n", error.what());
    return 2;
  }
}
