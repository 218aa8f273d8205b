#include "simulate/fleet_toml.hpp"

#include <fmt/format.h>

#include "ballbar/error.hpp"
#include "text/toml_source.hpp"

namespace ballbar {
namespace {

constexpr std::string_view kFleetFormat = "ballbar-fleet 1";

constexpr Key kFleetKeys[] = {
    {"format", "text", "\"ballbar-fleet 1\"; needed"},
    {"title", "text", "of every test"},
    {"seed", "number", "of all that is drawn; default 1; `--seed` goes before it"},
    {"started", "date and time", "begin of the first month; needed"},
    {"machines", "number", "default 40"},
    {"months", "number", "default 36"},
    {"machine_name", "text", "a machine's number follows it; default \"machine\""},
    {"missing_share", "1", "of the months without a test; default 0.06"},
    {"days_of_month", "days", "within which a test is made, about the month's middle; default 16"},
    {"other_planes_share", "1", "of the machines that are tested in YZ and ZX too; default 0.3"},
    {"other_planes_a_year", "number", "how often, at most 12; default 3"},
    {"bars", "number", "serial numbers in use; default 4"},
    {"bar_spread_um_per_m", "um/m", "by which the bars differ; default 5"},
    {"test", "table", "the circle and its readings"},
    {"scatter", "table", "from test to test"},
    {"error", "tables", "an error of all machines each"},
    {"story", "tables", "of one machine each"},
};
constexpr Key kFleetTestKeys[] = {
    {"nominal_length_mm", "mm", "default 100"},
    {"feed_mm_per_min", "mm/min", "default 1000"},
    {"readings", "number", "of each direction; default 500"},
    {"noise_um", "um", "standard deviation of a reading; default 0.15"},
    {"autocorrelation", "1", "of that noise, from 0 to below 1; default 0.9"},
    {"resolution_um", "um", "0: not rounded; default 0.1"},
    {"setup_um", "um", "standard deviation of the centre; default 10"},
};
constexpr Key kFleetScatterKeys[] = {
    {"tail_freedom", "1", "of Student's t, whole; 0: normal; default 4"},
    {"bad_share", "1", "of the tests, set up badly; default 0.03"},
    {"bad_factor", "1", "by which these scatter more; default 3"},
    {"day_K", "K", "temperature of the day; default 1"},
    {"hall_K", "K", "of the season, to either side; default 2"},
    {"scale_um_per_m_per_K", "um/m/K", "what the scales show of it; default 1"},
    {"large_share", "1", "of the machines, with larger constants; default 0.1"},
    {"large_factor", "1", "by which they are larger; default 4"},
};
constexpr Key kFleetErrorKeys[] = {
    {"name", "text", "as in a table of errors, without axis; without side for both: \"squareness\"; needed"},
    {"mean", "its unit", "of the machines' constants; default 0"},
    {"spread", "its unit", "standard deviation of these; default 0"},
    {"scatter", "its unit", "from test to test; default 0"},
};
constexpr Key kFleetStoryKeys[] = {
    {"machine", "number", "from 1 on; needed"},
    {"kind", "text", "\"wear\", \"crash\", \"season\", \"replaced_part\" or \"instrument\"; needed"},
    {"month", "number", "since when, from 0 on; default 0"},
    {"errors", "table",
     "by name with axis or plane, `squareness_xy`, `scale_x`: a year (`wear`), at once (`crash`), to either side "
     "(`season`), before (`replaced_part`)"},
    {"bar", "text", "`instrument`: the new serial number"},
    {"bar_um_per_m", "um/m", "by which it measures more; default 0"},
};

// At least 0, and at most so many.
void take_fleet_count(std::size_t& value, const TomlTable& table, std::string_view key, std::int64_t most = 100000) {
  const std::optional<std::int64_t> read = integer(table, key);
  if (!read) return;
  if (*read < 0 || *read > most) {
    fail_at_key(table, key, fmt::format("expected a count from 0 to {} for {}, found {}.", most, key, *read));
  }
  value = static_cast<std::size_t>(*read);
}

void take_share(double& value, const TomlTable& table, std::string_view key, double below = 1.0) {
  const std::optional<double> read = number(table, key);
  if (!read) return;
  if (*read < 0.0 || *read > below) {
    fail_at_key(table, key, fmt::format("expected a number from 0 to {:g} for {}, found {:g}.", below, key, *read));
  }
  value = *read;
}

void take_size(double& value, const TomlTable& table, std::string_view key) { take_share(value, table, key, 1e9); }

void read_fleet_test(const TomlTable& table, VirtualFleet& fleet) {
  expect_keys(table, kFleetTestKeys);
  take(fleet.nominal_length_mm, positive(table, "nominal_length_mm"));
  take(fleet.feed_mm_per_min, positive(table, "feed_mm_per_min"));
  take_fleet_count(fleet.readings, table, "readings");
  take_size(fleet.noise_um, table, "noise_um");
  take_share(fleet.autocorrelation, table, "autocorrelation", 0.9999);
  take_size(fleet.resolution_um, table, "resolution_um");
  take_size(fleet.setup_um, table, "setup_um");
}

void read_fleet_scatter(const TomlTable& table, VirtualFleet& fleet) {
  expect_keys(table, kFleetScatterKeys);
  take_size(fleet.tail_freedom, table, "tail_freedom");
  take_share(fleet.bad_share, table, "bad_share");
  take_size(fleet.bad_factor, table, "bad_factor");
  take_size(fleet.day_K, table, "day_K");
  take_size(fleet.hall_K, table, "hall_K");
  take(fleet.scale_um_per_m_per_K, number(table, "scale_um_per_m_per_K"));
  take_share(fleet.large_share, table, "large_share");
  take_size(fleet.large_factor, table, "large_factor");
}

ErrorSpread read_fleet_error(const TomlTable& table) {
  expect_keys(table, kFleetErrorKeys);
  ErrorSpread error;
  error.name = required(string, table, "name");
  take(error.mean, number(table, "mean"));
  take_size(error.spread, table, "spread");
  take_size(error.scatter, table, "scatter");
  return error;
}

FleetStory read_event(const TomlTable& table) {
  expect_keys(table, kFleetStoryKeys);
  FleetStory event;
  required(integer, table, "machine");
  take_fleet_count(event.machine, table, "machine");
  event.kind = required_choice(
      table, "kind",
      {StoryKind::wear, StoryKind::crash, StoryKind::season, StoryKind::replaced_part, StoryKind::instrument});
  take_size(event.month, table, "month");
  take(event.bar, string(table, "bar"));
  take(event.bar_um_per_m, number(table, "bar_um_per_m"));
  if (const auto errors = subtable(table, "errors")) {
    for (const auto& [key, value] : *errors->table) {
      const std::string name(key.str());
      event.errors[name] = required(number, *errors, name);
    }
  }
  if (event.kind != StoryKind::instrument && event.errors.empty()) fail_missing(table, "errors");
  if (event.kind == StoryKind::instrument && event.bar.empty()) fail_missing(table, "bar");
  return event;
}

}  // namespace

std::vector<KeyTable> fleet_keys() {
  return {{"", kFleetKeys},
          {"`[test]`", kFleetTestKeys},
          {"`[scatter]`", kFleetScatterKeys},
          {"`[[error]]`", kFleetErrorKeys},
          {"`[[story]]`", kFleetStoryKeys}};
}

bool is_fleet(std::string_view bytes) {
  try {
    const TomlSource source = parse_toml(bytes, "");
    const TomlTable root = root_of(source);
    const std::optional<std::string> format = string(root, "format");
    return format && format->starts_with("ballbar-fleet");
  } catch (const Error&) {
    return false;
  }
}

VirtualFleet read_fleet(std::string_view bytes, std::string_view name) {
  const TomlSource source = parse_toml(bytes, name);
  const TomlTable root = root_of(source);
  VirtualFleet fleet;
  fleet.name = name;
  if (const std::string format = required(string, root, "format"); format != kFleetFormat) {
    fail_at_key(root, "format", fmt::format("expected format = \"{}\", found \"{}\".", kFleetFormat, format));
  }
  expect_keys(root, kFleetKeys);
  take(fleet.title, string(root, "title"));
  std::size_t seed = fleet.seed;
  take_fleet_count(seed, root, "seed", std::int64_t{1} << 53);
  fleet.seed = seed;
  fleet.started_s = required(local_time_s, root, "started");
  take_fleet_count(fleet.machines, root, "machines");
  take_fleet_count(fleet.months, root, "months", 1200);
  take(fleet.machine_name, string(root, "machine_name"));
  if (fleet.machine_name.empty() || fleet.machine_name.find_first_of("/\\") != std::string::npos ||
      fleet.machine_name.front() == '.') {
    fail_at_key(root, "machine_name",
                fmt::format("expected a name that a folder may have, found \"{}\".", fleet.machine_name));
  }
  take_share(fleet.missing_share, root, "missing_share");
  take_share(fleet.days_of_month, root, "days_of_month", 28.0);
  take_share(fleet.other_planes_share, root, "other_planes_share");
  take_fleet_count(fleet.other_planes_a_year, root, "other_planes_a_year", 12);
  take_fleet_count(fleet.bars, root, "bars");
  take_size(fleet.bar_spread_um_per_m, root, "bar_spread_um_per_m");
  if (const auto table = subtable(root, "test")) read_fleet_test(*table, fleet);
  if (const auto table = subtable(root, "scatter")) read_fleet_scatter(*table, fleet);
  for (const TomlTable& table : subtables(root, "error")) fleet.errors.push_back(read_fleet_error(table));
  for (const TomlTable& table : subtables(root, "story")) fleet.stories.push_back(read_event(table));
  return fleet;
}

}  // namespace ballbar
