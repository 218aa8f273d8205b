#include "next_test/loop.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "next_test/adapter.hpp"
#include "next_test/plans.hpp"

namespace ballbar::next_test {
namespace {

using verdicts::Course;
using verdicts::Logging;

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

Stage judged_stage(const verdicts::Bench& bench, const Joined& joined, Diagnosis& found) {
  Stage stage;
  const auto start = std::chrono::steady_clock::now();
  found = diagnose(joined.model, joined.data);
  stage.diagnosis_s = seconds_since(start);
  stage.said = verdicts::said_of(found);
  stage.said.took_s = stage.diagnosis_s;
  stage.judged = verdicts::judged(bench.made, stage.said);
  return stage;
}

double highest_rpm(const Series& data) {
  double highest = 0.0;
  for (const Column& column : data.columns) {
    if (column.role != Role::speed) continue;
    for (const double rpm : column.values) highest = std::max(highest, std::abs(rpm));
  }
  return highest;
}

std::optional<Design> designed(const Joined& joined, const Diagnosis& found, const LoopOptions& options,
                               std::uint64_t seed) {
  const double max_rpm = options.max_rpm > 0.0 ? options.max_rpm : highest_rpm(joined.data);
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  if (options.plan == "design") return plan_of(joined, found, options.hours, max_rpm, seed);
  if (options.plan == "staircase") return Design{staircase(options.hours, max_rpm, seed), nothing};
  for (FixedPlan& plan : fixed_plans(joined.data, options.hours, max_rpm)) {
    if (plan.name == options.plan) return Design{std::move(plan.schedule), nothing};
  }
  throw std::runtime_error("expected design, staircase, fixed or the name of a plan, found " + options.plan);
}

}  // namespace

std::vector<Cell> cells() {
  struct Condition {
    const char* name;
    Logging logging = Logging::exact;
    double most_late = 0.0, kelvin_step = 0.01;
  };
  constexpr Condition kConditions[] = {
      {"exact"}, {"held", Logging::held}, {"late", Logging::exact, 1.0}, {"0.1K", Logging::exact, 0.0, 0.1}};
  std::vector<Cell> result;
  for (const auto& [course, name] : {std::pair{Course::one_speed, "speed"}, std::pair{Course::poor, "poor"}}) {
    for (const Condition& condition : kConditions) {
      verdicts::Recipe recipe;
      recipe.course = course;
      recipe.logging = condition.logging;
      recipe.most_late = condition.most_late;
      recipe.kelvin_step = condition.kelvin_step;
      const std::string cell = fmt::format("{}-{}", name, condition.name);
      result.push_back({cell, cell == "poor-exact" ? "poor-10" : cell, recipe});  // the sets of study_verdicts
    }
  }
  return result;
}

Looped looped(const Cell& cell, std::uint64_t seed, const LoopOptions& options) {
  verdicts::Bench bench = verdicts::bench_of(cell.recipe, cell.stream, seed);
  std::vector<Series> runs{bench.made.data};
  Joined data = joined(bench.made.model, runs);
  Diagnosis found;
  Looped result;
  result.stages.push_back(judged_stage(bench, data, found));
  bool goes_on = true;
  for (std::size_t number = 1; number <= options.stages; ++number) {
    Stage stage = result.stages.back();
    stage.is_tested = false;
    std::optional<Design> design;
    const auto start = std::chrono::steady_clock::now();
    goes_on = goes_on && stage.said.word != verdicts::Word::named;
    if (goes_on) design = designed(data, found, options, 100 * seed + number);
    goes_on = design.has_value();
    if (design) {
      const double design_s = seconds_since(start), hours = stage.hours + duration_s(design->schedule) / 3600.0;
      verdicts::Chance chance(fmt::format("{} run {}", cell.stream, number), seed);
      runs.push_back(verdicts::next_run(bench, design->schedule, options.places, chance));
      data = joined(bench.made.model, runs);
      stage = judged_stage(bench, data, found);
      stage.is_tested = true;
      stage.hours = hours;
      stage.promised = design->promised;
      stage.design_s = design_s;
    }
    result.stages.push_back(std::move(stage));
  }
  result.made = std::move(bench.made);
  return result;
}

}  // namespace ballbar::next_test
