// What `simulate --json` prints.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "ballbar/formats/results/diagnosis_results.hpp"
#include "ballbar/lab/challenge/blind.hpp"

namespace ballbar {

struct SimulatedRun {
  std::string method;
  std::optional<std::size_t> rows, tests;
  std::uint64_t seed = 0;
  std::string folder;
  std::vector<std::string> files;
  std::string truth;
};

template <>
inline constexpr auto kResult<SimulatedRun> = ResultType(
    "Simulated", "What was simulated.", Field{"method", &SimulatedRun::method, "of the session; series: of a series"},
    Field{"rows", may_lack(&SimulatedRun::rows), "of a series"},
    Field{"tests", may_lack(&SimulatedRun::tests), "of a session"}, Field{"seed", &SimulatedRun::seed, "of the noise"},
    Field{"folder", &SimulatedRun::folder, "that was written"}, Field{"files", &SimulatedRun::files, "in it"},
    Field{"truth", &SimulatedRun::truth, "file of the truth, beside the folder"});

struct SimulatedFleet {
  std::size_t machines = 0, months = 0;
  std::uint64_t seed = 0;
  std::string folder;
  std::size_t files = 0;
  std::string truth;
};

template <>
inline constexpr auto kResult<SimulatedFleet> = ResultType(
    "SimulatedFleet", "A plant that was simulated.", Field{"machines", &SimulatedFleet::machines, "how many"},
    Field{"months", &SimulatedFleet::months, "how many"}, Field{"seed", &SimulatedFleet::seed, "of all that is drawn"},
    Field{"folder", &SimulatedFleet::folder, "that was written"}, Field{"files", &SimulatedFleet::files, "how many"},
    Field{"truth", &SimulatedFleet::truth, "file of the truth, beside the folder"});

struct MadeSets {
  std::string folder;
  std::size_t sets = 0;
  std::string answers;
};

template <>
inline constexpr auto kResult<MadeSets> = ResultType("BlindMade", "Data sets in which effects may be hidden.",
                                                     Field{"folder", &MadeSets::folder, "of the sets"},
                                                     Field{"sets", &MadeSets::sets, "how many"},
                                                     Field{"answers", &MadeSets::answers, "file"});

struct ScoredSet {
  std::string name;
  BlindAnswer answer;
  BlindVerdict verdict;
  BlindOutcome outcome = BlindOutcome::right;
};

template <>
inline constexpr auto kResult<ScoredSet> = ResultType(
    "ScoredSet", "A set, its answer and what was said of it.", Field{"set", &ScoredSet::name},
    fields_of(&ScoredSet::answer, Field{"kind", &BlindAnswer::kind, "nothing, one, two, outside, inseparable, spindle"},
              Field{"truth", &BlindAnswer::what}, Field{"hidden", &BlindAnswer::hidden, "effects; no columns: on any"},
              Field{"match", &BlindAnswer::match, "of a spindle: each of them is right"},
              Field{"d", &BlindAnswer::d, "of each hidden signal"},
              Field{"amplitude_um", &BlindAnswer::amplitude_um, "largest less smallest of each"}),
    fields_of(&ScoredSet::verdict, Field{"verdict", &BlindVerdict::verdict}, Field{"named", &BlindVerdict::named},
              Field{"reported", &BlindVerdict::reported, "any of these"}),
    Field{"outcome", &ScoredSet::outcome, "right, in the set, missed, wrong"});

template <>
inline constexpr auto kResult<Share> = ResultType("Share",
                                                  "So many of so many, with the interval of 95 % of their share.",
                                                  Field{"count", &Share::count}, Field{"of", &Share::of},
                                                  Field{"low", &Share::low}, Field{"high", &Share::high});

template <>
inline constexpr auto kResult<Scores> =
    ResultType("Scores", "How often diagnoses of hidden effects are right.",
               Field{"false_calls", &Scores::false_calls, "wrong, of sets with nothing"},
               Field{"right", &Scores::right, "of all"}, Field{"wrong", &Scores::wrong, "of all"},
               Field{"in_set", &Scores::in_set, "right or in the set, of effects that are there"},
               Field{"false_names", &Scores::false_names, "wrong, of what no effect explains"});

struct ScoredSets {
  std::vector<ScoredSet> sets;
  Scores scores;
};

template <>
inline constexpr auto kResult<ScoredSets> = ResultType("BlindScore", "Diagnoses of sets, scored.",
                                                       Field{"sets", &ScoredSets::sets},
                                                       Field{"scores", &ScoredSets::scores});

}  // namespace ballbar
