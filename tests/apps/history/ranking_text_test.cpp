#include <gtest/gtest.h>

#include "history/history_result.hpp"
#include "history/history_text.hpp"
#include "history/machine_folder.hpp"

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
  machine.reason = as_it_is("One quantity stepped.");
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
  step.remedy = as_it_is("Adjust it.");
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
  for (MachineHistory& machine : history.machines) machine.judged = 2;
  history.judged = 6;
  EXPECT_EQ(ranking_text(history),
            "No significant change on any of 3 machines.\n"
            "6 quantities tested, 0 significant; at most 5 % of these by chance.\n");
  history.machines.back().judged = 0;
  EXPECT_TRUE(ranking_text(history).starts_with(
      "No significant change on any of 3 machines; 1 machine with too few tests to show one.\n"));
}

TEST(ranking_text, says_first_that_nothing_could_be_tested) {
  History history;
  history.machines.resize(3);
  const std::string text = ranking_text(history);
  EXPECT_TRUE(text.starts_with("Nothing could be tested on any of 3 machines: ")) << text;
  EXPECT_EQ(text.find("quantities tested"), std::string::npos) << text;
}

TEST(machine_folder, is_that_of_the_machine_where_a_date_names_the_test) {
  const auto folder = [](const char* path) { return machine_folder(path).generic_string(); };
  EXPECT_EQ(folder("plant/mill-01/2025-01-20"), "plant/mill-01");
  EXPECT_EQ(folder("plant/mill-01/2025/20250120 after crash"), "plant/mill-01");
  EXPECT_EQ(folder("plant/mill-01/20.1.2025_b"), "plant/mill-01");
  EXPECT_EQ(folder("plant/mill-01/2025-W03"), "plant/mill-01");
  EXPECT_EQ(folder("plant/mill-01/2025-01"), "plant/mill-01");
  EXPECT_EQ(folder("2025-01-20"), "");
  for (const char* own : {"plant/mill-01", "plant/2041", "plant/100234", "plant/DMU-2020-01", "plant/2025-13-45"})
    EXPECT_EQ(folder(own), own);
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
