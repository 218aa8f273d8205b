// What a `.b5r` stores of the machine's errors, by our names.
#include "ballbar/formats/recordings/stored_errors.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "ballbar/machine_errors/machine_errors.hpp"

namespace ballbar {
namespace {

constexpr const char* kAnalysis = "RENISHAW_DIAGNOSTICS 1.0";

B5r storing(std::vector<StoredFeature> features, std::string version = "20.00.14") {
  B5r test;
  test.stored = std::move(features);
  test.software_version = std::move(version);
  return test;
}

struct Named {
  const char* ours;
  const char* theirs;
};

constexpr Named kRows[] = {
    {"squareness", "AF_SQUARENESS"},
    {"scale_mismatch", "AF_SCALE_MISMATCH"},
    {"straightness_a", "AF_STRAIGHTNESS_A"},
    {"straightness_b", "AF_STRAIGHTNESS_B"},
    {"backlash_a_pos", "AF_BACKLASH_A_POS"},
    {"backlash_b_neg", "AF_BACKLASH_B_NEG"},
    {"lateral_play_a_neg", "AF_LATERAL_PLAY_A_NEG"},
    {"lateral_play_b_pos", "AF_LATERAL_PLAY_B_POS"},
    {"servo_mismatch", "AF_SERVO_MISMATCH"},
    {"sin_4_theta", "AF_SIN_4_THETA"},
    {"cyclic_error_a_fwd", "AF_CYCLIC_ERROR_A_FWD"},
    {"cyclic_error_b_rev", "AF_CYCLIC_ERROR_B_REV"},
    {"reversal_spike_a_pos", "AF_REVERSAL_SPIKES_A_POS"},
    {"reversal_spike_b_neg", "AF_REVERSAL_SPIKES_B_NEG"},
    {"centre_a", "AF_CENTRE_OFFSET_A"},
    {"centre_b", "AF_CENTRE_OFFSET_B"},
    {"global_scale", "AF_GLOBAL_SCALE"},
    {"radius_change", "AF_RADIUS_CHANGE"},
    {"offset_a_shift", "AF_OFFSET_A_SHIFT"},
    {"offset_b_shift", "AF_OFFSET_B_SHIFT"},
};

TEST(StoredErrors, EachRowByItsNameInTheFile) {
  std::vector<StoredFeature> features;
  double value = 0.0;
  for (const Named& row : kRows) features.push_back({kAnalysis, row.theirs, "UT_LENGTH_UM", value += 1.0});
  const B5r test = storing(features);
  value = 0.0;
  for (const Named& row : kRows) EXPECT_EQ(stored_error(test, row.ours), value += 1.0) << row.ours;
  EXPECT_EQ(stored_error(test, "cubic_error_along"), std::nullopt);
}

TEST(StoredErrors, RanksAndCircularities) {
  const B5r test = storing({{kAnalysis, "AF_BACKLASH_A_IC", "UT_LENGTH_UM", 1.8},
                            {kAnalysis, "AF_BACKLASH_A_RANK", "UT_NONE", 2.0},
                            {kAnalysis, "AF_REVERSAL_SPIKES_B_IC", "UT_LENGTH_UM", 0.7},
                            {kAnalysis, "AF_REVERSAL_SPIKES_B_RANK", "UT_NONE", 11.0},
                            {kAnalysis, "AF_SQUARENESS_RANK", "UT_NONE", 0.0}});
  EXPECT_EQ(stored_rank(test, "backlash_a"), 2);
  EXPECT_EQ(stored_individual_circularity_um(test, "backlash_a"), 1.8);
  EXPECT_EQ(stored_rank(test, "reversal_spike_b"), 11);
  EXPECT_EQ(stored_individual_circularity_um(test, "reversal_spike_b"), 0.7);
  EXPECT_EQ(stored_rank(test, "squareness"), std::nullopt);  // 0 is no place
  EXPECT_EQ(stored_rank(test, "straightness_a"), std::nullopt);
  EXPECT_EQ(stored_individual_circularity_um(test, "straightness_a"), std::nullopt);
}

TEST(StoredErrors, NotValidIsNotStored) {
  StoredFeature declined{kAnalysis, "AF_SQUARENESS", "UT_SQUARENESS", 31.0};
  declined.valid = false;
  EXPECT_EQ(stored_error(storing({declined}), "squareness"), std::nullopt);
  StoredFeature rank{kAnalysis, "AF_SQUARENESS_RANK", "UT_NONE", 1.0};
  rank.valid = false;
  EXPECT_EQ(stored_rank(storing({rank}), "squareness"), std::nullopt);
}

// The same names stand in a run, in mm.
TEST(StoredErrors, OtherAnalysesAndRunsDoNotCount) {
  const B5r test = storing({{"run 0", "AF_CENTRE_OFFSET_A", "UT_LENGTH_MM", 0.012},
                            {"ISO230_4 2005", "AF_SQUARENESS", "UT_SQUARENESS", 31.0}});
  EXPECT_EQ(stored_error(test, "centre_a"), std::nullopt);
  EXPECT_EQ(stored_error(test, "squareness"), std::nullopt);
  EXPECT_EQ(stored_error(storing({}), "squareness"), std::nullopt);
}

TEST(StoredErrors, PitchOfEachAxisAbove0) {
  const B5r test = storing(
      {{kAnalysis, "AF_CYCLIC_PITCH_A", "UT_LENGTH_MM", 12.0}, {kAnalysis, "AF_CYCLIC_PITCH_B", "UT_LENGTH_MM", 0.0}});
  EXPECT_EQ(stored_pitch_mm(test, 'A'), 12.0);
  EXPECT_EQ(stored_pitch_mm(test, 'B'), std::nullopt);
  EXPECT_EQ(stored_pitch_mm(storing({}), 'A'), std::nullopt);
}

TEST(StoredErrors, VersionsBefore20StoreMeansOfBothRuns) {
  EXPECT_TRUE(stores_cyclic_means(storing({}, "5.09.24")));
  EXPECT_TRUE(stores_cyclic_means(storing({}, "5")));
  EXPECT_FALSE(stores_cyclic_means(storing({}, "20.00.14")));
  EXPECT_FALSE(stores_cyclic_means(storing({}, "21")));
  EXPECT_FALSE(stores_cyclic_means(storing({}, "")));  // not stated: as today
}

// Every name that the software's analysis has is one of the table's.
TEST(StoredErrors, NamesAreThoseOfTheTable) {
  std::vector<std::string> names{"centre_a",      "centre_b",       "global_scale",
                                 "radius_change", "offset_a_shift", "offset_b_shift"};
  for (const auto& effect : built_in_catalogue()) {
    if (effect->rules.error_fit == ErrorFit::none) continue;
    for (const Parameter& parameter : effect->parameters) {
      if (parameter.kind != ParameterKind::gain) continue;
      names.push_back(parameter.row.empty() ? effect->name : effect->name + "_" + parameter.row);
    }
  }
  for (const Named& row : kRows) EXPECT_NE(std::find(names.begin(), names.end(), row.ours), names.end()) << row.ours;
}

}  // namespace
}  // namespace ballbar
