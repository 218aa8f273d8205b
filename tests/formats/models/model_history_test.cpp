// The ledger in a model's file: written, read back, taken back to the byte, and refused where a hand has been at it.
#include "ballbar/formats/models/model_history.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "ballbar/error.hpp"
#include "ballbar/formats/models/model_toml.hpp"

namespace ballbar {
namespace {

constexpr std::string_view kModel = R"toml(# what the spindle does
format = "ballbar-model 1"
target = "z_um"   # the axial one

# friction
[[effect]]
name = "speed_heating"
speed = "speed_rpm"   # of the log

# the instrument
[[effect]]
name = "linear_drift"
)toml";

LedgerRow start() {
  LedgerRow row;
  row.target = "z_um";
  row.data = {"run 1.csv"};
  row.parameters = 4;
  row.rmse_um = 12.3;
  return row;
}

LedgerRow change(std::string what) {
  LedgerRow row = start();
  row.change = std::move(what);
  row.rmse_um = 1.0 / 3.0;
  row.times_floor = 1.5;
  row.held_out_um = 0.5;
  row.likelihood_ratio = -0.25;
  row.threshold = 25.0;
  row.verdict = "supported";
  row.still_needed = {"speed_heating(speed_rpm)"};
  row.no_longer_needed = {"linear_drift", "a \"quoted\" one"};
  return row;
}

const std::vector<Term>& added() {
  static const std::vector<Term> terms{term_of("expansion", {"T_air_degC"})};
  return terms;
}

std::string once(std::string_view text) {
  return with_revision(text, "file", added(), {}, start(), change("+ expansion(T_air_degC)"));
}

TEST(model_history, written) {
  EXPECT_EQ(once(kModel), std::string(kModel) + R"toml(
[[effect]]
name = "expansion"
temperature = "T_air_degC"

[[history]]
revision = 0
change = "start"
target = "z_um"
data = ["run 1.csv"]
parameters = 4
rmse_um = 12.3
verdict = "start"

[[history]]
revision = 1
change = "+ expansion(T_air_degC)"
target = "z_um"
data = ["run 1.csv"]
parameters = 4
rmse_um = 0.3333333333333333
times_floor = 1.5
held_out_um = 0.5
likelihood_ratio = -0.25
threshold = 25.0
verdict = "supported"
still_needed = ["speed_heating(speed_rpm)"]
no_longer_needed = ["linear_drift", "a \"quoted\" one"]
effects_before = '''


# friction
[[effect]]
name = "speed_heating"
speed = "speed_rpm"   # of the log

# the instrument
[[effect]]
name = "linear_drift"
'''
)toml");
}

TEST(model_history, read_back) {
  EXPECT_TRUE(read_ledger(kModel, "file").empty());
  const std::vector<LedgerRow> rows = read_ledger(once(kModel), "file");
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].change, "start");
  EXPECT_TRUE(std::isnan(rows[0].times_floor));
  EXPECT_TRUE(std::isnan(rows[0].likelihood_ratio));
  const LedgerRow expected = change("+ expansion(T_air_degC)"), &found = rows[1];
  EXPECT_EQ(found.revision, 1u);
  EXPECT_EQ(found.change, expected.change);
  EXPECT_EQ(found.target, expected.target);
  EXPECT_EQ(found.data, expected.data);
  EXPECT_EQ(found.parameters, expected.parameters);
  EXPECT_EQ(found.rmse_um, expected.rmse_um);
  EXPECT_EQ(found.times_floor, expected.times_floor);
  EXPECT_EQ(found.held_out_um, expected.held_out_um);
  EXPECT_EQ(found.likelihood_ratio, expected.likelihood_ratio);
  EXPECT_EQ(found.threshold, expected.threshold);
  EXPECT_EQ(found.verdict, expected.verdict);
  EXPECT_EQ(found.still_needed, expected.still_needed);
  EXPECT_EQ(found.no_longer_needed, expected.no_longer_needed);
}

// Figures that 0.2.0 wrote: they are read over, and stay in the rows where they stand.
TEST(model_history, of_version_0_2_0) {
  std::string text = once(kModel);
  const std::string threshold = "threshold = 25.0\n";
  text.insert(text.find(threshold) + threshold.size(), "best_surrogate_fall = 0.27\nsurrogate_forecast_um = 3.5\n");
  const std::vector<LedgerRow> rows = read_ledger(text, "file");
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[1].threshold, 25.0);
  EXPECT_EQ(rows[1].verdict, "supported");
  EXPECT_EQ(without_last_revision(text, "file"), kModel);
  const std::string more = with_revision(text, "file", {}, {}, start(), change("- x"));
  EXPECT_TRUE(more.starts_with(text));
  EXPECT_EQ(more.rfind("surrogate"), text.rfind("surrogate"));
}

TEST(model_history, taken_back_to_the_byte) {
  const std::string head = "format = \"ballbar-model 1\"\ntarget = \"z_um\"";
  std::string windows(kModel);
  for (std::size_t at = 0; (at = windows.find('\n', at)) != std::string::npos; at += 2) windows.replace(at, 1, "\r\n");
  const std::string texts[] = {
      std::string(kModel),
      "\xEF\xBB\xBF" + std::string(kModel),
      std::string(kModel) + "\n\n",
      windows,
      head,
      head + "\n",
      head + "\n\n# to come\n",
      head + "\n[[effect]]\nname = 'expansion'\ntemperature = '''T_degC'''",
  };
  for (const std::string& text : texts) {
    const std::string first = once(text);
    EXPECT_EQ(without_last_revision(first, "file"), text);
    const std::vector<Term> more{term_of("settling", {})};
    const std::string second = with_revision(first, "file", more, {}, start(), change("+ settling"));
    EXPECT_EQ(read_ledger(second, "file").size(), 3u);
    EXPECT_EQ(without_last_revision(second, "file"), first);
  }
}

TEST(model_history, effects_taken_out_with_their_comments) {
  const std::size_t both[] = {0, 1};
  const std::string text = with_revision(kModel, "file", added(), both, start(), change("+ expansion(T_air_degC)"));
  const Model model = read_model(text, "file");
  ASSERT_EQ(model.terms.size(), 1u);
  EXPECT_EQ(label_of(model.terms[0]), "expansion(T_air_degC)");
  const std::string effects = text.substr(0, text.find("[[history]]"));
  EXPECT_EQ(effects.find("# friction"), std::string::npos);
  EXPECT_NE(effects.find("# the axial one"), std::string::npos);
  EXPECT_EQ(without_last_revision(text, "file"), kModel);
  const std::size_t second[] = {1};
  EXPECT_EQ(without_last_revision(with_revision(text, "file", {}, {}, start(), change("- x")), "file"), text);
  EXPECT_EQ(
      read_model(with_revision(kModel, "file", {}, second, start(), change("- linear_drift")), "file").terms.size(),
      1u);
}

TEST(model_history, comments_elsewhere_survive_what_is_taken_back) {
  std::string text = once(kModel);
  text.replace(text.find("# what the spindle does"), 23, "# edited since");
  text.insert(text.find("[[history]]"), "# the story\n");
  std::string expected(kModel);
  expected.replace(0, 23, "# edited since");
  EXPECT_EQ(without_last_revision(text, "file"), expected + "# the story\n");
}

struct Bad {
  const char *from, *to, *message;
};

TEST(model_history, edited_by_hand) {
  const Bad rows[] = {
      {"revision = 1", "revision = 2", "file:28:12: expected revision 1, found 2."},
      {"revision = 1", "revision = \"1\"", "file:28:12: expected an integer for revision, found the text \"1\"."},
      {"revision = 1", "revison = 1",
       "file:28:1: expected one of the keys revision, change, target, data, parameters, rmse_um, times_floor, "
       "held_out_um, likelihood_ratio, threshold, forecast_um, discrepancy_um, verdict, still_needed, "
       "no_longer_needed, effects_before in [[history]] 2, found \"revison\"; the nearest is revision."},
      {"\"+ expansion(T_air_degC)\"", "\"start\"",
       "file:29:10: expected \"+ effect\", \"- effect\" or \"= parameter\", found \"start\"."},
      {"change = \"start\"", "change = \"begin\"", "file:20:10: expected \"start\", found \"begin\"."},
      {"parameters = 4", "parameters = -4", "file:23:14: expected parameters of at least 0, found -4."},
      {"rmse_um = 12.3", "rmse_um = -1.0", "file:24:11: expected rmse_um of at least 0, found -1."},
      {"rmse_um = 12.3\n", "", "file:18:1: expected the key rmse_um in [[history]] 1, found none."},
      {"verdict = \"start\"", "verdict = \"start\"\neffects_before = \"\"",
       "file:26:18: expected no effects_before in revision 0, which nothing is before."},
  };
  for (const Bad& row : rows) {
    std::string text = once(kModel);
    const std::size_t at = text.find(row.from);
    ASSERT_NE(at, std::string::npos) << row.from;
    text.replace(at, std::string_view(row.from).size(), row.to);
    for (int what = 0; what < 3; ++what) {
      try {
        if (what == 0) read_ledger(text, "file");
        if (what == 1) without_last_revision(text, "file");
        if (what == 2) once(text);
        ADD_FAILURE() << row.to << " was taken";
      } catch (const Error& error) {
        EXPECT_STREQ(error.what(), row.message);
      }
    }
  }
}

void expect_not_undone(const std::string& text, const std::string& message) {
  try {
    without_last_revision(text, "file");
    ADD_FAILURE() << text << "\nwas taken";
  } catch (const Error& error) {
    EXPECT_EQ(error.what(), message);
  }
}

TEST(model_history, not_taken_back) {
  expect_not_undone(std::string(kModel),
                    "file: expected a revision to take back, found none: the model is as it started.");
  std::string text = once(kModel);
  text.replace(text.rfind("speed = "), 8, "sped = ");
  expect_not_undone(
      text,
      "file:41:18: expected the effects as they were, found a fault: the text:8:1: expected one of the keys "
      "name, speed, gain_um_per_krpm_a, time_constant_s, exponent in [[effect]] 1, found \"sped\"; the "
      "nearest is speed.");
  text = once(kModel);
  text.resize(text.find("effects_before"));
  expect_not_undone(text, "file:27:1: expected the key effects_before in [[history]] 2, found none.");
  text = once(kModel);
  text += "\n[[effect]]\nname = \"settling\"\n";
  expect_not_undone(text, "file:54:1: expected the effects above the history, found one below it.");
  const std::string head = "format = \"ballbar-model 1\"\ntarget = \"z_um\"\n";
  expect_not_undone(head + "history = [{}]\n",
                    "file:3:12: expected the history as tables [[history]], found an array.");
  expect_not_undone(head + "history = []\n",
                    "file:3:11: expected the history as tables [[history]], found an empty array.");
  expect_not_undone(head + "effect = [{ name = \"settling\" }]\n",
                    "file:3:11: expected effects as tables [[effect]], found an array.");
}

}  // namespace
}  // namespace ballbar
