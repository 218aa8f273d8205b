#include <gtest/gtest.h>

#include "history/history_result.hpp"
#include "history/history_text.hpp"

namespace ballbar {
namespace {

// One machine with a step of 4.5 um in January 2026, one without anything.
History small_plant() {
  History history;
  history.judged = 60;
  history.found = 1;
  MachineHistory machine;
  machine.name = "mill-01";
  machine.tests = 3;
  machine.need = Need::finding;
  machine.reason = "One quantity stepped.";
  machine.reason_finding = 0;
  QuantityHistory series;
  series.name = "play";
  series.unit = "um";
  series.tests = {0, 1, 2};
  series.time_s = {1767225600.0, 1769904000.0, 1772323200.0};  // the first days of January, February and March 2026
  series.value = {1.0, 5.5, 5.5};
  series.fitted = {1.0, 5.5, 5.5};
  series.level = 5.5;
  series.level_sigma = 0.1;
  series.scatter = 0.2;
  machine.series.push_back(series);
  Finding step;
  step.quantities.push_back({0, series.name, series.unit, series.plane, 4.5, 0.25, 1e-6, 1e-4});
  step.from_s = series.time_s[0];
  step.to_s = series.time_s[1];
  step.p_value = 1e-6;
  step.q_value = 1e-4;
  step.sentence = machine.reason;
  step.remedy = "Adjust it.";
  machine.findings.push_back(step);
  history.machines.push_back(machine);
  MachineHistory other;
  other.name = "mill-02";
  history.machines.push_back(other);
  return history;
}

TEST(ranking_text, says_the_conclusion_first) {
  EXPECT_EQ(ranking_text(small_plant()),
            "Findings on 1 of 2 machines: 0 beyond a tolerance, 0 drifting towards one, 1 with another change.\n"
            "60 quantities tested, 1 significant; at most 5 % of these by chance.\n"
            "\n"
            "machine  status  finding  quantity             size        from          to        q\n"
            "mill-01   check     step   play XY  +4.50 ± 0.25 um  2026-01-01  2026-02-01  < 0.001\n"
            "\n"
            "mill-01: One quantity stepped. Adjust it.\n");
}

TEST(ranking_text, says_that_there_is_nothing) {
  History history;
  history.machines.resize(3);
  EXPECT_EQ(ranking_text(history),
            "No significant change on any of 3 machines.\n"
            "0 quantities tested, 0 significant; at most 5 % of these by chance.\n");
}

TEST(history_result, has_every_key) {
  const nlohmann::ordered_json json = json_of(small_plant());
  EXPECT_EQ(json["machines"][0]["need"], "finding");
  EXPECT_EQ(json["machines"][0]["findings"][0]["kind"], "step");
  EXPECT_EQ(json["machines"][0]["findings"][0]["from"], "2026-01-01");
  EXPECT_EQ(json["machines"][0]["findings"][0]["quantities"][0]["size"], 4.5);
  EXPECT_EQ(json["machines"][0]["series"][0]["dates"][2], "2026-03-01");
  EXPECT_TRUE(json["machines"][1]["first"].is_null());
  EXPECT_EQ(json["judged"], 60);
  EXPECT_EQ(json["false_discovery_rate"], 0.05);
}

}  // namespace
}  // namespace ballbar
