#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "diagnosis/next_test/planned_test.hpp"

namespace ballbar {
namespace {

constexpr double kBetweenSweeps_s = 1.0;
constexpr double kBars_mm[] = {50.0, 100.0, 150.0, 300.0};  // lengths that a ballbar's extensions make

using Rows = std::vector<std::size_t>;

// Rows of each recording; rows that are means over two recordings are none's.
std::vector<Rows> recordings_of(const Series& trace, const Rows& rows) {
  std::vector<Rows> result;
  const std::vector<double>& number = find_column(trace, "recording")->values;
  double last = -1.0;
  for (const std::size_t row : rows) {
    if (!(std::abs(number[row] - std::round(number[row])) < 1e-6)) continue;
    if (result.empty() || number[row] != last) result.emplace_back();
    last = number[row];
    result.back().push_back(row);
  }
  return result;
}

std::vector<double> known_values(const Series& trace, std::string_view name, const Rows& rows) {
  std::set<double> values;
  if (const Column* column = find_column(trace, name)) {
    for (const std::size_t row : rows) {
      if (std::isfinite(column->values[row])) values.insert(column->values[row]);
    }
  }
  return {values.begin(), values.end()};
}

// The one whose ratio to that of the recordings is nearest to half, or to twice where there is none shorter.
double other_bar_mm(double bar_mm) {
  const double ideal_mm = bar_mm > kBars_mm[0] ? bar_mm / 2.0 : bar_mm * 2.0;
  const auto off = [&](double length_mm) { return std::abs(std::log(length_mm / ideal_mm)); };
  double best_mm = ideal_mm;
  double least = std::numeric_limits<double>::infinity();
  for (const double length_mm : kBars_mm) {
    if (std::abs(length_mm - bar_mm) < 1.0 || off(length_mm) >= least) continue;
    best_mm = length_mm;
    least = off(length_mm);
  }
  return best_mm;
}

// How the recordings are driven again.
struct Change {
  bool reversed = false;
  double feed_mm_per_min = 0.0;  // 0: as it was
  double radius = 1.0;           // times what it was
};

PlannedTest driven_again(const Series& trace, const std::string& target, const std::vector<Rows>& recordings,
                         const Change& change) {
  PlannedTest result;
  for (const Column& column : trace.columns) {
    if (column.name != target) result.inputs.columns.push_back({column.name, column.role, {}});
  }
  const Column* feed = find_column(trace, "feed_mm_per_min");
  const Column* number = find_column(trace, "recording");
  double start_s = 0.0, next_number = 0.0;
  for (const double value : number->values) next_number = std::fmax(next_number, std::round(value) + 1.0);
  for (const Rows& rows : recordings) {
    const std::size_t first = rows.front(), last = rows.back();
    double slower = change.radius;  // length of a sweep over what it was
    if (change.feed_mm_per_min > 0.0) slower *= feed->values[first] / change.feed_mm_per_min;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const std::size_t row = change.reversed ? rows[rows.size() - 1 - i] : rows[i];
      const double since_s =
          change.reversed ? trace.time_s[last] - trace.time_s[row] : trace.time_s[row] - trace.time_s[first];
      result.inputs.time_s.push_back(start_s + slower * since_s);
      for (Column& column : result.inputs.columns) {
        double value = find_column(trace, column.name)->values[row];
        if (column.name == "direction" && change.reversed) value = -value;
        if (column.name == "sweep_s") value *= change.reversed ? -slower : slower;
        if (column.name == "radius_mm") value *= change.radius;
        if (column.name == "feed_mm_per_min" && change.feed_mm_per_min > 0.0) value = change.feed_mm_per_min;
        if (column.name == "recording") value = next_number;
        column.values.push_back(value);
      }
      result.rows.push_back(result.rows.size());
    }
    start_s = result.inputs.time_s.back() + kBetweenSweeps_s;
    next_number += 1.0;
  }
  result.duration_s = result.inputs.time_s.back();
  return result;
}

}  // namespace

std::vector<PlannedTest> recording_tests(const Series& trace, const std::string& target, const Rows& rows) {
  std::vector<PlannedTest> tests;
  if (find_column(trace, "recording") == nullptr || rows.empty() || rows.back() >= trace.time_s.size()) return tests;
  const std::vector<Rows> recordings = recordings_of(trace, rows);
  if (recordings.empty()) return tests;
  Rows whole;
  for (const Rows& recording : recordings) whole.insert(whole.end(), recording.begin(), recording.end());
  const auto add = [&](const char* name, std::string doing, const Change& change) {
    tests.push_back(driven_again(trace, target, recordings, change));
    tests.back().name = name;
    tests.back().doing = std::move(doing);
  };
  add("the same again", "the same circles once more, the set-up untouched", {});
  add("new set-up", "seat the bar anew, then the same circles once more", {});
  tests.back().new_set_up = true;
  const std::vector<double> directions = known_values(trace, "direction", whole);
  if (directions.size() == 1) {
    add("the other direction",
        fmt::format("the same circles {}", directions[0] > 0.0 ? "clockwise" : "counter-clockwise"), {true});
  }
  const std::vector<double> feeds = known_values(trace, "feed_mm_per_min", whole);
  if (!feeds.empty() && feeds.front() > 0.0) {
    const double half = feeds.front() / 2.0, twice = 2.0 * feeds.back();
    add("half the feed", fmt::format("the same circles at {:g} mm/min", half), {false, half});
    add("twice the feed", fmt::format("the same circles at {:g} mm/min", twice), {false, twice});
  }
  const std::vector<double> radii = known_values(trace, "radius_mm", whole);
  if (radii.size() == 1 && radii[0] > 0.0) {
    const double other_mm = other_bar_mm(radii[0]);
    add("another radius", fmt::format("the same circles with a bar of {:g} mm", other_mm),
        {false, 0.0, other_mm / radii[0]});
    tests.back().new_set_up = true;
  }
  return tests;
}

}  // namespace ballbar
