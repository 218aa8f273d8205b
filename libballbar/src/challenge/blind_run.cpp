// A blind set's machine once more, under a schedule.
#include <cmath>

#include "challenge/blind_parts.hpp"

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

}  // namespace
}  // namespace blind

Series next_run(BlindKind kind, std::uint64_t seed, const Schedule& schedule, std::uint64_t number,
                const Catalogue& catalogue) {
  const blind::Drawn first = blind::drawn_set(kind, seed, catalogue);
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

}  // namespace ballbar
