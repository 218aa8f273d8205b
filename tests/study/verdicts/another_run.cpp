#include "another_run.hpp"

#include <cmath>

namespace ballbar::verdicts {
namespace {

Track since(const Track& track, std::size_t before_s) {
  return {track.begin() + static_cast<std::ptrdiff_t>(before_s), track.end()};
}

std::vector<double> target_of(const Bench& bench, const Plan& plan, const std::vector<double>& time_s, Places places,
                              Chance& chance) {
  const Base& base = bench.scene.base;
  Track sum = unit_track(base, plan, base.time_constant_s);
  for (double& value : sum) value *= base.gain;
  for (const Hidden& hidden : bench.hidden) {
    const Track added = added_by(hidden, plan, places == Places::own ? plan : bench.scene.plan);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += added[i];
  }
  std::vector<double> values = at_rows(since(sum, plan.before_s), time_s);
  const std::vector<double> noise = drawn(bench.scene.scatter, time_s, chance);
  const double offset_um = chance.between(-20.0, 20.0);
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = rounded(offset_um + values[i] + noise[i], bench.scene.scatter.resolution_um);
  }
  return values;
}

}  // namespace

Series next_run(const Bench& bench, const Schedule& schedule, Places places, Chance& chance) {
  const Scene& scene = bench.scene;
  const Plan plan = plan_under(schedule, scene.plan, chance);
  Conventions conventions = scene.conventions;
  if (schedule.reading_s > 0.0) conventions.row_s = static_cast<std::size_t>(std::lround(schedule.reading_s));
  Series run;
  run.time_s = rows_of(plan, conventions.row_s);
  for (const Column& column : bench.made.data.columns) {
    run.columns.push_back({column.name, column.role, {}});
    for (std::size_t k = 0; k < kQuantities; ++k) {
      if (column.name != scene.name[k]) continue;
      const auto quantity = static_cast<Quantity>(k);
      Clock clock = drawn_clock(conventions, chance);
      clock.late_s = bench.made.late_s[k];
      run.columns.back().values =
          logged(since(plan[quantity], plan.before_s), quantity, run.time_s, conventions, clock, chance);
    }
    if (column.name == scene.target) run.columns.back().values = target_of(bench, plan, run.time_s, places, chance);
  }
  return run;
}

}  // namespace ballbar::verdicts
