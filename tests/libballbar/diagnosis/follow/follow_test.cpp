// A run that is looked at while it grows: made-up diagnoses, what is decided of them.
#include "ballbar/diagnosis/follow/follow.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "ballbar/diagnosis/thresholds.hpp"

namespace ballbar {
namespace {

BoundEffect expansion(const std::string& column) { return {find_effect("expansion", Level::series), {column}}; }

// ln B of 8.6 is 5400 to 1.
Diagnosis naming(const std::vector<BoundEffect>& bounds, double p = 0.99, double log_bayes_factor = 8.6) {
  Diagnosis found;
  found.verdict = Verdict::named;
  found.p_nothing = 1e-4;
  found.log_bayes_factor = log_bayes_factor;
  found.named = bounds;
  for (const BoundEffect& bound : bounds) found.effects.push_back({bound, p});
  return found;
}

Diagnosis undecided(double p_a, double p_b, double log_bayes_factor, double p_nothing = 1e-4) {
  Diagnosis found;
  found.verdict = Verdict::equivalent;
  found.p_nothing = p_nothing;
  found.log_bayes_factor = log_bayes_factor;
  found.effects = {{expansion("T_a_degC"), p_a}, {expansion("T_b_degC"), p_b}};
  return found;
}

// A value a minute.
FollowState after(FollowState state, const Diagnosis& diagnosis) {
  const std::size_t values = values_of_look(state.looks.size());
  return followed(std::move(state), diagnosis, values, static_cast<double>(values) / 60.0);
}

TEST(Follow, looks_are_a_twelfth_apart_wherever_one_begins) {
  EXPECT_EQ(values_of_look(0), 64U);
  EXPECT_EQ(values_of_look(1), 69U);  // 69.33
  EXPECT_EQ(values_of_look(2), 75U);  // 75.11
  EXPECT_EQ(values_of_look(99), 176860U);
}

TEST(Follow, rows_up_to_a_value_of_the_target) {
  constexpr double kGap = std::numeric_limits<double>::quiet_NaN();
  const Series data{{0, 1, 2, 3, 4},
                    {{"z_um", Role::measured, {kGap, 1, kGap, 2, 3}}, {"n_rpm", Role::speed, {5, 6, 7, 8, 9}}},
                    {},
                    {}};
  EXPECT_EQ(first_rows(data, "z_um", 2).time_s, (std::vector<double>{0, 1, 2, 3}));
  EXPECT_EQ(first_rows(data, "z_um", 2).columns[1].values, (std::vector<double>{5, 6, 7, 8}));
  EXPECT_EQ(first_rows(data, "z_um", 9).time_s.size(), 5U);
}

TEST(Follow, three_looks_in_a_row_decide_and_it_stays) {
  FollowState state;
  state = after(after(state, naming({expansion("T_a_degC")})), naming({expansion("T_a_degC")}));
  EXPECT_EQ(state.outcome, Outcome::open);
  state = after(state, naming({expansion("T_a_degC")}));
  EXPECT_EQ(state.outcome, Outcome::decided);
  EXPECT_EQ(outcome_text(state), "Decided after 1 h 15 min, at 75 values: expansion(T_a_degC) is missing (99 % sure).");
  state = after(state, undecided(0.5, 0.4, 0.0));
  EXPECT_EQ(state.outcome, Outcome::decided);
  EXPECT_EQ(state.decided, (std::vector<std::string>{"expansion(T_a_degC)"}));
}

// Each falls short of one condition at one of the three looks.
TEST(Follow, what_is_not_sure_enough_is_open) {
  const BoundEffect a = expansion("T_a_degC"), b = expansion("T_b_degC");
  const Diagnosis sure = naming({a});
  Diagnosis probable = sure;
  probable.verdict = Verdict::probable;
  for (const Diagnosis& weak : {naming({a}, 0.975), naming({a}, 0.99, 8.5), probable, naming({b})}) {
    EXPECT_EQ(after(after(after({}, sure), weak), sure).outcome, Outcome::open);
    EXPECT_EQ(after(after(after({}, sure), sure), weak).outcome, Outcome::open);
  }
  FollowState state = after({}, sure);
  state = followed(state, "run.csv: nothing moves.", values_of_look(1), 1.15);
  EXPECT_EQ(outcome_text(state), "Not decided after 1 h 9 min, at 69 values. run.csv: nothing moves.");
  EXPECT_EQ(after(state, sure).outcome, Outcome::open);
}

TEST(Follow, a_doubt_is_said_where_it_alone_is_in_the_way) {
  Diagnosis doubtful = undecided(0.99, 0.0, 20.0);
  doubtful.reasons = {"expansion(T_a_degC): its gain differs from cycle to cycle."};
  EXPECT_EQ(outcome_text(after({}, doubtful)),
            "Not decided after 1 h 4 min, at 64 values. Probability that nothing is missing: 0.00. Best candidate: "
            "expansion(T_a_degC) (probability 0.99). Why it is not named: expansion(T_a_degC): its gain differs from "
            "cycle to cycle.");
  doubtful.log_bayes_factor = 8.0;
  EXPECT_EQ(outcome_text(after({}, doubtful)),
            "Not decided after 1 h 4 min, at 64 values. Probability that nothing is missing: 0.00. Best candidate: "
            "expansion(T_a_degC) (probability 0.99).");
}

TEST(Follow, only_what_all_three_looks_name_is_decided) {
  const BoundEffect a = expansion("T_a_degC"), b = expansion("T_b_degC");
  const FollowState state = after(after(after({}, naming({a})), naming({a, b})), naming({a, b}));
  EXPECT_EQ(state.decided, (std::vector<std::string>{"expansion(T_a_degC)"}));
  EXPECT_EQ(after(after(after({}, naming({a, b})), naming({a, b})), naming({a, b})).decided.size(), 2U);
}

TEST(Follow, a_value_that_the_model_holds_is_decided) {
  Diagnosis found = naming({});
  OwnValue own;
  own.effect = "speed_heating(n_rpm)";
  own.parameter = "exponent";
  own.p = 0.995;
  found.own = {own};
  const FollowState state = after(after(after({}, found), found), found);
  EXPECT_EQ(outcome_text(state),
            "Decided after 1 h 15 min, at 75 values: the exponent of speed_heating(n_rpm) has another value (over 99 % "
            "sure).");
}

// A search may leave unequal what is equal.
TEST(Follow, values_that_are_logged_twice_are_not_decided) {
  constexpr double kGap = std::numeric_limits<double>::quiet_NaN();
  const Series data{{0, 1, 2},
                    {{"T_a_degC", Role::structure, {1, kGap, 3}},
                     {"T_b_degC", Role::structure, {1, kGap, 3}},
                     {"T_c_degC", Role::structure, {1, 2, 3}}},
                    {},
                    {}};
  FollowState state;
  state.logged_twice = columns_logged_twice(data);
  EXPECT_EQ(state.logged_twice, (std::map<std::string, std::string>{{"T_b_degC", "T_a_degC"}}));
  Diagnosis found = naming({expansion("T_a_degC")});
  found.effects.push_back({expansion("T_b_degC"), 0.011});
  const FollowState after_three = after(after(after(state, found), found), found);
  EXPECT_EQ(after_three.outcome, Outcome::undecidable);
  EXPECT_EQ(
      after_three.looks.back().why_stop,
      "No readings can distinguish expansion(T_a_degC) from expansion(T_b_degC): the same values are logged twice.");
  found = naming({expansion("T_c_degC")});
  EXPECT_EQ(after(after(after(state, found), found), found).outcome, Outcome::decided);
}

// Half of the values of look 9, 132, are those of look 0: looks 9, 10 and 11.
TEST(Follow, rivals_whose_odds_do_not_move_stop_it) {
  FollowState state;
  for (int k = 0; k < 11; ++k) state = after(state, undecided(0.5, 0.48, 3.0));
  EXPECT_EQ(state.outcome, Outcome::open);
  state = after(state, undecided(0.5, 0.48, 3.0));
  EXPECT_EQ(state.outcome, Outcome::undecidable);
  EXPECT_EQ(outcome_text(state),
            "Stop after 2 h 34 min, at 154 values: this run will not decide. The readings do not distinguish "
            "expansion(T_a_degC) from expansion(T_b_degC): their odds stayed the same while the number of values "
            "doubled.");
  EXPECT_EQ(after(state, naming({expansion("T_a_degC")})).outcome, Outcome::open);
}

TEST(Follow, rivals_whose_odds_move_are_waited_for) {
  FollowState moving, nothing, weak;
  for (int k = 0; k < 20; ++k) {
    const double odds = std::exp(0.03 * k);  // 0.27 while the values double
    moving = after(moving, undecided(odds / (1.0 + odds), 1.0 / (1.0 + odds), 3.0));
    nothing = after(nothing, undecided(0.2, 0.2, 1.0, 0.6));
    weak = after(weak, undecided(0.9, 0.09, 3.0));
  }
  EXPECT_EQ(moving.outcome, Outcome::open);
  EXPECT_EQ(nothing.outcome, Outcome::open);
  EXPECT_EQ(weak.outcome, Outcome::open);
}

FollowState flat(double planned_hours, int looks, double log_bayes_factor, double gained = 0.0) {
  FollowState state;
  state.planned_hours = planned_hours;
  for (int k = 0; k < looks; ++k) {
    const double odds = std::exp(0.2 * k);
    state = after(state, undecided(odds / (1.0 + odds), 1.0 / (1.0 + odds), log_bayes_factor + gained * k));
  }
  return state;
}

// At look 20, 317 values or 5 h 17 min: half were there at look 11, 154 values. A planned end at 1.5 times that, f =
// 0.97: ln B = 0 comes to at most 2 sqrt(f^2 + f) = 2.8, ln 5000 = 8.5 are needed.
TEST(Follow, a_run_that_is_too_short_stops) {
  const FollowState state = flat(1.5 * 317.0 / 60.0, 21, 0.0);
  EXPECT_EQ(state.outcome, Outcome::undecidable);
  EXPECT_EQ(
      outcome_text(state),
      "Stop after 5 h 17 min, at 317 values: this run will not decide. At this rate the readings will be at most 16 "
      "times as likely with something missing as with nothing by the planned end, 7 h 56 min. A decision needs 5000 "
      "times.");
  EXPECT_EQ(flat(3.0, 21, 20.0).looks.back().why_stop, "The planned end, 3 h, is over.");
  EXPECT_EQ(flat(2.6 * 317.0 / 60.0, 21, 0.0).outcome, Outcome::open);       // less than half of it is over
  EXPECT_EQ(flat(1.5 * 317.0 / 60.0, 21, 0.0, 0.4).outcome, Outcome::open);  // ln B grows, from 4 to 8
  EXPECT_EQ(flat(1.5 * 317.0 / 60.0, 21, 20.0).outcome, Outcome::open);      // so do the odds of the first
}

// At look 19, 293 values or 4 h 53 min, half were there at look 10, 142 values: f = 0.444. ln of the odds went from
// 0.405 to 0.847: it comes to 0.847 + 0.091 + 2 sqrt(0.247 x 1.884) = 2.303, P = 0.91.
TEST(Follow, a_run_whose_rivals_stay_stops) {
  FollowState state;
  state.planned_hours = 5.4;
  for (int k = 0; k < 20; ++k) {
    state = after(state, undecided(0.6 + 0.1 * (k % 2), 0.4 - 0.1 * (k % 2), 20.0));
  }
  EXPECT_EQ(state.outcome, Outcome::undecidable);
  EXPECT_EQ(
      state.looks.back().why_stop,
      "At this rate the probability of expansion(T_a_degC), the best candidate, will be at most 0.91 by the planned "
      "end, 5 h 24 min. A decision needs 0.98.");
}

TEST(Follow, too_few_values_and_the_bound) {
  EXPECT_EQ(outcome_text({}), "There are too few values: the first look is at 64.");
  EXPECT_EQ(error_text(),
            "A run in which nothing is missing is decided wrongly in at most 2 % of cases, however often you look, if "
            "noise and logging are as assumed. There are at most 100 looks. At each, a decision needs readings that "
            "are 5000 times as likely with something missing as with nothing. A decided effect has a probability of "
            "0.98 or more and passes all tests at 3 looks in a row.");
}

}  // namespace
}  // namespace ballbar
