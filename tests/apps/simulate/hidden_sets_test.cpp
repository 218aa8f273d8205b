#include "simulate/hidden_sets.hpp"

#include <gtest/gtest.h>

#include "ballbar/formats/text/file_bytes.hpp"
#include "scratch_folder.hpp"

namespace ballbar {
namespace {

TEST(HiddenSets, AreTheSameForTheSameSeed) {
  const ScratchFolder scratch;
  write_hidden_sets(scratch.path() / "a", 1, 40);
  write_hidden_sets(scratch.path() / "b", 1, 40);
  write_hidden_sets(scratch.path() / "c", 1, 41);
  const auto bytes = [&](const char* folder, const char* file) {
    return read_bytes(scratch.path() / folder / file, kLargestText);
  };
  for (const char* file : {"01/data.csv", "01/model.toml", "answers.json", "README.txt"}) {
    EXPECT_EQ(bytes("a", file), bytes("b", file));
  }
  EXPECT_NE(bytes("a", "01/data.csv"), bytes("c", "01/data.csv"));
}

TEST(HiddenSets, AnswersAreReadAsTheyWereWritten) {
  const ScratchFolder scratch;
  scratch.write("answers.json", R"({"format": "ballbar-hidden 1", "seed": 1, "sets": [
    {"set": "01", "kind": "two", "truth": "both", "match": [], "d": [7.0, 8.5], "amplitude_um": [1.0, 2.0],
     "hidden": [{"effect": "lagged_expansion", "columns": ["T_a"]}, {"effect": "centrifugal_shift", "columns": []}]}]})");
  const std::vector<ScoredSet> sets = read_answers(scratch.path());
  ASSERT_EQ(sets.size(), 1U);
  EXPECT_EQ(sets[0].name, "01");
  const BlindAnswer& answer = sets[0].answer;
  EXPECT_EQ(answer.kind, BlindKind::two);
  EXPECT_EQ(answer.what, "both");
  EXPECT_EQ(answer.d, (std::vector<double>{7.0, 8.5}));
  EXPECT_EQ(answer.amplitude_um, (std::vector<double>{1.0, 2.0}));
  ASSERT_EQ(answer.hidden.size(), 2U);
  EXPECT_EQ(label_of(answer.hidden[0]), "lagged_expansion(T_a)");
  EXPECT_TRUE(answer.hidden[1].columns.empty());
  EXPECT_TRUE(answer.match.empty());
}

TEST(HiddenSets, AnUnknownEffectIsRefused) {
  const ScratchFolder scratch;
  scratch.write("answers.json", R"({"format": "ballbar-hidden 1", "sets": [
    {"set": "01", "kind": "one", "truth": "", "hidden": [{"effect": "magic", "columns": []}]}]})");
  EXPECT_EQ(
      complaint(scratch, [&] { static_cast<void>(read_answers(scratch.path())); }),
      "DIR/answers.json: expected answers of ballbar simulate --hidden (ballbar-hidden 1), found an effect that is "
      "not in the catalogue.");
}

}  // namespace
}  // namespace ballbar
