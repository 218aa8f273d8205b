// A blind set's machine once more, under a schedule.
#include <cmath>

#include "challenge/blind_parts.hpp"
#include "numerics/interpolation.hpp"

namespace ballbar {
namespace blind {

void log_twice(Series& logged, const Series& sensors) {
  std::erase_if(logged.columns, [](const Column& column) { return column.name == "T_head_degC"; });
  Column head = *find_column(sensors, "T_head_degC");
  for (double& value : head.values) value = simulation::rounded(value, 0.1);
  logged.columns.push_back(head);
  head.name = "T_head_2_degC";
  logged.columns.push_back(std::move(head));
}

namespace {

constexpr double kLargestOffset_um = 20.0;

// Rows from that time on, which becomes 0.
Series since(Series series, double before_s) {
  const auto first = std::lower_bound(series.time_s.begin(), series.time_s.end(), before_s) - series.time_s.begin();
  series.time_s.erase(series.time_s.begin(), series.time_s.begin() + first);
  for (double& time_s : series.time_s) time_s -= before_s;
  for (Column& column : series.columns) column.values.erase(column.values.begin(), column.values.begin() + first);
  return series;
}

// A curve of straight lines, read to and fro from some time on.
double to_and_fro(const std::vector<double>& time_s, const std::vector<double>& values, double at_s) {
  const double length_s = time_s.back() - time_s.front();
  if (!(length_s > 0.0)) return values.front();
  double since_s = std::fmod(at_s, 2.0 * length_s);
  if (since_s > length_s) since_s = 2.0 * length_s - since_s;
  const std::optional<Place> place = place_of(time_s, time_s.front() + since_s);
  return place ? value_at(values, *place) : values.back();
}

}  // namespace
}  // namespace blind

Series next_run(BlindKind kind, std::uint64_t seed, const Schedule& schedule, std::uint64_t number,
                const Catalogue& catalogue) {
  const blind::DrawnSet first = blind::drawn_set(kind, seed, catalogue);
  blind::Random random = simulation::stream_of(seed, simulation::Stream::blind_run, number);
  const double offset_um = blind::between(random, -blind::kLargestOffset_um, blind::kLargestOffset_um);
  blind::AnotherRun another = blind::workshop_under(schedule, first.workshop, random);
  blind::Workshop& run = another.workshop;
  if (first.head_twice) blind::log_twice(run.logged, run.sensors);

  blind::Scatter scatter = first.scatter;
  scatter.phi = std::pow(scatter.phi, run.clock.interval_s / first.workshop.clock.interval_s);
  Column measured{first.set.model.targets.front(), Role::measured,
                  blind::noise_um(run.logged.time_s.size(), scatter, random)};
  for (const blind::Source& source : first.sources) {
    const std::vector<double> added_um = source.adds(run, random);
    for (std::size_t i = 0; i < added_um.size(); ++i) measured.values[i] += source.scale * added_um[i];
  }
  for (double& value : measured.values) value = simulation::rounded(offset_um + value, scatter.resolution_um) + 0.0;
  run.logged.columns.push_back(std::move(measured));
  return blind::since(std::move(run.logged), another.before_s);
}

Series next_run(const VirtualSpindle& machine, const Schedule& schedule, std::uint64_t seed, std::uint64_t number) {
  blind::Random random = simulation::stream_of(seed, simulation::Stream::blind_run, number);
  blind::Day day = blind::day_under(schedule, machine.plan, machine.clock, random);
  if (!machine.plan.room_time_s.empty()) {
    const double from_s = blind::between(random, 0.0, 2.0 * 86400.0);
    constexpr double kEach_s = 600.0;
    for (double time_s = 0.0; time_s <= day.plan.end_s + kEach_s; time_s += kEach_s) {
      const double set_K = time_s < day.before_s ? 0.0 : dwell_at(schedule, time_s - day.before_s).room_K;
      day.plan.room_time_s.push_back(time_s);
      day.plan.room_degC.push_back(
          set_K + blind::to_and_fro(machine.plan.room_time_s, machine.plan.room_degC, from_s + time_s));
    }
  }
  const ThermalRun run = run_of(machine.body, day.plan, machine.mechanisms, day.clock);
  Series series = measured_series(run, machine.measurement, random());
  for (Column& column : series.columns) {
    if (column.role != Role::measured) continue;
    const double offset_um = blind::between(random, -blind::kLargestOffset_um, blind::kLargestOffset_um);
    const double resolution_um = machine.measurement.resolution_um;
    for (double& value : column.values) value = simulation::rounded(value + offset_um, resolution_um) + 0.0;
  }
  return blind::since(std::move(series), day.before_s);
}

}  // namespace ballbar
