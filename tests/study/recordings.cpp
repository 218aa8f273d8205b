// Every effect on a recording hidden in made recordings: is it named, or in the set that cannot be told?
//
//   study_recordings [SEEDS] [one_way|both_ways|two_feeds ...]
//
// d = 10, white noise of 0.3 um rounded nowhere, shapes off the grid. One line an effect and plan; the last of a plan
// is nothing hidden. Fails where a wrong name is more frequent than 2 % over a plan, and nothing hidden is called in
// more than 2 % (binomial, p < 0.01).
#include <fmt/format.h>

#include <cstdlib>
#include <string>

#include "../libballbar/diagnosis/made_recordings.hpp"
#include "ballbar/diagnosis/verdict/diagnose.hpp"
#include "diagnose/diagnosis_sentence.hpp"

namespace {

using namespace ballbar;

struct Tally {
  int n = 0, right = 0, wrong = 0, in_set = 0, unexplained = 0, nothing = 0;
};

Tally tally(const made::Plan& plan, const Effect* effect, int seeds) {
  Tally tally;
  for (int seed = 1; seed <= seeds; ++seed) {
    const Series trace = made::recordings(plan, effect, static_cast<std::uint64_t>(seed));
    DiagnosisOptions options;
    options.search.motion = Motion::linear_axes;
    if (effect != nullptr && effect->motions == std::vector{Motion::rotary_axis, Motion::spindle}) {
      options.search.motion = Motion::rotary_axis;
    }
    const Diagnosis found = diagnose(recording_base_model(trace), trace, 0, options);
    ++tally.n;
    bool named = false, other = false, in_set = false;
    for (const BoundEffect& bound : found.named) (bound.effect == effect ? named : other) = true;
    for (const auto& group : found.equivalent) {
      for (const BoundEffect& bound : group) in_set = in_set || bound.effect == effect;
    }
    if (std::getenv("BALLBAR_STUDY_TELL") != nullptr && !(named && !other)) {
      fmt::print("    {} seed {}: {}", effect == nullptr ? "-" : effect->name, seed, name_of(found.verdict));
      for (const BoundEffect& bound : found.named) fmt::print(" {}", label_of(bound));
      for (const auto& group : found.equivalent) {
        fmt::print(" |");
        for (const BoundEffect& bound : group) fmt::print(" {}", label_of(bound));
      }
      for (const std::string& reason : texts_of(reasons_of(found))) fmt::print(" / {}", reason);
      fmt::print("\n");
    }
    tally.right += named && !other ? 1 : 0;
    tally.wrong += other ? 1 : 0;
    tally.in_set += named || in_set ? 1 : 0;
    tally.unexplained += found.verdict == Verdict::unexplained ? 1 : 0;
    tally.nothing += found.verdict == Verdict::nothing ? 1 : 0;
  }
  return tally;
}

// Chance of `count` or more of n at 2 %.
double chance(int count, int n) {
  double below = 0.0, term = std::pow(0.98, n);
  for (int k = 0; k < count; ++k) {
    below += term;
    term *= static_cast<double>(n - k) / (k + 1) * 0.02 / 0.98;
  }
  return 1.0 - below;
}

}  // namespace

int main(int argc, char** argv) {
  const int seeds = argc > 1 ? std::atoi(argv[1]) : 20;
  bool failed = false;
  for (const std::string name : {"one_way", "both_ways", "two_feeds"}) {
    bool wanted = argc < 3;
    for (int i = 2; i < argc; ++i) wanted = wanted || argv[i] == name;
    if (!wanted) continue;
    made::Plan plan;
    plan.sweeps = name == "one_way" ? made::one_way() : name == "both_ways" ? made::both_ways() : made::two_feeds();
    if (name == "two_feeds") plan.readings = 120;
    fmt::print("{:<20} {:>6} {:>6} {:>6} {:>12} {:>8}   of {}\n", name, "right", "wrong", "in set", "unexplained",
               "nothing", seeds);
    Tally all;
    for (const auto& effect : built_in_catalogue()) {
      if (effect->level != Level::recording || effect->rules.is_base) continue;
      const Tally one = tally(plan, effect.get(), seeds);
      all.n += one.n;
      all.wrong += one.wrong;
      fmt::print("{:<20} {:>6} {:>6} {:>6} {:>12} {:>8}\n", effect->name, one.right, one.wrong, one.in_set,
                 one.unexplained, one.nothing);
      std::fflush(stdout);
    }
    const Tally none = tally(plan, nullptr, 5 * seeds);
    fmt::print("{:<20} {:>6} {:>6} {:>6} {:>12} {:>8}   of {}\n\n", "nothing", "", none.wrong, "", none.unexplained,
               none.nothing, none.n);
    failed = failed || chance(all.wrong, all.n) < 0.01 || chance(none.n - none.nothing, none.n) < 0.01;
  }
  return failed ? 1 : 0;
}
