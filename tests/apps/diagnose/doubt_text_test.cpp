// Why an effect is not named, in words.
#include "diagnose/doubt_text.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace ballbar {
namespace {

TEST(DoubtText, of_each_doubt) {
  const Effect& effect = *find_effect("expansion", Level::series);
  const std::pair<Doubt, std::string> texts[] = {
      {Doubt::time_alone, "it depends on time alone, as any slow drift does"},
      {Doubt::gain_differs, "its gain differs from cycle to cycle"},
      {Doubt::not_predictive, "it does not predict left-out cycles better"},
      {Doubt::weak_evidence, "the evidence for it is weak"},
      {Doubt::uncertain_size, "its amplitude is less than 5 times its uncertainty"},
      {Doubt::open_clock, "an input that is early or late by a part of a row explains nearly as much"},
      {Doubt::forgotten_change, "a change that the noise forgets explains nearly as much"},
      {Doubt::warm_start, "a machine that was not at rest at the first row explains nearly as much"},
      {Doubt::switched_input, "an effect of an input that is switched near that moment explains nearly as much"},
      {Doubt::drift_beside, "beside a slow drift without a cause its form is open"},
      {Doubt::larger_drift, "a slow drift without a cause is larger"},
      {Doubt::in_the_model, "the model can already produce what it adds"},
      {Doubt::not_shown, "these readings do not show it"},
      {Doubt::not_significant, "it is not significant beside the other errors of the axes"},
  };
  for (const auto& [doubt, text] : texts) EXPECT_EQ(text_of(message_of(doubt, effect)), text);
}

// Its cycles are recordings.
TEST(DoubtText, of_an_effect_on_recordings) {
  Candidate candidate;
  candidate.bound.effect = find_effect("squareness", Level::recording);
  EXPECT_TRUE(doubts_of(candidate).empty());
  candidate.doubts = {Doubt::weak_evidence, Doubt::gain_differs, Doubt::not_predictive};
  EXPECT_EQ(texts_of(doubts_of(candidate)),
            (std::vector<std::string>{"the evidence for it is weak", "its gain differs from recording to recording",
                                      "it does not predict left-out recordings better"}));
}

}  // namespace
}  // namespace ballbar
