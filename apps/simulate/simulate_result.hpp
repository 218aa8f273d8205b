// What `simulate --json` prints.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "ballbar/formats/results/diagnosis_results.hpp"
#include "ballbar/lab/challenge/blind.hpp"

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

struct MadeSets {
  std::string folder;
  std::size_t sets = 0;
  std::string answers;
};

template <>
struct ResultType<MadeSets> {
  static constexpr std::string_view name = "BlindMade";
  static constexpr std::string_view meaning = "Data sets in which effects may be hidden.";
  static constexpr std::tuple fields{Field{"folder", &MadeSets::folder, "of the sets"},
                                     Field{"sets", &MadeSets::sets, "how many"},
                                     Field{"answers", &MadeSets::answers, "file"}};
};

struct ScoredSet {
  std::string name;
  BlindAnswer answer;
  BlindVerdict verdict;
  BlindOutcome outcome = BlindOutcome::right;
};

template <>
struct ResultType<ScoredSet> {
  static constexpr std::string_view name = "ScoredSet";
  static constexpr std::string_view meaning = "A set, its answer and what was said of it.";
  static constexpr std::tuple answered{
      Field{"kind", &BlindAnswer::kind, "nothing, one, two, outside, inseparable, spindle"},
      Field{"truth", &BlindAnswer::what, ""},
      Field{"hidden", &BlindAnswer::hidden, "effects; no columns: on any"},
      Field{"match", &BlindAnswer::match, "of a spindle: each of them is right"},
      Field{"d", &BlindAnswer::d, "of each hidden signal"},
      Field{"amplitude_um", &BlindAnswer::amplitude_um, "largest less smallest of each"}};
  static constexpr std::tuple judged{Field{"verdict", &BlindVerdict::verdict, ""},
                                     Field{"named", &BlindVerdict::named, ""},
                                     Field{"reported", &BlindVerdict::reported, "any of these"}};
  static constexpr std::tuple fields =
      std::tuple_cat(std::tuple{Field{"set", &ScoredSet::name, ""}}, fields_through(&ScoredSet::answer, answered),
                     fields_through(&ScoredSet::verdict, judged),
                     std::tuple{Field{"outcome", &ScoredSet::outcome, "right, in the set, missed, wrong"}});
};

template <>
struct ResultType<Share> {
  static constexpr std::string_view name = "Share";
  static constexpr std::string_view meaning = "So many of so many, with the interval of 95 % of their share.";
  static constexpr std::tuple fields{Field{"count", &Share::count, ""}, Field{"of", &Share::of, ""},
                                     Field{"low", &Share::low, ""}, Field{"high", &Share::high, ""}};
};

template <>
struct ResultType<Scores> {
  static constexpr std::string_view name = "Scores";
  static constexpr std::string_view meaning = "How often diagnoses of hidden effects are right.";
  static constexpr std::tuple fields{Field{"false_calls", &Scores::false_calls, "wrong, of sets with nothing"},
                                     Field{"right", &Scores::right, "of all"}, Field{"wrong", &Scores::wrong, "of all"},
                                     Field{"in_set", &Scores::in_set, "right or in the set, of effects that are there"},
                                     Field{"false_names", &Scores::false_names, "wrong, of what no effect explains"}};
};

struct ScoredSets {
  std::vector<ScoredSet> sets;
  Scores scores;
};

template <>
struct ResultType<ScoredSets> {
  static constexpr std::string_view name = "BlindScore";
  static constexpr std::string_view meaning = "Diagnoses of sets, scored.";
  static constexpr std::tuple fields{Field{"sets", &ScoredSets::sets, ""}, Field{"scores", &ScoredSets::scores, ""}};
};

}  // namespace ballbar
