// Verdicts in plain words.
#include "diagnosis/verdict/sentence.hpp"

#include <gtest/gtest.h>

namespace ballbar {
namespace {

BoundEffect expansion(const std::string& column) { return {find_effect("expansion", Level::series), {column}}; }

void add(Diagnosis& found, const BoundEffect& bound, double p, double amplitude_um) {
  found.effects.push_back({bound, p});
  Candidate candidate;
  candidate.bound = bound;
  candidate.label = label_of(bound);
  candidate.p = p;
  candidate.amplitude_um = amplitude_um;
  found.candidates.push_back(candidate);
}

TEST(Sentence, of_an_effect_that_is_named) {
  Diagnosis found;
  found.verdict = Verdict::named;
  add(found, expansion("T1_degC"), 0.984, 3.21);
  found.named = {expansion("T1_degC")};
  EXPECT_EQ(sentence_of(found), "The model lacks expansion(T1_degC), 3.2 um (P = 0.98).");
  found.candidates[0].minor = true;
  EXPECT_EQ(sentence_of(found), "The model lacks expansion(T1_degC), 3.2 um (P = 0.98), which is minor.");
}

TEST(Sentence, of_one_that_is_certain_and_one_that_is_open) {
  Diagnosis found;
  found.verdict = Verdict::named;
  add(found, expansion("T1_degC"), 0.99, 12.0);
  add(found, expansion("T2_degC"), 0.6, 2.0);
  add(found, expansion("T3_degC"), 0.38, 2.0);
  found.named = {expansion("T1_degC")};
  found.equivalent = {{expansion("T2_degC"), expansion("T3_degC")}};
  EXPECT_EQ(sentence_of(found),
            "The model lacks expansion(T1_degC), 12 um (P = 0.99). One of these as well: expansion(T2_degC) (P = "
            "0.60), or expansion(T3_degC) (P = 0.38).");
}

TEST(Sentence, of_what_is_probable) {
  Diagnosis found;
  found.verdict = Verdict::probable;
  add(found, expansion("T1_degC"), 0.83, 3.0);
  found.probable = {expansion("T1_degC")};
  EXPECT_EQ(sentence_of(found), "The model probably lacks expansion(T1_degC), 3 um (P = 0.83).");
}

TEST(Sentence, of_a_value_that_the_model_holds) {
  Diagnosis found;
  found.verdict = Verdict::named;
  found.own = {{"speed_heating(n_rpm)", "exponent", "1", 5.0 / 3.0, 1.0, {0.9, 1.1}, 0.97}};
  EXPECT_EQ(sentence_of(found),
            "The exponent of speed_heating(n_rpm) is 1 (0.9 to 1.1), the model holds 1.67 (P = 0.97).");
}

TEST(Sentence, of_an_input_that_drives) {
  Diagnosis found;
  found.verdict = Verdict::driver;
  found.drivers = {{"T4_degC", 0.998}, {"T5_degC", 0.6}};
  EXPECT_EQ(sentence_of(found), "T4_degC (P = 1.00) drives what the model lacks; its form is open.");
  add(found, expansion("T4_degC"), 0.5, 3.0);
  found.equivalent = {{expansion("T4_degC")}};
  EXPECT_EQ(sentence_of(found),
            "T4_degC (P = 1.00) drives what the model lacks; its form is open: expansion(T4_degC) (P = 0.50).");
}

// More than five are not all told.
TEST(Sentence, of_many_that_cannot_be_told_apart) {
  Diagnosis found;
  found.verdict = Verdict::equivalent;
  found.equivalent.emplace_back();
  for (int k = 1; k <= 6; ++k) {
    const BoundEffect bound = expansion("T" + std::to_string(k) + "_degC");
    add(found, bound, 0.16, 1.0);
    found.equivalent[0].push_back(bound);
  }
  EXPECT_EQ(sentence_of(found),
            "Something is missing, and the data cannot tell which of these it is: expansion(T1_degC) (P = 0.16), or "
            "expansion(T2_degC) (P = 0.16), or expansion(T3_degC) (P = 0.16), or expansion(T4_degC) (P = 0.16), or "
            "one of 2 more.");
}

TEST(Sentence, of_what_no_effect_explains) {
  Diagnosis found;
  found.verdict = Verdict::unexplained;
  found.p_discrepancy = 0.9;
  found.discrepancy_um = 2.5;
  EXPECT_EQ(sentence_of(found),
            "Something is left that no effect of the catalogue explains: a slow curve of 2.5 um (standard "
            "deviation).");
  found.p_discrepancy = 0.1;
  EXPECT_EQ(sentence_of(found), "Something is left that goes with time alone: no logged input drives it.");
}

TEST(Sentence, of_nothing) {
  Diagnosis found;
  found.p_nothing = 0.91;
  found.smallest = expansion("T1_degC");
  found.smallest_um = 0.534;
  EXPECT_EQ(sentence_of(found),
            "No effect is found (P of nothing = 0.91). expansion(T1_degC) would have been from 0.53 um.");
  found.verdict = Verdict::untestable;
  EXPECT_EQ(sentence_of(found), "These data could not have shown a missing effect.");
}

}  // namespace
}  // namespace ballbar
