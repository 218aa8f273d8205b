#include "cases.hpp"

#include <algorithm>
#include <utility>

#include "../../libballbar/diagnosis/made_recordings.hpp"
#include "../next_test/adapter.hpp"
#include "../next_test/plans.hpp"
#include "../verdicts/another_run.hpp"
#include "../verdicts/cells.hpp"

namespace ballbar::ablation {
namespace {

constexpr const char* kVerdicts[] = {
    "nothing-ar0.9",    "nothing-held", "nothing-ramped", "nothing-late",   "nothing-rounded", "nothing-20fakes",
    "one-15-exact",     "one-15-held",  "one-15-ramped",  "one-15-late",    "one-15-0.1K",     "two-20",
    "step-20",          "step-one-20",  "poor-15",        "outside-driven", "outside-bar",     "outside-not-logged",
    "outside-left-out", "own-exponent", "own-tau"};

Case case_of(verdicts::Made made) {
  Case one{made.data, made.model, made.without, std::nullopt, {}, made.what};
  one.judged = [made = std::move(made)](const verdicts::Said& said) { return verdicts::judged(made, said); };
  return one;
}

// Of five recordings one has nothing hidden.
Case recordings(std::uint64_t seed) {
  static const Catalogue catalogue = built_in_catalogue();
  std::vector<const Effect*> effects;
  for (const auto& effect : catalogue) {
    if (effect->level == Level::recording && !effect->rules.is_base) effects.push_back(effect.get());
  }
  const Effect* hidden = seed % 5 == 0 ? nullptr : effects[seed % effects.size()];
  made::Plan plan;
  if (seed % 2 == 0) plan.sweeps = made::two_feeds();
  if (seed % 2 == 0) plan.readings = 120;
  Case one;
  one.data = made::recordings(plan, hidden, seed);
  one.model = recording_base_model(one.data);
  one.motion = Motion::linear_axes;
  if (hidden != nullptr && hidden->motions == std::vector{Motion::rotary_axis, Motion::spindle})
    one.motion = Motion::rotary_axis;
  one.judged = [hidden](const verdicts::Said& said) {
    verdicts::Judged judged;
    const auto is_it = [&](const verdicts::Member& member) {
      return hidden != nullptr && member.effect == hidden->name;
    };
    judged.wrong = !std::all_of(said.named.begin(), said.named.end(), is_it);
    judged.nothing_said = said.word == verdicts::Word::nothing;
    judged.right = hidden == nullptr ? judged.nothing_said : said.named.size() == 1 && !judged.wrong;
    return judged;
  };
  return one;
}

// A poor run and a staircase of 6 h after it.
Case two_runs(std::uint64_t seed) {
  verdicts::Recipe recipe;
  recipe.course = verdicts::Course::poor;
  recipe.d = 15.0;
  verdicts::Bench bench = verdicts::bench_of(recipe, "ablation of two runs", seed);
  verdicts::Chance chance("ablation of two runs, second", seed);
  const Series second =
      verdicts::next_run(bench, next_test::staircase(6.0, 12000.0, seed), verdicts::Places::machine, chance);
  next_test::Joined joined = next_test::joined(bench.made.model, {bench.made.data, second});
  Case one = case_of(std::move(bench.made));
  one.data = std::move(joined.data);
  one.model = std::move(joined.model);
  return one;
}

}  // namespace

std::vector<Cell> cells() {
  std::vector<Cell> result;
  for (const verdicts::Cell& cell : verdicts::cells()) {
    if (std::find(std::begin(kVerdicts), std::end(kVerdicts), cell.name) == std::end(kVerdicts)) continue;
    result.push_back({cell.name, [make = cell.make](std::uint64_t seed) { return case_of(make(seed)); }});
  }
  result.push_back({"recordings", recordings});
  result.push_back({"two-runs", two_runs});
  return result;
}

}  // namespace ballbar::ablation
