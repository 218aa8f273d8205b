// The experiment that would decide, and how surely.
//
// Truths are drawn from the posterior of the data at hand: a set of effects with its gains and shapes, the noise, a
// slow curve or none. Each test of a menu is simulated on top of each truth - the room wanders as it did, sensors
// follow as they did and are rounded (planned_inputs.hpp) - and the whole diagnosis is asked again, of the data and the
// simulated run together. P(right) is the share of truths that it then names, and nothing else. What no test of the
// menu can tell apart has P(right) = 0 in all of them; that is said, and no test proposed.
//
// The test of least hours with P(right) >= 0.95 is chosen; where there is none, the one with the largest. Tests are
// first tried with few truths, the promising ones with more: P of the chosen one is of kTruths truths that had no part
// in the choice, its sigma is binomial. Of a draw the parameters are the most likely ones.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "ballbar/diagnosis/next_test/schedule.hpp"
#include "ballbar/diagnosis/verdict/diagnosis.hpp"
#include "ballbar/model/model.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

struct TestPlanOptions {
  double most_hours = 12.0;
  double max_rpm = 0.0;                                          // 0: the highest of the data
  bool can_load = false, can_room = false, can_coolant = false;  // what can be moved
  SearchOptions search;                                          // progress is told of here
};

// A test of the menu, and what is expected of it.
struct ExpectedTest {
  std::string kind;   // "random speeds"
  std::string doing;  // a phrase for a sentence
  double hours = 0.0;
  Schedule schedule;
  std::size_t truths = 0;  // simulated
  double p_right = 0.0;    // share of them that are named and nothing else
  double p_part = 0.0;     // share in which some of it is named that is not named now, and nothing else
  double p_wrong = 0.0;    // share in which another effect is named
  double p_right_sigma = 0.0;
};

// What a hypothesis expects of the target in the chosen test, um, on the rows of `time_s`; without noise, from 0.
struct ExpectedCurve {
  std::string label;  // "lagged_expansion(T_room_degC)", "nothing of the catalogue"
  double p = 0.0;     // of the set now
  std::vector<double> um;
};

// A sensor that is not there yet: at the place whose temperature drives what a hypothesis says.
struct SensorToAdd {
  std::string place;     // "where speed_heating(speed_rpm) heats"
  double p_right = 0.0;  // in the chosen test, with it
};

struct TestPlan {
  Verdict verdict = Verdict::nothing;  // of the data at hand
  double p_nothing = 0.0;
  bool is_decided = false;                            // they already name it
  std::vector<ExpectedTest> tests;                    // the chosen one first, then by P(right); empty: none is proposed
  std::vector<std::vector<BoundEffect>> inseparable;  // effects that no test can tell apart
  std::vector<double> time_s;                         // of the curves
  std::vector<ExpectedCurve> curves;                  // of the chosen test, the most probable first
  double sigma_um = 0.0;                              // of a reading
  std::vector<SensorToAdd> sensors;
  std::string sentence;  // what to do, what it would show and how surely, what cannot be told
};

// A drift series, of one run or several (runs.hpp). Throws Error as diagnose does, and for recordings.
TestPlan test_plan(const Model& model, const Series& data, std::size_t target, const TestPlanOptions& options);

}  // namespace ballbar
