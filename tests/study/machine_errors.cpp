// Errors of a machine from made ballbar tests: do the intervals hold, is nothing named that is not there, is what is
// hidden named?
//
//   study_machine_errors [SEEDS] [all|full|arc|full-50-500 ...]      20 seeds of the first three unless given
//
// Both runs of tests with bars of 50 to 300 mm, arcs of 180 to 360 deg and feeds of 500 to 5000 mm/min, from the plain
// formulas of made_errors.hpp; noise of 0.1 um white and of 0.3 um with a memory of 0.4 s, readings to 0.01 um, pitches
// known; every seed is another noise. Per kind of test:
//
//   nothing    nothing hidden: how often anything is named, and how often a reversal spike
//   drawn      every parameter drawn at random, 3 um, waves of 1 um: how often the 95 % interval of each holds it
//   one        one row of one error at 5 of its sigmas: named, and a wrong one beside it
//   several    two to four rows of different errors, likewise: all of them named
//   sixth      1 or 2 um of a 6th harmonic on the CCW run alone: said to be left, and nothing named
//   spikes     1 um after both reversals of one axis, where these are in the arc: that axis named and not the other
//
//   one direction   squareness or servo mismatch of 2 to 40 um in one run, every second without a feed: told as the
//              group of both that comes first; one of them named alone
//   play       1 to 10 um at one axis, taken up over 0 to 1.5 deg: a spike named; the play within 10 % or 2 sigma
//   both       2 um of play and 2 um after the reversals of one axis: both named
//
// The last three of full circles. An error of an arc has to show with the instrument's damping too, but for
// `arc-no-prior`. Beside each figure stands the aim; fails (exit 1) where one is worse than what was reached
// (machine_errors_ranges.hpp) by more than 3 standard deviations of that many seeds.
#include "ballbar/machine_errors/machine_errors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "../libballbar/machine_errors/made_errors.hpp"
#include "ballbar/effects/effect.hpp"
#include "machine_errors_ranges.hpp"

namespace {

using namespace ballbar;

struct Plan {
  std::string name;
  made::ErrorTest test;
  bool prior = true;
  Ranges reached;
};

struct Study {
  int seeds = 20;
  bool failed = false;

  // Of so many seeds, 3 standard deviations about this share.
  double slack(double share) const { return 3.0 * std::sqrt(share * (1.0 - share) / seeds) + 1e-9; }
  std::string at_least(int count, double reached, double aim) { return judged(count, reached, 1.0, aim, ">="); }
  std::string at_most(int count, double reached, double aim) { return judged(count, 0.0, reached, aim, "<="); }
  std::string judged(int count, double lowest, double highest, double aim, const char* sign) {
    const double share = static_cast<double>(count) / seeds;
    const bool good = share >= lowest - slack(lowest) && share <= highest + slack(highest);
    failed = failed || !good;
    return fmt::format("{:5.1f} % ({} {:.0f}){}", 100.0 * share, sign, 100.0 * aim, good ? "" : " OUT OF RANGE");
  }
};

MachineErrors found_in(const Plan& plan, const made::ErrorTest& test, std::mt19937_64& random) {
  return machine_errors(made::both_runs(test, random), {.prior = plan.prior});
}

std::mt19937_64 random_of(const std::string& cell, int seed) {
  std::seed_seq mixed(cell.begin(), cell.end());
  std::array<unsigned, 2> words{};
  mixed.generate(words.begin(), words.end());
  return std::mt19937_64(words[0] + 1000003ULL * static_cast<unsigned>(seed));
}

// Mean sigma of each row in noise alone, and whose it is.
struct Row {
  double sigma = 0.0;
  const Effect* effect = nullptr;
};

struct InNoise {
  std::map<std::string, Row> rows;
};

InNoise in_noise(const Plan& plan) {
  constexpr int kTests = 10;
  InNoise found;
  for (int seed = 0; seed < kTests; ++seed) {
    std::mt19937_64 random = random_of("rows " + plan.name, seed);
    const MachineErrors one = found_in(plan, plan.test, random);
    for (const MachineError& error : one.errors) {
      Row& row = found.rows[error.name];
      row.sigma += error.sigma / kTests;
      row.effect = error.effect;
    }
  }
  return found;
}

void nothing(Study& study, const Plan& plan) {
  int any = 0, left = 0, spikes = 0;
  std::map<std::string, int> named;
  for (int seed = 0; seed < study.seeds; ++seed) {
    std::mt19937_64 random = random_of("nothing " + plan.name, seed);
    const MachineErrors found = found_in(plan, plan.test, random);
    bool one = false, spike = false;
    for (const RankedError& error : found.ranked) {
      if (!error.significant) continue;
      one = true, ++named[error.effect->name];
      spike = spike || error.effect->rules.error_fit == ErrorFit::at_reversals;
    }
    any += one ? 1 : 0;
    spikes += spike ? 1 : 0;
    left += found.left ? 1 : 0;
  }
  fmt::print("  nothing   named {}   left {}   a spike {}", study.at_most(any, plan.reached.any, kAim.any),
             study.at_most(left, plan.reached.any, kAim.any),
             study.at_most(spikes, plan.reached.no_spike, kAim.no_spike));
  for (const auto& [name, count] : named) fmt::print("   {} {}", name, count);
  fmt::print("\n");
}

struct Coverage {
  int held = 0;
  double sum = 0.0, squares = 0.0, sigma = 0.0;
};

void drawn(Study& study, const Plan& plan, const InNoise& noise) {
  std::map<std::string, Coverage> coverage;
  for (int seed = 0; seed < study.seeds; ++seed) {
    std::mt19937_64 random = random_of("drawn " + plan.name, seed);
    std::normal_distribution<double> normal;
    made::ErrorTest test = plan.test;
    for (const auto& [name, row] : noise.rows) {
      if (row.effect != nullptr && (row.effect->rules.error_fit == ErrorFit::at_reversals ||
                                    row.effect->rules.error_fit == ErrorFit::where_it_shows)) {
        continue;  // fitted where they show alone: 0
      }
      const bool amplitude = name.starts_with("cyclic");
      const double size = name == "squareness" ? 30.0 : name == "servo_mismatch" ? 0.3 : amplitude ? 1.0 : 3.0;
      const double value = size * normal(random);
      test.errors[name] = amplitude ? std::abs(value) : value;
    }
    for (const MachineError& row : found_in(plan, test, random).errors) {
      const double off = row.value - test.of(row.name);
      Coverage& one = coverage[row.name];
      one.held += std::abs(off) <= 1.96 * row.sigma ? 1 : 0;
      one.sum += off;
      one.squares += off * off;
      one.sigma += row.sigma;
    }
  }
  int held = 0;
  fmt::print("  drawn     {:<22} {:>9} {:>9} {:>9}   held\n", "", "bias", "scatter", "sigma");
  for (const auto& [name, one] : coverage) {
    const double n = study.seeds;
    held += one.held;
    fmt::print("            {:<22} {:9.3f} {:9.3f} {:9.3f}   {}\n", name, one.sum / n, std::sqrt(one.squares / n),
               one.sigma / n,
               study.judged(one.held, name.starts_with("cyclic") ? plan.reached.cyclic_low : plan.reached.coverage_low,
                            plan.reached.coverage_high, kAim.coverage_low, ">="));
  }
  fmt::print("            all {:.1f} %\n", 100.0 * held / (study.seeds * static_cast<double>(coverage.size())));
}

void hidden(Study& study, const Plan& plan, const std::map<std::string, Row>& rows, bool several) {
  std::vector<std::string> names;
  for (const auto& [name, row] : rows) {
    if (row.effect != nullptr) names.push_back(name);
  }
  const std::string cell = several ? "several" : "one";
  int all_named = 0, wrong = 0, each_named = 0, each = 0;
  std::map<std::string, std::pair<int, int>> by_row;  // named, of
  std::map<std::string, int> wrongly;
  for (int seed = 0; seed < study.seeds; ++seed) {
    std::mt19937_64 random = random_of(cell + " " + plan.name, seed);
    made::ErrorTest test = plan.test;
    std::map<const Effect*, std::string> hides;
    const std::size_t number = several ? 2 + static_cast<std::size_t>(seed) % 3 : 1;
    while (hides.size() < number) {
      const std::string& name = names[random() % names.size()];
      const Row& row = rows.at(name);
      if (!hides.try_emplace(row.effect, name).second) continue;
      const bool amplitude = row.effect->rules.error_fit == ErrorFit::along_the_travel;
      test.errors[name] = 5.0 * row.sigma * (amplitude || random() % 2 == 0 ? 1.0 : -1.0);
    }
    const MachineErrors found = found_in(plan, test, random);
    std::set<const Effect*> named;
    bool other = false;
    for (const RankedError& error : found.ranked) {
      if (!error.significant) continue;
      named.insert(error.effect);
      if (hides.contains(error.effect)) continue;
      other = true;
      ++wrongly[error.effect->name];
    }
    bool all = true;
    for (const auto& [effect, name] : hides) {
      const bool is_named = named.contains(effect);
      all = all && is_named;
      by_row[name].first += is_named ? 1 : 0;
      by_row[name].second += 1;
      each_named += is_named ? 1 : 0;
      ++each;
    }
    all_named += all ? 1 : 0;
    wrong += other ? 1 : 0;
  }
  fmt::print("  {:<9} named {}   a wrong one {}   each {:.1f} %\n", cell,
             several ? study.at_least(all_named, plan.reached.several, kAim.several)
                     : study.at_least(all_named, plan.reached.one, kAim.one),
             several ? study.at_most(wrong, plan.reached.wrong_of_several, kAim.wrong_of_several)
                     : study.at_most(wrong, plan.reached.wrong, kAim.wrong),
             100.0 * each_named / each);
  std::string line = "           ";
  for (const auto& [name, count] : by_row) {
    if (count.first < count.second) line += fmt::format(" {} {} of {},", name, count.first, count.second);
  }
  for (const auto& [name, count] : wrongly) line += fmt::format(" wrongly {} {},", name, count);
  if (line.size() > 11) fmt::print("{}\n", line.substr(0, line.size() - 1));
}

void sixth(Study& study, const Plan& plan, double size_um, const OfSixth& reached, const OfSixth& aim) {
  int left = 0, named = 0;
  std::map<std::string, int> wrongly;
  for (int seed = 0; seed < study.seeds; ++seed) {
    std::mt19937_64 random = random_of("sixth " + plan.name, seed);
    made::ErrorTest test = plan.test;
    test.sixth_harmonic_um = size_um;
    const MachineErrors found = found_in(plan, test, random);
    left += found.left ? 1 : 0;
    bool any = false;
    for (const RankedError& error : found.ranked) {
      if (error.significant) any = true, ++wrongly[error.effect->name];
    }
    named += any ? 1 : 0;
  }
  fmt::print("  sixth     {:.0f} um left {}   named {}", size_um, study.at_least(left, reached.left, aim.left),
             study.at_most(named, reached.named, aim.named));
  for (const auto& [name, count] : wrongly) fmt::print("   {} {}", name, count);
  fmt::print("\n");
}

void spikes(Study& study, const Plan& plan) {
  int right = 0, other = 0;
  for (int seed = 0; seed < study.seeds; ++seed) {
    std::mt19937_64 random = random_of("spikes " + plan.name, seed);
    made::ErrorTest test = plan.test;
    const std::string axis = seed % 2 == 0 ? "a" : "b";
    for (const char* end : {"_pos", "_neg"}) test.errors["reversal_spike_" + axis + end] = 1.0;
    bool named = false, wrong = false;
    for (const RankedError& error : found_in(plan, test, random).ranked) {
      if (error.effect->rules.error_fit != ErrorFit::at_reversals || !error.significant) continue;
      (error.effect->name == "reversal_spike_" + axis ? named : wrong) = true;
    }
    right += named ? 1 : 0;
    other += wrong ? 1 : 0;
  }
  fmt::print("  spikes    named {}   the other axis {}\n", study.at_least(right, plan.reached.spike, kAim.spike),
             study.at_most(other, plan.reached.no_spike, kAim.no_spike));
}

void one_direction(Study& study, const Plan& plan) {
  int told = 0, alone = 0;
  for (int seed = 0; seed < study.seeds; ++seed) {
    std::mt19937_64 random = random_of("one direction " + plan.name, seed);
    std::uniform_real_distribution<double> uniform;
    const double um = 2.0 * std::pow(20.0, uniform(random)) * (random() % 2 == 0 ? 1.0 : -1.0);
    made::ErrorTest test = plan.test;
    if (random() % 2 == 0) {
      test.errors["squareness"] = um / (1e-3 * test.radius_mm);
    } else {
      test.errors["servo_mismatch"] = um / (test.feed_mm_per_min / 60.0);
    }
    std::vector<Recording> run{made::run_of(test, random() % 2 == 0 ? Direction::CCW : Direction::CW, random)};
    if (seed % 2 == 0) run.front().feed_mm_per_min.reset();
    const MachineErrors found = machine_errors(run, {.prior = plan.prior});
    const std::set<std::string> wanted{"squareness", "servo_mismatch"};
    bool is_first = false;
    for (const ErrorGroup& group : found.groups) {
      std::set<std::string> names;
      for (const Effect* effect : group.effects) names.insert(effect->name);
      is_first = is_first || (group.rank == 1U && names == wanted);
    }
    told += is_first ? 1 : 0;
    alone += std::ranges::any_of(
        found.ranked, [&](const RankedError& one) { return one.significant && wanted.contains(one.effect->name); });
  }
  fmt::print("  one direction   told {}   a member alone {}\n", study.at_least(told, 0.98, 0.98),
             study.at_most(alone, 0.01, 0.01));
}

bool is_named(const MachineErrors& found, const std::string& name) {
  return std::ranges::any_of(found.ranked,
                             [&](const RankedError& one) { return one.significant && one.effect->name == name; });
}

void play(Study& study, const Plan& plan) {
  int spike = 0, right = 0, both = 0;
  for (int seed = 0; seed < study.seeds; ++seed) {
    std::mt19937_64 random = random_of("play " + plan.name, seed);
    std::uniform_real_distribution<double> uniform;
    made::ErrorTest test = plan.test;
    const std::string axis = random() % 2 == 0 ? "a" : "b";
    const double um = std::pow(10.0, uniform(random));
    test.step_width_deg = 1.5 * uniform(random);
    for (const char* end : {"_pos", "_neg"}) test.errors["backlash_" + axis + end] = um;
    const MachineErrors found = found_in(plan, test, random);
    spike += is_named(found, "reversal_spike_a") || is_named(found, "reversal_spike_b") ? 1 : 0;
    right += std::ranges::all_of(found.errors, [&](const MachineError& row) {
      return !row.name.starts_with("backlash_" + axis) ||
             std::abs(row.value - um) < std::max(0.1 * um, 2.0 * row.sigma);
    });
    test = plan.test;
    for (const char* end : {"_pos", "_neg"}) {
      test.errors["backlash_" + axis + end] = 2.0;
      test.errors["reversal_spike_" + axis + end] = 2.0;
    }
    const MachineErrors of_both = found_in(plan, test, random);
    both += is_named(of_both, "reversal_spike_" + axis) && is_named(of_both, "backlash_" + axis) ? 1 : 0;
  }
  fmt::print("  play      a spike {}   the play {}   both {}\n", study.at_most(spike, 0.02, 0.02),
             study.at_least(right, 0.95, 0.95), study.at_least(both, 0.80, 0.80));
}

made::ErrorTest test_of(double radius_mm, double arc_deg, double feed_mm_per_min) {
  made::ErrorTest test = arc_deg < 360.0 ? made::arc_220() : made::full_turn();
  test.radius_mm = radius_mm;
  test.first_deg = arc_deg < 360.0 ? 360.0 - 0.5 * arc_deg : test.first_deg;
  test.arc_deg = arc_deg;
  test.feed_mm_per_min = feed_mm_per_min;
  test.readings_a_second = feed_mm_per_min > 2000.0 ? 250.0 : 66.667;
  return made::noisy(test);
}

std::vector<Plan> plans() {
  return {{"full", made::noisy(made::full_turn()), true, kFull},
          {"arc", made::noisy(made::arc_220()), true, kArc},
          {"arc-no-prior", made::noisy(made::arc_220()), false, kArcAlone},
          {"full-50-500", test_of(50.0, 360.0, 500.0), true, kFull},
          {"full-100-2000", test_of(100.0, 360.0, 2000.0), true, kFull},
          {"full-300-5000", test_of(300.0, 360.0, 5000.0), true, kFull},
          {"arc-150-220", test_of(150.0, 220.0, 1000.0), true, kArc},
          {"arc-300-270", test_of(300.0, 270.0, 2000.0), true, kArc},
          {"arc-100-180", test_of(100.0, 180.0, 500.0), true, kHalf}};
}

}  // namespace

int main(int argc, char** argv) {
  Study study;
  if (argc > 1) study.seeds = std::max(1, std::atoi(argv[1]));
  constexpr int kUsualPlans = 3;
  int place = 0;
  for (const Plan& plan : plans()) {
    bool wanted = argc < 3 && place++ < kUsualPlans;
    for (int i = 2; i < argc; ++i) wanted = wanted || argv[i] == plan.name || argv[i] == std::string("all");
    if (!wanted) continue;
    fmt::print("{}, {} seeds\n", plan.name, study.seeds);
    const InNoise noise = in_noise(plan);
    nothing(study, plan);
    hidden(study, plan, noise.rows, false);
    hidden(study, plan, noise.rows, true);
    sixth(study, plan, 1.0, plan.reached.sixth_1_um, kAim.sixth_1_um);
    sixth(study, plan, 2.0, plan.reached.sixth_2_um, kAim.sixth_2_um);
    spikes(study, plan);
    if (plan.test.arc_deg >= 360.0) {
      one_direction(study, plan);
      play(study, plan);
    }
    drawn(study, plan, noise);
    std::fflush(stdout);
  }
  return study.failed ? 1 : 0;
}
