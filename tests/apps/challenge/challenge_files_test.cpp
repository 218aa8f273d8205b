#include "challenge/challenge_files.hpp"

#include <gtest/gtest.h>

#include "scratch_folder.hpp"

namespace ballbar {
namespace {

const std::vector<SealedSet>& sets() {
  static const std::vector<SealedSet> kSets{{.name = "01"}, {.name = "02"}};
  return kSets;
}

std::string complaint_about(const std::string& text) {
  const ScratchFolder folder;
  return complaint(folder, [&] { static_cast<void>(read_verdicts(text, "v.csv", sets())); });
}

TEST(BlindFiles, VerdictsByHand) {
  const std::vector<BlindVerdict> verdicts = read_verdicts(
      "\xef\xbb\xbf# mine\r\nset,verdict,effects\r\n02, equivalent ,\"expansion:temperature=T_a_degC; "
      "step\"\r\n\r\n01,named,gradient_bending:hot=T_a_degC,cold=T_b_degC\r\n",
      "v.csv", sets());
  ASSERT_EQ(verdicts.size(), 2U);
  EXPECT_EQ(verdicts[0].verdict, Verdict::named);
  EXPECT_EQ(label_of(verdicts[0].named.at(0)), "gradient_bending(T_a_degC, T_b_degC)");
  EXPECT_EQ(verdicts[1].verdict, Verdict::equivalent);
  EXPECT_TRUE(verdicts[1].named.empty());
  EXPECT_EQ(label_of(verdicts[1].reported.at(0)), "expansion(T_a_degC)");
  EXPECT_EQ(verdicts[1].reported.at(1).effect->name, "step");
}

TEST(BlindFiles, BadVerdictsAreNamed) {
  const std::string head = "set,verdict,effects\n";
  const std::pair<std::string, std::string> table[] = {
      {"", "v.csv: expected a verdict for each of 2 sets, found none for 01."},
      {"01,nothing,\n", "v.csv:1: expected the heading set,verdict,effects, found \"01,nothing,\"."},
      {head + "01\n", "v.csv:2: expected set,verdict,effects, found \"01\"."},
      {head + "../01,nothing,\n", "v.csv:2: expected a set from 01 to 02, found \"../01\"."},
      {head + "01,nothing,\n01,nothing,\n", "v.csv:3: expected each set once, found 01 again."},
      {head + "01,nothing,\n", "v.csv: expected a verdict for each of 2 sets, found none for 02."},
      {head + "01,maybe,\n",
       "v.csv:2: expected named, equivalent, unexplained, untestable or nothing, found \"maybe\"."},
      {head + "01,named,\n", "v.csv:2: expected effects behind named, found none."},
      {head + "01,nothing,step\n", "v.csv:2: expected no effects behind nothing, found \"step\"."},
      {head + "01,named,gradient_bending:hot=T_a_degC\n",
       "v.csv:2: expected all columns of gradient_bending or none, found 1 of 2."},
  };
  for (const auto& [text, message] : table) EXPECT_EQ(complaint_about(text), message) << text;
  const std::string unknown = complaint_about(head + "01,named,stepp\n");
  EXPECT_TRUE(unknown.starts_with("v.csv:2: expected an effect on a drift series, one of expansion, ")) << unknown;
  EXPECT_TRUE(unknown.ends_with(", found \"stepp\"; the nearest is step.")) << unknown;
}

}  // namespace
}  // namespace ballbar
