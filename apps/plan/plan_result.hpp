// What `plan --json` prints.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ballbar/diagnosis/next_test/plan.hpp"
#include "ballbar/formats/results/diagnosis_results.hpp"
#include "ballbar/units.hpp"
#include "plan/plan_sentence.hpp"

namespace ballbar {

struct PlanReport {
  TestPlan plan;
  std::string sentence;
};

template <>
inline constexpr auto kResult<Dwell> =
    ResultType{"Dwell", "A part of a run in which nothing changes.",
               std::tuple{Field{"duration_min", [](const Dwell& of) { return min_from_s(of.duration_s); }, ""},
                          Field{"speed_rpm", &Dwell::speed_rpm, ""},
                          Field{"load", &Dwell::load, "times the load that the data had at this speed"},
                          Field{"room_K", &Dwell::room_K, "warmer than in the data"},
                          Field{"coolant_K", &Dwell::coolant_K, "warmer than in the data"}}};

template <>
inline constexpr auto kResult<Schedule> =
    ResultType{"Schedule", "A run of the machine.",
               std::tuple{Field{"reading_s", &Schedule::reading_s, "from reading to reading"},
                          Field{"dwells", &Schedule::dwells, "one after the other"}}};

template <>
inline constexpr auto kResult<ExpectedTest> = ResultType{
    "ExpectedTest", "A run that was weighed.",
    std::tuple{
        Field{"test", [](const ExpectedTest& of) { return name_of(of); }, "random speeds, ..."},
        Field{"hours", &ExpectedTest::hours, ""},
        Field{"p_right", &ExpectedTest::p_right, "that all that is missing is named and nothing else"},
        Field{"p_right_sigma", &ExpectedTest::p_right_sigma, ""},
        Field{"p_part", &ExpectedTest::p_part, "that some of it is named that is not named now, and nothing else"},
        Field{"p_wrong", &ExpectedTest::p_wrong, "that another effect is named"},
        Field{"truths", &ExpectedTest::truths, "cases that were simulated"}}};

template <>
inline constexpr auto kResult<SensorToAdd> = ResultType{
    "SensorToAdd", "A sensor that would help.",
    std::tuple{Field{"place", &place_of, ""}, Field{"p_right", &SensorToAdd::p_right, "of the best run, with it"}}};

template <>
inline constexpr auto kResult<ExpectedCurve> =
    ResultType{"ExpectedCurve", "What may be missing.",
               std::tuple{Field{"effects", [](const ExpectedCurve& of) { return label_of(of); }, ""},
                          Field{"p", &ExpectedCurve::p, "of it now"}}};

// Labels of effects that no test tells apart.
inline std::vector<std::vector<std::string>> inseparable_of(const PlanReport& report) {
  std::vector<std::vector<std::string>> groups;
  for (const std::vector<BoundEffect>& group : report.plan.inseparable) {
    groups.emplace_back();
    for (const BoundEffect& one : group) groups.back().push_back(label_of(one));
  }
  return groups;
}

template <>
inline constexpr auto kResult<PlanReport> = ResultType{
    "Plan", "The run of the machine that would decide what is missing.",
    std::tuple{
        Field{"sentence", &PlanReport::sentence, "what it says in plain words"},
        Field{"verdict", [](const PlanReport& of) { return of.plan.verdict; }, "of the data at hand"},
        Field{"decided", [](const PlanReport& of) { return of.plan.is_decided; }, "whether they decide it"},
        Field{"tests", [](const PlanReport& of) { return of.plan.tests; }, "runs that were weighed, the best first"},
        Field{"schedule",
              [](const PlanReport& of) {
                const std::vector<ExpectedTest>& tests = of.plan.tests;
                return tests.empty() ? std::nullopt : std::optional(tests.front().schedule);
              },
              "of the best one; null: none is proposed"},
        Field{"inseparable", &inseparable_of, "sets of effects that no run tells apart"},
        Field{"sensors",
              [](const PlanReport& of) {
                std::vector<SensorToAdd> sensors;
                if (of.plan.sensor) sensors.push_back(*of.plan.sensor);
                return sensors;
              },
              "that are lacking"},
        Field{"curves", [](const PlanReport& of) { return of.plan.curves; },
              "what may be missing, the most probable first"}}};

}  // namespace ballbar
