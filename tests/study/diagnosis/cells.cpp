#include "cells.hpp"

#include <array>
#include <stdexcept>

#include "after_test.hpp"
#include "measured.hpp"
#include "metamorphic.hpp"
#include "spindle_set.hpp"

namespace ballbar::study {
namespace {

// No other effect of the catalogue, nor two of them, make the same: expansion is a lag of nothing, gradient_bending and
// bearing_rings are two expansions.
constexpr std::array kLeftOut{"lagged_expansion",   "centrifugal_shift", "cooling_asymmetry",
                              "viscosity_feedback", "preload_loss",      "play_hysteresis"};

Random random_of(std::uint64_t seed) { return Random(seed * 7919 + 13); }

// `count` effects of the catalogue hidden.
DataSet set_on(const Record& record, std::vector<Injection> believed, const Scatter& scatter, std::size_t count,
               double d, Random& random, std::uint64_t seed) {
  DataSet set = data_set(record, std::move(believed), scatter);
  set.options.search.seed = seed;
  if (!hide_effects(set, count, d, random)) throw std::runtime_error("too few effects can be hidden.");
  finish(set, random);
  return set;
}

DataSet poor_set(std::uint64_t seed, double d) {
  Random random = random_of(seed);
  return set_on(poor_record(), friction_heat(), {}, 1, d, random, seed);
}

Expected expected_of(std::size_t count) { return count == 0 ? Expected::nothing : Expected::effects; }

Cell rich(std::string name, std::string aim, std::size_t count, double d, const Scatter& scatter, const Gate& gate,
          bool errors = false) {
  const auto outcome = [=](std::uint64_t seed) {
    return examined(rich_set(seed, count, d, scatter), expected_of(count), {.baselines = true, .errors = errors});
  };
  return {std::move(name), std::move(aim), outcome, gate};
}

Cell session(std::string name, std::string aim, std::size_t count, const Gate& gate) {
  const auto outcome = [=](std::uint64_t seed) {
    Random random = random_of(seed);
    const Record record = session_record(random);
    return examined(set_on(record, friction_heat(), {}, count, 10.0, random, seed), expected_of(count));
  };
  return {std::move(name), std::move(aim), outcome, gate};
}

enum class Outside { driven, time, left_out };

std::optional<Outcome> outside(Outside what, std::uint64_t seed) {
  Random random = random_of(seed);
  DataSet set = data_set(rich_record(), friction_heat(), {});
  set.options.search.seed = seed;
  constexpr double kD = 40.0;
  switch (what) {
    case Outside::driven:
      hide(set, driven_outsider(set, seed), kD);
      break;
    case Outside::time:
      while (!hide(set, curve_of_time(set, random), kD)) continue;
      break;
    case Outside::left_out: {
      const std::string name = kLeftOut[(seed - 1) % kLeftOut.size()];
      if (!hide_effects(set, 1, kD, random, name)) return std::nullopt;
      set.options.search.without = {name};
      break;
    }
  }
  finish(set, random);
  return examined(set, Expected::unexplained);
}

std::optional<Outcome> logged_twice(std::uint64_t seed) {
  Random random = random_of(seed);
  DataSet set = data_set(rich_record(), friction_heat(), {});
  set.options.search.seed = seed;
  const std::string twice = seed % 2 == 0 ? "T_room_degC" : "T_housing_degC";
  if (!hide_effects(set, 1, 10.0, random, {}, twice)) return std::nullopt;
  finish(set, random);
  log_also(set, logged_again(*find_column(set.data, twice)));
  return examined(set, Expected::undecided, {.baselines = false});
}

// The difference to a room that does not move is the other temperature alone.
Outcome constant_room(std::uint64_t seed) {
  Random random = random_of(seed);
  DataSet set = data_set(with_constant_room(rich_record()), friction_heat(), {});
  set.options.search.seed = seed;
  const BoundEffect truth{find_effect("gradient_bending", Level::series), {"T_bearing_degC", "T_room_degC"}};
  const BoundEffect alone{find_effect("lagged_expansion", Level::series), {"T_bearing_degC"}};
  while (!hide_effect(set, alone, 10.0, random)) continue;
  set.hidden.front() = {std::nullopt, label_of(truth), set.hidden.front().signal_um, {truth, alone}};
  finish(set, random);
  return examined(set, Expected::undecided, {.baselines = false});
}

// The load in proportion to the only speed: either heats.
DataSet one_speed_set(std::uint64_t seed) {
  Random random = random_of(seed);
  DataSet set = data_set(one_speed_record(), {{{find_effect("expansion", Level::series), {"T_room_degC"}}, {3.0}}}, {});
  set.options.search.seed = seed;
  const BoundEffect by_speed{find_effect("speed_heating", Level::series), {"speed_rpm"}};
  const BoundEffect by_load{find_effect("load_heating", Level::series), {"load_W"}};
  while (!hide_effect(set, seed % 2 == 0 ? by_speed : by_load, 10.0, random)) continue;
  finish(set, random);
  return set;
}

// Of the sets that are left undecided: after one proposed test after the other until nothing is, at most so many.
std::optional<Outcome> after_tests(DataSet set, std::size_t most) {
  Diagnosis found = diagnose(set.model, set.data, 0, set.options);
  if (found.equivalent.empty()) return std::nullopt;
  Random random = random_of(set.options.search.seed + 5000);
  for (std::size_t k = 0; k < most && !found.equivalent.empty(); ++k) {
    std::optional<DataSet> again = after_proposed_test(set, found, random);
    if (!again) break;
    set = std::move(*again);
    found = diagnose(set.model, set.data, 0, set.options);
  }
  return judged_and_weighed(set, found, Expected::effects);
}

// Means of 150 s: 24 temperatures make a library of thousands.
Outcome fakes(std::size_t count, std::uint64_t seed) {
  Random random = random_of(seed);
  DataSet set = rich_set(seed, count, 10.0, {.phi = 0.81}, 10);
  for (Column& fake : fake_temperatures(set.data.time_s, 20, random)) log_also(set, std::move(fake));
  return examined(set, expected_of(count));
}

Cell same_verdict(std::string name, Change change) {
  return {std::move(name), "same >= 95 %", [=](std::uint64_t seed) { return outcome_of_change(change, seed); }};
}

}  // namespace

DataSet rich_set(std::uint64_t seed, std::size_t count, double d, const Scatter& scatter, std::size_t each) {
  Random random = random_of(seed);
  return set_on(rich_record(each), friction_heat(), scatter, count, d, random, seed);
}

std::vector<Cell> cells() {
  const Scatter usual{}, slow{.phi = 0.98}, heavy{.heavy = true}, coarse{.sigma_um = 0.15, .resolution_um = 0.1};
  const Gate nothing{.most_called = 0.05}, one{.most_wrong = 0.05}, clear{.most_wrong = 0.05, .least_in_set = 0.85},
      several{.most_wrong = 0.15};
  const auto of = [](auto make, Expected expected) {
    return [=](std::uint64_t seed) { return examined(make(seed), expected); };
  };
  return {
      rich("nothing, AR 0.9", "called <= 2 %", 0, 0.0, usual, nothing),
      rich("nothing, AR 0.98", "called <= 2 %", 0, 0.0, slow, nothing),
      rich("nothing, heavy tails", "called <= 5 %", 0, 0.0, heavy, nothing),
      rich("one, d = 10, AR 0.9", "right >= 90, wrong <= 1, set >= 98 %", 1, 10.0, usual, clear, true),
      rich("one, d = 10, AR 0.98", "right >= 90, wrong <= 1, set >= 98 %", 1, 10.0, slow, clear),
      rich("one, d = 7.5, AR 0.9", "right >= 80, wrong <= 2 %", 1, 7.5, usual, one),
      rich("one, d = 5, AR 0.9", "wrong <= 3 %", 1, 5.0, usual, one),
      rich("two, d = 12, AR 0.9", "right >= 80, wrong <= 2 %", 2, 12.0, usual, several, true),
      rich("three, d = 12, AR 0.9", "right >= 65, wrong <= 3 %", 3, 12.0, usual, several),
      {"one, d = 10, poor", "wrong <= 2, set >= 97 %",
       of([](std::uint64_t s) { return poor_set(s, 10.0); }, Expected::effects), clear},
      rich("nothing, rounded to 0.1 um", "called <= 5 %", 0, 0.0, coarse, nothing),
      session("session, nothing", "called <= 2 %", 0, nothing),
      session("session, one, d = 10", "wrong <= 2, set >= 95 %", 1, one),
      {"outside: driven, d = 40", "wrong <= 10, right >= 90 %",
       [](std::uint64_t s) { return outside(Outside::driven, s); }},
      {"outside: of time, d = 40", "wrong 0, right >= 90 %", [](std::uint64_t s) { return outside(Outside::time, s); }},
      {"outside: left out in turn, d = 40", "wrong <= 10, right >= 90 %",
       [](std::uint64_t s) { return outside(Outside::left_out, s); }},
      {"inseparable: logged twice, d = 10", "never named", logged_twice},
      {"inseparable: constant room, d = 10", "never named", constant_room},
      {"inseparable: one speed, d = 10", "never named",
       [](std::uint64_t s) { return examined(one_speed_set(s), Expected::undecided, {.baselines = false}); }},
      {"one speed, after the proposed test", "right >= 95 %",
       [](std::uint64_t s) { return after_tests(one_speed_set(s), 1); }},
      {"one speed, after up to three", "right >= 95 %",
       [](std::uint64_t s) { return after_tests(one_speed_set(s), 3); }},
      {"poor, after the proposed test", "right >= 95 %",
       [](std::uint64_t s) { return after_tests(poor_set(s, 10.0), 1); }},
      {"poor, after up to three", "right >= 95 %", [](std::uint64_t s) { return after_tests(poor_set(s, 10.0), 3); }},
      {"20 fakes, nothing", "wrong <= 1 %", [](std::uint64_t s) { return fakes(0, s); }},
      {"20 fakes, one, d = 10", "wrong <= 1 %", [](std::uint64_t s) { return fakes(1, s); }},
      {"20 fakes, measured", "wrong <= 3 %", measured_fakes},
      same_verdict("30 % of the rows less", Change::fewer_rows),
      same_verdict("60 s instead of 15 s", Change::resampled),
      same_verdict("columns renamed", Change::renamed),
      same_verdict("columns turned", Change::turned),
      same_verdict("a noise input", Change::noise_input),
      {"finite volumes: one cause", "-", of(spindle_cause, Expected::effects)},
      {"finite volumes: whole spindle", "-", of(whole_spindle, Expected::effects)},
      {"measured: ch3, ch1, ch5", "all right", measured_room},
  };
}

}  // namespace ballbar::study
