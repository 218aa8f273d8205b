#include "simulation/fleet_machines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "ballbar/circle/recording.hpp"
#include "ballbar/effects/effect.hpp"
#include "ballbar/error.hpp"
#include "ballbar/history/history.hpp"
#include "ballbar/internal/nearest_name.hpp"
#include "ballbar/units.hpp"
#include "machine_errors/error_rows.hpp"
#include "numerics/random_streams.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kMostMonths = 1'000'000;  // of machines: what is kept of their tests fits into a memory of 1 GB
constexpr std::array kFleetPlanes{Plane::XY, Plane::YZ, Plane::ZX};

std::string small(std::string_view text) {
  std::string letters(text);
  std::transform(letters.begin(), letters.end(), letters.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return letters;
}

// Whether a name means a row: both of them, or all rows that it begins.
bool means(std::string_view name, std::string_view row) {
  return row == name || (row.starts_with(name) && row[name.size()] == '_');
}

// "squareness_xy"; "play_x_pos" of "play_pos" and X.
std::string placed(const std::string& error, std::string_view place, std::string_view side) {
  const std::string stem = side.empty() ? error : error.substr(0, error.size() - side.size() - 1);
  return fmt::format("{}_{}{}{}", stem, place, side.empty() ? "" : "_", side);
}

constexpr std::array<std::string_view, 4> kSides{"pos", "neg", "fwd", "rev"};

// Of a row of one side of an axis: what both sides are called; else the row.
std::string of_both_sides(const std::string& row) {
  for (const std::string_view side : kSides) {
    if (row.ends_with(fmt::format("_{}", side))) return row.substr(0, row.size() - side.size() - 1);
  }
  return row;
}

// The names by which an error of an axis or a plane may be stated: with its side, and for both sides.
std::vector<std::string> names_at(const std::string& error, const std::optional<int>& axis, Plane plane) {
  const std::string place = axis ? std::string(1, "xyz"[*axis]) : small(name_of(plane));
  std::vector<std::string> names{placed(error, place, "")};
  for (const std::string_view side : kSides) {
    if (!error.ends_with(fmt::format("_{}", side))) continue;
    names.push_back(placed(error, place, side));
    names.push_back(fmt::format("{}_{}", of_both_sides(error), place));
  }
  return names;
}

double share_of_story(const FleetStory& story, double since_s, std::int64_t at_s) {
  const double years = since_s / kYear_s - story.month / 12.0;
  switch (story.kind) {
    case StoryKind::wear:
      return std::max(0.0, years);
    case StoryKind::crash:
      return years >= 0.0 ? 1.0 : 0.0;
    case StoryKind::season:
      return warmth_of_year(at_s);
    case StoryKind::replaced_part:
      return years >= 0.0 ? 0.0 : 1.0;
    case StoryKind::instrument:
      break;
  }
  return 0.0;
}

std::vector<std::string> all_names(const FleetCurves& curves) {
  std::vector<std::string> names;
  for (const Plane plane : kFleetPlanes) {
    for (const int axis : axes_of(plane)) names.push_back(fmt::format("scale_{}", "xyz"[axis]));
    for (const FleetCurves::Column& column : curves.columns) {
      const std::optional<int> axis =
          column.side ? std::optional(axes_of(plane)[static_cast<std::size_t>(*column.side)]) : std::nullopt;
      for (std::string& name : names_at(column.name, axis, plane)) names.push_back(std::move(name));
    }
  }
  return names;
}

}  // namespace

double warmth_of_year(std::int64_t at_s) { return -std::cos(2.0 * kPi * (static_cast<double>(at_s) / kYear_s - 0.04)); }

BarInUse bar_of(const VirtualFleet& fleet, std::size_t machine, double month) {
  const std::size_t number = machine % std::max<std::size_t>(fleet.bars, 1);
  std::mt19937_64 random = simulation::stream_of(fleet.seed, simulation::Stream::fleet_bar, number);
  BarInUse bar{fmt::format("S{:05}", 10417 + 361 * number), fleet.bar_spread_um_per_m * simulation::normal(random)};
  for (const FleetStory& story : fleet.stories) {
    if (story.kind != StoryKind::instrument || story.machine != machine + 1 || month < story.month) continue;
    bar = {story.bar, bar.um_per_m + story.bar_um_per_m};
  }
  return bar;
}

FleetMachineTruth machine_truth(const VirtualFleet& fleet, std::size_t machine, std::mt19937_64& random) {
  FleetMachineTruth truth;
  truth.machine = machine;
  truth.name = fmt::format("{}-{:02}", fleet.machine_name, machine + 1);
  const double factor = simulation::uniform(random) < fleet.large_share ? fleet.large_factor : 1.0;
  for (const ErrorSpread& error : fleet.errors) {
    const auto draw = [&] { return error.mean + factor * error.spread * simulation::normal(random); };
    for (const std::string_view place : {"x", "y", "z", "xy", "yz", "zx"}) {
      truth.constant[placed(error.name, place, "")] = draw();
    }
  }
  return truth;
}

double FleetMachineTruth::value(const VirtualFleet& fleet, const std::string& error, const std::optional<int>& axis,
                                Plane plane, double since_s, std::int64_t at_s) const {
  double sum = 0.0;
  const std::string place = axis ? std::string(1, "xyz"[*axis]) : small(name_of(plane));
  for (const ErrorSpread& spread : fleet.errors) {
    if (means(spread.name, error)) sum += constant.at(placed(spread.name, place, ""));
  }
  const std::vector<std::string> names = names_at(error, axis, plane);
  for (const FleetStory& story : fleet.stories) {
    if (story.machine != machine + 1) continue;
    for (const std::string& one : names) {
      const auto found = story.errors.find(one);
      if (found == story.errors.end()) continue;
      sum += found->second * share_of_story(story, since_s, at_s);
      break;
    }
  }
  return sum;
}

SpreadsOfColumns spreads_of(const VirtualFleet& fleet, const FleetCurves& curves) {
  SpreadsOfColumns spreads;
  for (const ErrorSpread& error : fleet.errors) {
    if (error.name == "scale") spreads.scale = error;
  }
  for (const FleetCurves::Column& column : curves.columns) {
    const auto found = std::find_if(fleet.errors.begin(), fleet.errors.end(),
                                    [&](const ErrorSpread& one) { return means(one.name, column.name); });
    spreads.of_column.push_back(column.of_mismatch || found == fleet.errors.end() ? nullptr : &*found);
  }
  return spreads;
}

FleetCurves fleet_curves(const VirtualFleet& fleet) {
  FleetCurves curves;
  const auto n = static_cast<double>(fleet.readings);
  for (const Direction direction : {Direction::CCW, Direction::CW}) {
    Recording recording;
    recording.direction = direction;
    recording.nominal_length_mm = fleet.nominal_length_mm;
    recording.feed_mm_per_min = fleet.feed_mm_per_min;
    for (std::size_t i = 0; i < fleet.readings; ++i) {
      const double turn = (static_cast<double>(i) + 0.5) / n;
      recording.angle_rad.push_back(2.0 * kPi * (direction == Direction::CCW ? turn : 1.0 - turn));
    }
    recording.length_mm.assign(fleet.readings, fleet.nominal_length_mm);
    curves.recordings.push_back(std::move(recording));
  }
  const Series trace = trace_of(curves.recordings);
  for (const auto& effect : built_in_catalogue()) {
    if (effect->level != Level::recording || effect->rules.error_fit == ErrorFit::none) continue;
    std::string stem = effect->name;
    std::optional<int> side;
    if (stem.ends_with("_a") || stem.ends_with("_b")) {
      side = stem.ends_with("_a") ? 0 : 1;
      stem.resize(stem.size() - 2);
    }
    const std::size_t shape = shape_of(*effect);
    const Eigen::MatrixXd units =
        unit_curves(*effect, trace, shape == kNoShape ? 0.0 : effect->parameters[shape].start);
    const std::vector<std::size_t> gains = gains_of(*effect);
    std::string before;
    for (std::size_t k = 0; k < gains.size(); ++k) {
      const std::string& row = effect->parameters[gains[k]].row;
      if (k > 0 && row == before) continue;  // the cosine of an amplitude: all of it is a sine
      before = row;
      const auto unit = units.col(static_cast<Eigen::Index>(k));
      curves.columns.push_back({row.empty() ? stem : fmt::format("{}_{}", stem, row),
                                side,
                                {unit.begin(), unit.end()},
                                effect->rules.relation == AxisRelation::scale});
    }
  }
  return curves;
}

void check_fleet(const VirtualFleet& fleet, const FleetCurves& curves) {
  if (fleet.machines == 0 || fleet.months == 0 || fleet.readings < 50) {
    throw Error(
        fmt::format("{}: expected a machine, a month and 50 readings at least, found {} machines, {} months "
                    "and {} readings.",
                    fleet.name, fleet.machines, fleet.months, fleet.readings));
  }
  if (fleet.machines > kMostMonths / fleet.months) {
    throw Error(fmt::format("{}: expected at most {} months of all machines together, found {} machines of {} months.",
                            fleet.name, kMostMonths, fleet.machines, fleet.months));
  }
  std::vector<std::string> rows{"scale"};
  for (const FleetCurves::Column& column : curves.columns) {
    rows.push_back(column.name);
    rows.push_back(of_both_sides(column.name));
  }
  for (const ErrorSpread& error : fleet.errors) {
    if (std::any_of(rows.begin(), rows.end(), [&](const std::string& row) { return means(error.name, row); })) continue;
    throw Error(fmt::format("{}: expected an error that a ballbar test shows, found \"{}\"; the nearest is {}.",
                            fleet.name, error.name,
                            nearest_name(error.name, std::vector<std::string_view>(rows.begin(), rows.end()))));
  }
  const std::vector<std::string> names = all_names(curves);
  for (const FleetStory& story : fleet.stories) {
    if (story.machine < 1 || story.machine > fleet.machines) {
      throw Error(fmt::format("{}: expected a story of machine 1 to {}, found machine {}.", fleet.name, fleet.machines,
                              story.machine));
    }
    for (const auto& [name, amount] : story.errors) {
      if (std::find(names.begin(), names.end(), name) != names.end()) continue;
      throw Error(fmt::format("{}: expected an error of an axis or a plane, found \"{}\"; the nearest is {}.",
                              fleet.name, name,
                              nearest_name(name, std::vector<std::string_view>(names.begin(), names.end()))));
    }
  }
}

}  // namespace ballbar
