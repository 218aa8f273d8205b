// Verdicts in plain words.
#include "diagnose/diagnosis_sentence.hpp"

#include <gtest/gtest.h>

namespace ballbar {
namespace {

BoundEffect expansion(const std::string& column) { return {find_effect("expansion", Level::series), {column}}; }

Diagnosis with_verdict(Verdict verdict) {
  Diagnosis found;
  found.verdict = verdict;
  found.target = "z_um";
  found.p_nothing = 0.02;
  return found;
}

void add(Diagnosis& found, const BoundEffect& bound, double p, double amplitude_um) {
  found.effects.push_back({bound, p});
  Candidate candidate;
  candidate.bound = bound;
  candidate.label = label_of(bound);
  candidate.p = p;
  candidate.amplitude_um = amplitude_um;
  candidate.in_best_set = true;
  found.candidates.push_back(candidate);
}

TEST(Sentence, of_an_effect_that_is_named) {
  Diagnosis found = with_verdict(Verdict::named);
  add(found, expansion("T1_degC"), 0.984, 3.21);
  found.named = {expansion("T1_degC")};
  EXPECT_EQ(text_of(sentence_of(found)),
            "Missing from the model of z_um: expansion(T1_degC), free thermal expansion with one temperature: 3.2 um "
            "(98 % sure).");
  found.candidates[0].minor = true;
  found.where = Misfit{"regime", "warming", "warming"};
  EXPECT_EQ(
      text_of(sentence_of(found)),
      "Missing from the model of z_um: expansion(T1_degC), free thermal expansion with one temperature: 3.2 um (98 % "
      "sure, minor). "
      "The model fails most while warming.");
}

TEST(Sentence, of_one_with_a_time) {
  Diagnosis found = with_verdict(Verdict::named);
  const BoundEffect lagged{find_effect("lagged_expansion", Level::series), {"T1_degC"}};
  add(found, lagged, 0.999, 12.0);
  FittedParameter time;
  time.name = "time_constant_s";
  time.unit = "s";
  time.value = 265.0;
  time.sigma = 20.0;
  found.candidates[0].parameters = {time};
  found.named = {lagged};
  EXPECT_EQ(
      text_of(sentence_of(found)),
      "Missing from the model of z_um: lagged_expansion(T1_degC), a body that follows a temperature with a delay: 12 "
      "um (over 99 % "
      "sure), time constant 4 min 25 s.");
}

TEST(Sentence, of_a_jump) {
  Diagnosis found = with_verdict(Verdict::named);
  const BoundEffect step{find_effect("step", Level::series), {}};
  add(found, step, 0.999, 2.4);
  FittedParameter gain, onset;
  gain.value = -2.4;
  onset.shape_of = ShapeOf::onset;
  onset.value = 33840.0;
  found.candidates[0].parameters = {gain, onset};
  found.named = {step};
  EXPECT_EQ(text_of(sentence_of(found)),
            "Missing from the model of z_um: step, a jump of -2.4 um at 9 h 24 min (over 99 % sure).");
}

TEST(Sentence, of_one_that_is_certain_and_one_that_is_open) {
  Diagnosis found = with_verdict(Verdict::named);
  add(found, expansion("T1_degC"), 0.99, 12.0);
  add(found, expansion("T2_degC"), 0.6, 2.0);
  add(found, expansion("T3_degC"), 0.38, 2.0);
  found.named = {expansion("T1_degC")};
  found.equivalent = {{expansion("T2_degC"), expansion("T3_degC")}};
  EXPECT_EQ(
      text_of(sentence_of(found)),
      "Missing from the model of z_um: expansion(T1_degC), free thermal expansion with one temperature: 12 um (99 % "
      "sure). A further "
      "effect is open: most likely expansion(T2_degC) (60 %), possibly expansion(T3_degC).");
}

// An effect is as large as what the whole set explains: another one cancels the rest of it.
TEST(Sentence, of_an_effect_that_another_one_cancels) {
  Diagnosis found = with_verdict(Verdict::driver);
  found.drivers = {{"T1_degC", 0.99}};
  add(found, expansion("T1_degC"), 0.9, 40.0);
  add(found, expansion("T2_degC"), 0.9, 38.0);
  found.explained_um = 3.0;
  EXPECT_EQ(text_of(sentence_of(found)),
            "T1_degC drives about 3 um that the model of z_um does not explain (99 % sure). Its form is open.");
}

// The further ones have a sentence each, from the third on a number.
TEST(Sentence, of_several_that_are_open) {
  Diagnosis found = with_verdict(Verdict::equivalent);
  for (int k = 1; k <= 3; ++k) {
    const BoundEffect bound = expansion("T" + std::to_string(k) + "_degC");
    add(found, bound, 0.9 - 0.2 * k, 5.0);
    found.equivalent.push_back({bound});
  }
  EXPECT_EQ(
      text_of(sentence_of(found)),
      "Something of about 5 um is missing from the model of z_um (98 % sure). The data do not tell for certain what "
      "it is: most likely expansion(T1_degC) (70 %). A further effect is open as well: most likely "
      "expansion(T2_degC) (50 %). So is 1 more.");
}

TEST(Sentence, of_what_is_probable) {
  Diagnosis found = with_verdict(Verdict::probable);
  add(found, expansion("T1_degC"), 0.83, 3.0);
  found.probable = {expansion("T1_degC")};
  EXPECT_EQ(
      text_of(sentence_of(found)),
      "Probably missing from the model of z_um: expansion(T1_degC), free thermal expansion with one temperature: 3 um "
      "(83 % sure).");
}

TEST(Sentence, of_a_value_that_the_model_holds) {
  Diagnosis found = with_verdict(Verdict::named);
  found.own = {{"speed_heating(n_rpm)", "exponent", "1", 5.0 / 3.0, 1.0, {0.9, 1.1}, 0.97}};
  EXPECT_EQ(text_of(sentence_of(found)),
            "In the model of z_um, the exponent of speed_heating(n_rpm) is held at 1.667, but the data say 1 (0.9 to "
            "1.1, 97 % "
            "sure).");
}

TEST(Sentence, of_an_input_that_drives) {
  Diagnosis found = with_verdict(Verdict::driver);
  found.drivers = {{"T4_degC", 0.998}, {"T5_degC", 0.6}};
  EXPECT_EQ(text_of(sentence_of(found)),
            "T4_degC drives a part that the model of z_um does not explain (over 99 % sure). Its form is open.");
  add(found, expansion("T4_degC"), 0.5, 3.0);
  found.equivalent = {{expansion("T4_degC")}};
  EXPECT_EQ(text_of(sentence_of(found)),
            "T4_degC drives about 3 um that the model of z_um does not explain (over 99 % sure). Its form is open: "
            "most likely "
            "expansion(T4_degC) (50 %).");
  found.drivers[1].p = 0.97;
  found.equivalent.clear();
  EXPECT_EQ(
      text_of(sentence_of(found)),
      "T4_degC and T5_degC drive about 3 um that the model of z_um does not explain (97 % sure). Their form is open.");
}

// Two are named, of one the probability: those of alternatives need not add up to 1.
TEST(Sentence, of_many_that_cannot_be_told_apart) {
  Diagnosis found = with_verdict(Verdict::equivalent);
  found.equivalent.emplace_back();
  for (int k = 1; k <= 6; ++k) {
    const BoundEffect bound = expansion("T" + std::to_string(k) + "_degC");
    add(found, bound, 0.16, 11.0);
    found.equivalent[0].push_back(bound);
  }
  EXPECT_EQ(text_of(sentence_of(found)),
            "Something of about 11 um is missing from the model of z_um (98 % sure). The data do not tell which of 6 "
            "effects it "
            "is: most likely expansion(T1_degC) (16 %), possibly expansion(T2_degC) or one of 4 more.");
  found.equivalent[0].resize(3);
  EXPECT_TRUE(text_of(sentence_of(found)).ends_with("possibly expansion(T2_degC) or one more."));
  found.equivalent[0].resize(1);
  EXPECT_EQ(text_of(sentence_of(found)),
            "Something of about 11 um is missing from the model of z_um (98 % sure). The data do not tell for certain "
            "what it is: "
            "most likely expansion(T1_degC) (16 %).");
}

TEST(Sentence, says_first_what_was_not_used) {
  Diagnosis found = with_verdict(Verdict::unexplained);
  found.p_discrepancy = 0.9;
  found.discrepancy_um = 2.5;
  found.columns_not_searched = {{"door", true}, {"pallet", false}};
  found.saturated = {{"T1_degC", 0.42}};
  found.set_aside = 8;
  found.level_jumps = 18;
  found.level_jump_um = 2.1;
  EXPECT_TRUE(text_of(sentence_of(found))
                  .starts_with("door was not searched: it has gaps. pallet was not searched: no effect reads it. "
                               "T1_degC stands at the end of "
                               "its range for 42 % of the rows, as a saturated "
                               "sensor does. These rows are set aside. 8 readings far from the others are set aside. "
                               "z_um jumps 18 times, by "
                               "2.1 "
                               "um: corrections of the control or of the probe, no drift. About ±2.5 um of slow drift"))
      << text_of(sentence_of(found));
}

TEST(Sentence, of_what_no_effect_explains) {
  Diagnosis found = with_verdict(Verdict::unexplained);
  found.p_discrepancy = 0.9;
  found.discrepancy_um = 2.5;
  EXPECT_EQ(text_of(sentence_of(found)),
            "About ±2.5 um of slow drift of z_um has no cause among these columns. Log another sensor, such as the "
            "temperature of the coolant, the structure or the room.");
  found.discrepancy_like = "settling";
  found.discrepancy_parameter = "time constant";
  found.discrepancy_time_s = 4800.0;
  EXPECT_EQ(text_of(sentence_of(found)),
            "About ±2.5 um of slow drift of z_um has no cause among these columns (like settling, time constant 1 h 20 "
            "min). Log another sensor, such as the temperature of the coolant, the structure or the room.");
  found.discrepancy_like.clear();
  found.drivers = {{"T1_degC", 0.64}};
  EXPECT_EQ(text_of(sentence_of(found)),
            "About ±2.5 um of slow drift of z_um has no cause among these columns. Log another sensor, such as the "
            "temperature of the coolant, the structure or the room. Likely driver: T1_degC (64 %).");
  found.drivers.clear();
  found.p_discrepancy = 0.1;
  found.base.rmse_um = 3.7;
  EXPECT_EQ(text_of(sentence_of(found)),
            "Something is probably still missing from the model of z_um (98 %). The remaining error is 3.7 um RMS.");
  add(found, expansion("T1_degC"), 0.31, 3.0);
  EXPECT_TRUE(text_of(sentence_of(found)).ends_with(" The best candidate, expansion(T1_degC) (31 %), is not proven."));
  found.own = {{"speed_heating(n_rpm)", "exponent", "1", 5.0 / 3.0, 1.0, {0.9, 1.1}, 0.45}};
  EXPECT_TRUE(text_of(sentence_of(found))
                  .ends_with(" The best candidate, another exponent of speed_heating(n_rpm) (45 %), is not proven."));
}

TEST(Sentence, of_an_error_above_the_stated_sigma) {
  Diagnosis found = with_verdict(Verdict::unexplained);
  found.p_nothing = 0.9;
  EXPECT_TRUE(text_of(sentence_of(found))
                  .starts_with("The remaining error of z_um is more than three times the stated sigma of its readings, "
                               "and no logged column "
                               "explains it."))
      << text_of(sentence_of(found));
}

TEST(Sentence, of_nothing) {
  Diagnosis found = with_verdict(Verdict::nothing);
  found.p_nothing = 0.91;
  found.hidden = expansion("T1_degC");
  found.hidden_um = 0.534;
  found.base.rmse_um = 0.4;
  EXPECT_EQ(
      text_of(sentence_of(found)),
      "Nothing further is missing from the model of z_um that these data could show (91 % sure). Up to 0.53 um of "
      "expansion(T1_degC) could still be hidden.");
  found.hidden_um = 4.8;  // more than the noise can hide
  EXPECT_EQ(text_of(sentence_of(found)),
            "Nothing further is missing from the model of z_um that these data could show (91 % sure). Up to 4.8 um of "
            "expansion(T1_degC) could still be hidden, because the model imitates it.");
  found.verdict = Verdict::untestable;
  EXPECT_EQ(text_of(sentence_of(found)), "These data could not have shown a missing effect.");
}

TEST(Sentence, of_readings_that_do_not_change) {
  Diagnosis found = with_verdict(Verdict::nothing);
  found.obstacle = Obstacle::still_readings;
  EXPECT_EQ(text_of(sentence_of(found)), "The readings do not change: there is nothing to explain.");
  EXPECT_TRUE(reasons_of(found).empty());
}

// What a page shows apart: what was not used before the verdict, a slow drift below it.
TEST(Sentence, in_parts) {
  Diagnosis found = with_verdict(Verdict::nothing);
  found.set_aside = 1;
  found.level_jumps = 4;
  found.level_jump_um = 5.0;
  found.discrepancy_um = 1.44;
  found.p_discrepancy = 0.9;
  EXPECT_EQ(
      texts_of(not_used_sentences(found)),
      (std::vector<std::string>{"One reading far from the others is set aside.",
                                "z_um jumps 4 times, by 5 um: corrections of the control or of the probe, no drift."}));
  const std::string drift = "About ±1.4 um of slow drift of z_um has no cause among these columns.";
  EXPECT_EQ(text_of(slow_drift_beside(found)), drift);
  EXPECT_NE(text_of(verdict_sentences(found)).find(drift), std::string::npos);
  EXPECT_EQ(text_of(sentence_of(found)),
            "One reading far from the others is set aside. z_um jumps 4 times, by 5 um: "
            "corrections of the control or of the probe, no drift. " +
                text_of(verdict_sentences(found)));
  found.verdict = Verdict::unexplained;  // the drift is the verdict
  EXPECT_EQ(text_of(verdict_sentences(found)).find(drift), 0U);
  EXPECT_EQ(text_of(slow_drift_beside(found)),
            "Log another sensor, such as the temperature of the coolant, the structure or the room.");
  found.discrepancy_um = 0.0;
  EXPECT_TRUE(slow_drift_beside(found).empty());
}

TEST(Reasons, of_what_is_untestable) {
  Diagnosis found = with_verdict(Verdict::untestable);
  found.obstacle = Obstacle::too_few_values;
  EXPECT_EQ(texts_of(reasons_of(found)), std::vector<std::string>{"There are too few values to test anything more."});
  found.obstacle = Obstacle::no_effect;
  EXPECT_EQ(texts_of(reasons_of(found)),
            std::vector<std::string>{"No effect of the catalogue can be tested on these data."});
}

// Of each member of the best set in turn: its form, its gains by run, its doubts.
TEST(Reasons, of_each_member) {
  Diagnosis found = with_verdict(Verdict::equivalent);
  for (int k = 1; k <= 3; ++k) add(found, expansion("T" + std::to_string(k) + "_degC"), 0.9, 5.0);
  EXPECT_TRUE(reasons_of(found).empty());
  found.candidates[0].doubts = {Doubt::weak_evidence};
  found.candidates[1].other_form_likelier = true;
  found.candidates[1].doubts = {Doubt::gain_differs, Doubt::drift_beside};
  found.candidates[2].doubts = {Doubt::weak_evidence};
  found.candidates[2].in_best_set = false;
  found.gains_by_run.resize(1);
  found.gains_by_run[0].effect = "expansion(T2_degC)";
  EXPECT_EQ(texts_of(reasons_of(found)),
            (std::vector<std::string>{"expansion(T1_degC): the evidence for it is weak.",
                                      "expansion(T2_degC): another form of the same column is more likely.",
                                      "expansion(T2_degC): its gain differs from run to run.",
                                      "expansion(T2_degC): its gain differs from cycle to cycle.",
                                      "expansion(T2_degC): beside a slow drift without a cause its form is open."}));
}

}  // namespace
}  // namespace ballbar
