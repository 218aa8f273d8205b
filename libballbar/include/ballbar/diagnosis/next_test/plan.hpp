// The experiment that would decide a diagnosis of a drift series, and the probability that it does.
//
// Truths are drawn from the posterior of the data: a set of effects with gains and shapes, the noise, with or without a
// slow random curve. Each test of a menu is simulated for each truth. The room varies as in the data, the sensors
// respond and round as in the data. The full diagnosis is then repeated on the data and the simulated run together.
// P(right) is the share of truths in which it names the true effects and no others. If no test of the menu can separate
// two effects, P(right) is 0 for all tests; the plan says so and proposes none.
//
// The shortest test with P(right) >= 0.95 is chosen; if there is none, the test with the largest P(right). All tests
// are tried with few truths first, then the promising ones with more. P of the chosen test comes from 24 truths that
// took no part in the choice; its sigma is binomial, at most 0.10. Each truth has its most likely parameters.
//
// The plan depends on its seed. It holds for the catalogue: what is missing beyond it, no simulated truth has.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "ballbar/diagnosis/verdict/diagnose.hpp"
#include "ballbar/model/model.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

// ---- The schedule of a test: dwells at constant speed.

// A constant speed for some time, with load, room and coolant temperature.
struct Dwell {
  double duration_s = 0.0;
  double speed_rpm = 0.0;  // 0: at rest
  double load = 1.0;       // factor on the load that the data had at this speed
  double room_K = 0.0;     // room temperature above that of the data
  double coolant_K = 0.0;  // coolant temperature above that of the data
};

struct Schedule {
  std::vector<Dwell> dwells;
  double reading_s = 60.0;   // interval between readings of the target
  bool starts_warm = false;  // true: the machine is still drifting from earlier work; false: after a night at rest
};

double duration_s(const Schedule& schedule);

// The dwell at `time_s` after the beginning; the last one after the end. The schedule needs at least one dwell.
const Dwell& dwell_at(const Schedule& schedule, double time_s);

// ---- The plan.

enum class SpeedProgram {
  random,       // dwells of 10 min to 2 h, each at another speed
  staircase,    // up and down in fifths of the highest speed
  stop_and_go,  // the highest speed and rest by turns, 10 min to 2 h each
  rest,         // data without a speed
};

// A test of the menu with its expected outcome.
struct ExpectedTest {
  SpeedProgram speeds = SpeedProgram::rest;
  double max_rpm = 0.0;  // the highest speed that it may have
  double hours = 0.0;
  Schedule schedule;
  std::size_t truths = 0;  // number of simulated truths
  double p_right = 0.0;    // share in which all true effects are named, and no others
  double p_part = 0.0;     // share in which some true effects are named that are not named now, and no others
  double p_wrong = 0.0;    // share in which another effect is named
  double p_right_sigma = 0.0;
};

struct TestPlanOptions {
  double most_hours = 12.0;                                      // longest test considered
  double max_rpm = 0.0;                                          // 0: the highest of the data
  bool can_load = false, can_room = false, can_coolant = false;  // what the operator can change
  SearchOptions search;                                          // its `progress` is called here as well
  std::uint64_t seed = 1;                                        // of the random draws
  // Called as truths are simulated, in the calling thread: so many of so many.
  std::function<void(const ExpectedTest& test, std::size_t done, std::size_t count)> simulating;
};

// The curve of the target that a hypothesis predicts for the chosen test, in um, one value per entry of
// TestPlan::time_s. It has no noise and starts at 0.
struct ExpectedCurve {
  std::vector<BoundEffect> effects;  // empty: nothing of the catalogue
  double p = 0.0;                    // probability of the set, given the data at hand
  std::vector<double> um;
};

// A proposed new thermometer where an effect heats.
struct SensorToAdd {
  BoundEffect effect;
  double p_right = 0.0;  // P(right) of the chosen test with this sensor
};

struct TestPlan {
  Obstacle obstacle = Obstacle::none;  // still_readings, too_few_values: nothing can be planned from the data
  Verdict verdict = Verdict::nothing;  // of the data at hand
  double p_nothing = 0.0;
  bool is_decided = false;                            // the data at hand already name the effect
  std::vector<ExpectedTest> tests;                    // the chosen one first, then by P(right); empty: none is proposed
  std::vector<std::vector<BoundEffect>> inseparable;  // effects that no test can separate
  std::vector<double> time_s;                         // times of the curves
  std::vector<ExpectedCurve> curves;                  // for the chosen test, the most probable first
  double sigma_um = 0.0;                              // standard deviation of one reading
  std::optional<SensorToAdd> sensor;
};

// Plans a test for a drift series of one or several runs (series.hpp). Throws Error as diagnose() does, and for
// recordings.
TestPlan test_plan(const Model& model, const Series& data, std::size_t target, const TestPlanOptions& options);

}  // namespace ballbar
