#include "history/fleet_text.hpp"

#include <gtest/gtest.h>

#include "history/fleet_result.hpp"

namespace ballbar {
namespace {

// One machine with a step of 4.5 um in January 2026, one without anything.
Fleet small_fleet() {
  Fleet fleet;
  fleet.judged = 60;
  fleet.found = 1;
  FleetMachine machine;
  machine.name = "mill-01";
  machine.tests = 3;
  machine.need = Need::finding;
  machine.reason = "One quantity stepped.";
  machine.reason_finding = 0;
  FleetSeries series;
  series.name = "play";
  series.unit = "um";
  series.tests = {0, 1, 2};
  series.time_s = {1767225600.0, 1769904000.0, 1772323200.0};  // the first days of January, February and March 2026
  series.value = {1.0, 5.5, 5.5};
  series.fitted = {1.0, 5.5, 5.5};
  series.level = 5.5;
  series.sigma = 0.1;
  series.scatter = 0.2;
  machine.series.push_back(series);
  Finding step;
  step.quantities.push_back({0, 4.5, 0.25, 1e-6, 1e-4});
  step.from_s = series.time_s[0];
  step.to_s = series.time_s[1];
  step.p_value = 1e-6;
  step.q_value = 1e-4;
  step.sentence = machine.reason;
  step.remedy = "Adjust it.";
  machine.findings.push_back(step);
  fleet.machines.push_back(machine);
  FleetMachine other;
  other.name = "mill-02";
  fleet.machines.push_back(other);
  return fleet;
}

TEST(fleet_text, says_the_conclusion_first) {
  EXPECT_EQ(fleet_text(small_fleet()),
            "1 of 2 machines: 0 beyond a tolerance, 0 on the way to one, 1 with something to look at; 1 with\n"
            "nothing.\n"
            "60 questions were asked, 1 answered with yes; at most 5 % of such answers are by chance.\n"
            "\n"
            "machine  needs  found  quantity             size     between         and        q\n"
            "mill-01   look   step   play XY  +4.50 ± 0.25 um  2026-01-01  2026-02-01  < 0.001\n"
            "\n"
            "mill-01: One quantity stepped. Adjust it.\n");
}

TEST(fleet_text, says_that_there_is_nothing) {
  Fleet fleet;
  fleet.machines.resize(3);
  EXPECT_EQ(fleet_text(fleet),
            "Nothing stands out on any of 3 machines.\n"
            "0 questions were asked, 0 answered with yes; at most 5 % of such answers are by chance.\n");
}

TEST(fleet_result, has_every_key) {
  const nlohmann::ordered_json json = json_of(small_fleet());
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
