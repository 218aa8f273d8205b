// What `plan --json` prints.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ballbar/diagnosis/next_test/plan.hpp"
#include "ballbar/formats/results/diagnosis_results.hpp"
#include "ballbar/formats/results/message.hpp"
#include "ballbar/units.hpp"
#include "plan/plan_sentence.hpp"

namespace ballbar {

struct PlanReport {
  TestPlan plan;
  Paragraph sentence;
};

template <>
inline constexpr auto kResult<Dwell> =
    ResultType("Dwell", "A part of a run in which nothing changes.",
               Field{"duration_min", [](const Dwell& of) { return min_from_s(of.duration_s); }},
               Field{"speed_rpm", &Dwell::speed_rpm},
               Field{"load", &Dwell::load, "times the load that the data had at this speed"},
               Field{"room_K", &Dwell::room_K, "warmer than in the data"},
               Field{"coolant_K", &Dwell::coolant_K, "warmer than in the data"});

template <>
inline constexpr auto kResult<Schedule> = ResultType("Schedule", "A run of the machine.",
                                                     Field{"reading_s", &Schedule::reading_s,
                                                           "from reading to reading"},
                                                     Field{"dwells", &Schedule::dwells, "one after the other"});

template <>
inline constexpr auto kResult<ExpectedTest> = ResultType(
    "ExpectedTest", "A run that was weighed.",
    Field{"test", [](const ExpectedTest& of) { return name_of(of); }, "random speeds, ..."},
    Field{"hours", &ExpectedTest::hours},
    Field{"p_right", &ExpectedTest::p_right, "that all that is missing is named and nothing else"},
    Field{"p_right_sigma", &ExpectedTest::p_right_sigma},
    Field{"p_part", &ExpectedTest::p_part, "that some of it is named that is not named now, and nothing else"},
    Field{"p_wrong", &ExpectedTest::p_wrong, "that another effect is named"},
    Field{"truths", &ExpectedTest::truths, "cases that were simulated"});

template <>
inline constexpr auto kResult<SensorToAdd> =
    ResultType("SensorToAdd", "A sensor that would help.",
               Field{"place", [](const SensorToAdd& of) -> Paragraph { return place_of(of); }},
               Field{"p_right", &SensorToAdd::p_right, "of the best run, with it"});

template <>
inline constexpr auto kResult<ExpectedCurve> = ResultType("ExpectedCurve", "What may be missing.",
                                                          Field{"effects",
                                                                [](const ExpectedCurve& of) { return label_of(of); }},
                                                          Field{"p", &ExpectedCurve::p, "of it now"});

constexpr auto of_plan(auto... get) { return in(&PlanReport::plan, get...); }
std::optional<Schedule> best_schedule(const std::vector<ExpectedTest>& tests);
std::vector<std::vector<std::string>> labels_of(const std::vector<std::vector<BoundEffect>>& groups);
std::vector<SensorToAdd> sensors_of(const TestPlan& plan);

template <>
inline constexpr auto kResult<PlanReport> = ResultType(
    "Plan", "The run of the machine that would decide what is missing.",
    Field{"sentence", &PlanReport::sentence, "what it says in plain words"},
    Field{"verdict", of_plan(&TestPlan::verdict), "of the data at hand"},
    Field{"decided", of_plan(&TestPlan::is_decided), "whether they decide it"},
    Field{"tests", of_plan(&TestPlan::tests), "runs that were weighed, the best first"},
    Field{"schedule", of_plan(&TestPlan::tests, &best_schedule), "of the best one; null: none is proposed"},
    Field{"inseparable", of_plan(&TestPlan::inseparable, &labels_of), "sets of effects that no run tells apart"},
    Field{"sensors", of_plan(&sensors_of), "that are lacking"},
    Field{"curves", of_plan(&TestPlan::curves), "what may be missing, the most probable first"});

}  // namespace ballbar
