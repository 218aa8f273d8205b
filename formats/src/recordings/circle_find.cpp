#include "recordings/circle_find.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>

#include "ballbar/circle/circle.hpp"
#include "ballbar/error.hpp"
#include "ballbar/internal/numerics/order_statistic.hpp"
#include "ballbar/units.hpp"
#include "logs/log_roles.hpp"
#include "logs/log_units.hpp"
#include "recordings/circle_words.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kFewestReadings = 12;  // of a circle
constexpr std::size_t kMostColumns = 8;      // that are tried without names
constexpr std::size_t kMostPoints = 4000;    // that a circle is looked for with
constexpr double kOff = 0.02;                // of the radius: not on the circle
constexpr double kOn = 0.01;                 // of the radius: rms of what is
constexpr double kLeastArc_rad = 150.0 * kPi / 180.0;
constexpr double kLeastArcCutOff_rad = 30.0 * kPi / 180.0;
// Shorter arcs that are swept steadily, in tables of lengths, angles and times alone. The curve of a slow log is bent
// as well, but its radius is small, or its readings go back and forth, or they lie off the circle.
constexpr double kLeastSweptArc_rad = 10.0 * kPi / 180.0;
constexpr double kLeastSweptGuess_rad = 60.0 * kPi / 180.0;  // without names, or without the unit of the angle
constexpr double kOnOfSagitta = 0.02;                        // rms over the height of the arc above its chord
constexpr double kLeastRadius_mm = 1.0;
constexpr double kForward = 0.8;      // of the way of all steps: what the runs go
constexpr double kLeastLength = 5.0;  // mm or um: less is a deviation
constexpr double kWidestStep_rad = 60.0 * kPi / 180.0;
constexpr std::size_t kMostSectors = 24, kReadingsOfASector = 4;  // of the arc
constexpr double kLeastOfASector = 0.2;                           // of the mean: less is a gap, not a feed that varies

constexpr double kUnordered = 3.0;  // times the mean step of sorted angles: points in any order

constexpr double kLargestRadius = 2000, kSmallestRadius = 2;  // in mm; more is um, less is m
constexpr double kUsualRadii_mm[] = {50.0, 100.0, 150.0, 200.0, 250.0, 300.0};
constexpr double kNearUsual = 5e-4, kFarFromWhole = 0.02;

constexpr double kBack_rad = 5.0 * kPi / 180.0;
constexpr double kShortest_rad = 30.0 * kPi / 180.0;
constexpr double kShortestOfLongest = 0.5;

// Without the readings at both ends that stand still.
CircleRun moving(const std::vector<double>& angle_rad, CircleRun run, double step_rad) {
  const double first_rad = angle_rad[run.first], last_rad = angle_rad[run.last];
  while (run.first < run.last && std::abs(angle_rad[run.first + 1] - first_rad) < 0.5 * step_rad) ++run.first;
  while (run.last > run.first && std::abs(angle_rad[run.last - 1] - last_rad) < 0.5 * step_rad) --run.last;
  run.travel_rad = angle_rad[run.last] - angle_rad[run.first];
  return run;
}

// The median size of the steps.
double middle_step_rad(const std::vector<double>& unwrapped_rad) {
  if (unwrapped_rad.size() < 2) return 0.0;
  std::vector<double> steps;
  steps.reserve(unwrapped_rad.size());
  for (std::size_t i = 1; i < unwrapped_rad.size(); ++i) {
    steps.push_back(std::abs(unwrapped_rad[i] - unwrapped_rad[i - 1]));
  }
  return median(std::move(steps));
}

double span_of(const std::vector<double>& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return *high - *low;
}

PlaneCircle circle_through(const std::vector<double>& x, const std::vector<double>& y,
                           const std::vector<std::size_t>& rows) {
  const std::size_t every = rows.size() / kMostPoints + 1;
  const auto n = static_cast<Eigen::Index>((rows.size() + every - 1) / every);
  Eigen::ArrayXd some_x(n), some_y(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const std::size_t row = rows[static_cast<std::size_t>(i) * every];
    some_x[i] = x[row];
    some_y[i] = y[row];
  }
  return algebraic_circle(some_x, some_y);
}

std::vector<double> angles_about(const std::vector<double>& x, const std::vector<double>& y,
                                 const CoordinateCircle& circle) {
  std::vector<double> angle_rad;
  angle_rad.reserve(circle.rows.size());
  for (const std::size_t row : circle.rows) {
    angle_rad.push_back(std::atan2(y[row] - circle.centre_b, x[row] - circle.centre_a));
  }
  return unwrapped(std::move(angle_rad));
}

// Over enough of an arc, in steps that show the way.
bool goes_round(const std::vector<double>& unwrapped_rad, double least_arc_rad) {
  return span_of(unwrapped_rad) >= least_arc_rad && middle_step_rad(unwrapped_rad) < kWidestStep_rad;
}

// Whether runs make up the way of all steps.
bool is_swept(const std::vector<double>& unwrapped_rad, double least_arc_rad) {
  if (!goes_round(unwrapped_rad, least_arc_rad) || middle_step_rad(unwrapped_rad) == 0.0) return false;
  double way_rad = 0.0, forward_rad = 0.0;
  for (std::size_t i = 1; i < unwrapped_rad.size(); ++i) way_rad += std::abs(unwrapped_rad[i] - unwrapped_rad[i - 1]);
  for (const CircleRun& run : runs_of(unwrapped_rad)) forward_rad += std::abs(run.travel_rad);
  return forward_rad >= kForward * way_rad;
}

// Whether all columns with a unit are lengths, angles, times or feeds: none is a temperature or a load.
bool is_of_paths(const ColumnTable& table) {
  return std::all_of(table.columns.begin(), table.columns.end(), [](const NumberColumn& column) {
    return column.unit.empty() || mm_per_unit(column) || rad_per_unit(column) || seconds_per_unit(column) ||
           column.unit.find('/') != std::string::npos;
  });
}

// Where the points come in any order, as a person reads them: their order along the arc, from its widest gap on. Empty
// where they are in order, or in time.
std::vector<std::size_t> order_of_angles(const ColumnTable& table, const std::vector<double>& unwrapped_rad) {
  const auto n = unwrapped_rad.size();
  const bool has_time = table.dated || std::any_of(table.columns.begin(), table.columns.end(), [](const auto& column) {
                          return word_of(column) == ColumnWord::time;
                        });
  if (has_time || n < kFewestReadings || is_swept(unwrapped_rad, 0.0)) return {};
  std::vector<double> turned_rad(n);
  std::vector<std::size_t> order(n);
  for (std::size_t i = 0; i < n; ++i) {
    turned_rad[i] = unwrapped_rad[i] - 2.0 * kPi * std::floor(unwrapped_rad[i] / (2.0 * kPi));
    order[i] = i;
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return turned_rad[a] < turned_rad[b]; });
  double widest_rad = turned_rad[order.front()] + 2.0 * kPi - turned_rad[order.back()];
  std::size_t first = 0;
  for (std::size_t i = 1; i < n; ++i) {
    const double gap_rad = turned_rad[order[i]] - turned_rad[order[i - 1]];
    if (gap_rad <= widest_rad) continue;
    widest_rad = gap_rad;
    first = i;
  }
  const double step_rad = (2.0 * kPi - widest_rad) / static_cast<double>(n - 1);
  if (middle_step_rad(unwrapped_rad) < kUnordered * step_rad) return {};
  std::rotate(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(first), order.end());
  return order;
}

template <class Value>
std::vector<Value> in_order(const std::vector<Value>& values, const std::vector<std::size_t>& order) {
  std::vector<Value> sorted;
  sorted.reserve(values.size());
  for (const std::size_t i : order) sorted.push_back(values[i]);
  return sorted;
}

// Whether the readings lie all along the arc. Two temperatures that rest at a few levels lie on a circle too.
// `may_rest`: at the ends of the arc, so that other sectors have fewer than the mean.
bool covers_arc(const std::vector<double>& angle_rad, bool may_rest) {
  const double first_rad = *std::min_element(angle_rad.begin(), angle_rad.end());
  const double arc_rad = std::min(span_of(angle_rad), 2.0 * kPi);
  std::vector<std::size_t> sectors(std::min(kMostSectors, angle_rad.size() / kReadingsOfASector));
  for (const double angle : angle_rad) {
    const double place = std::fmod(angle - first_rad, 2.0 * kPi) / arc_rad * static_cast<double>(sectors.size());
    ++sectors[std::min(sectors.size() - 1, static_cast<std::size_t>(place))];
  }
  const std::size_t least = *std::min_element(sectors.begin(), sectors.end());
  const double usual = may_rest ? static_cast<double>(median(sectors))
                                : static_cast<double>(angle_rad.size()) / static_cast<double>(sectors.size());
  return least > 0 && static_cast<double>(least) >= kLeastOfASector * usual;
}

// Whether a part of a circle shorter than half of it can be one.
bool is_swept_arc(const ColumnTable& table, const CoordinateCircle& circle, const std::vector<double>& angle_rad,
                  double rms, double least_arc_rad) {
  const double sagitta = circle.radius * (1.0 - std::cos(0.5 * std::min(span_of(angle_rad), kPi)));
  const double radius_mm =
      circle.radius * mm_per_unit(table.columns[circle.a]).value_or(likely_mm_per_unit(circle.radius));
  return rms <= kOnOfSagitta * sagitta && radius_mm >= kLeastRadius_mm && is_swept(angle_rad, least_arc_rad) &&
         covers_arc(angle_rad, true) && is_of_paths(table);
}

// How sure the columns are to be coordinates.
enum class Coordinates { named, head_of_named, found, of_table_without_names };

// Throws Error where there is none: points on one line.
std::optional<CoordinateCircle> circle_of(const ColumnTable& table, std::size_t a, std::size_t b, Coordinates are) {
  const std::vector<double>&x = table.columns[a].values, &y = table.columns[b].values;
  CoordinateCircle circle;
  circle.a = a;
  circle.b = b;
  for (std::size_t row = 0; row < x.size(); ++row) circle.rows.push_back(row);
  const std::size_t all = circle.rows.size();
  double rms = 0.0;
  for (int pass = 0; pass < 3; ++pass) {
    const PlaneCircle fitted = circle_through(x, y, circle.rows);
    if (!std::isfinite(fitted.radius) || !(fitted.radius > 0.0)) return std::nullopt;
    circle.centre_a = fitted.centre_x;
    circle.centre_b = fitted.centre_y;
    circle.radius = fitted.radius;
    circle.rows.clear();
    double sum = 0.0;
    // The way in and out pulls at the first circle.
    const double off = (pass == 0 ? 5.0 : 1.0) * kOff * circle.radius;
    for (std::size_t row = 0; row < all; ++row) {
      const double left = std::hypot(x[row] - circle.centre_a, y[row] - circle.centre_b) - circle.radius;
      if (std::abs(left) > off) continue;
      circle.rows.push_back(row);
      sum += left * left;
    }
    if (circle.rows.size() < kFewestReadings || 5 * circle.rows.size() < 3 * all) return std::nullopt;
    rms = std::sqrt(sum / static_cast<double>(circle.rows.size()));
  }
  if (rms > kOn * circle.radius) return std::nullopt;
  std::vector<double> angle_rad = angles_about(x, y, circle);
  if (const auto order = order_of_angles(table, angle_rad); !order.empty() && are != Coordinates::found) {
    circle.rows = in_order(circle.rows, order);
    circle.sorted = true;
    angle_rad = angles_about(x, y, circle);
  }
  circle.off = rms / circle.radius;
  const bool is_named = are == Coordinates::named || are == Coordinates::head_of_named;
  const bool is_round = goes_round(angle_rad, are == Coordinates::head_of_named ? kLeastArcCutOff_rad : kLeastArc_rad);
  if (is_round && (is_named || covers_arc(angle_rad, false))) return circle;
  if (are == Coordinates::found) return std::nullopt;
  const double least_arc_rad = is_named ? kLeastSweptArc_rad : kLeastSweptGuess_rad;
  return is_swept_arc(table, circle, angle_rad, rms, least_arc_rad) ? std::optional(circle) : std::nullopt;
}

std::optional<CoordinateCircle> circle_or_none(const ColumnTable& table, std::size_t a, std::size_t b,
                                               Coordinates are) {
  try {
    return circle_of(table, a, b, are);
  } catch (const Error&) {
    return std::nullopt;
  }
}

// Right-handed: X and Z are Z and X.
std::optional<Plane> plane_of(int a, int b) {
  for (const Plane plane : {Plane::XY, Plane::YZ, Plane::ZX}) {
    if (axes_of(plane) == std::array{a, b}) return plane;
  }
  return std::nullopt;
}

struct AxisColumn {
  std::size_t column = 0;
  int axis = 0;
};

std::vector<AxisColumn> axis_columns(const ColumnTable& table, bool commanded) {
  std::vector<AxisColumn> columns;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const auto axis = axis_of(table.columns[i]);
    if (axis && is_commanded(table.columns[i]) == commanded) columns.push_back({i, *axis});
  }
  return columns;
}

std::optional<CoordinateCircle> named_circle(const ColumnTable& table, bool commanded, bool cut_off) {
  const std::vector<AxisColumn> columns = axis_columns(table, commanded);
  for (const AxisColumn& a : columns) {
    for (const AxisColumn& b : columns) {
      const std::optional<Plane> plane = plane_of(a.axis, b.axis);
      if (!plane) continue;
      auto circle =
          circle_or_none(table, a.column, b.column, cut_off ? Coordinates::head_of_named : Coordinates::named);
      if (!circle) continue;
      circle->plane = plane;
      return circle;
    }
  }
  return std::nullopt;
}

bool has_no_names(const ColumnTable& table) {
  return std::all_of(table.columns.begin(), table.columns.end(),
                     [](const NumberColumn& column) { return column.name.empty(); });
}

// A log of temperatures by dates, or of several over time: two of its columns may lie on a circle by chance.
bool is_log(const ColumnTable& table) {
  const auto temperatures = std::count_if(table.columns.begin(), table.columns.end(), [](const NumberColumn& column) {
    const auto unit = log_unit(column.unit);
    return (unit && (unit->canonical == "degC" || unit->canonical == "K")) ||
           (column.unit.empty() && (says_temperature(column.name) || names_a_part(column.name)));
  });
  const bool has_time = std::any_of(table.columns.begin(), table.columns.end(),
                                    [](const NumberColumn& column) { return word_of(column) == ColumnWord::time; });
  return temperatures >= (table.dated ? 1 : 2) && (table.dated || has_time);
}

bool could_be_coordinate(const NumberColumn& column) {
  const ColumnWord word = word_of(column);
  if (!axis_of(column) && (says_temperature(column.name) || names_a_part(column.name))) return false;
  if (!column.unit.empty() && !mm_per_unit(column)) return false;  // a speed, a temperature
  return (word == ColumnWord::none || word == ColumnWord::coordinate) && !is_commanded(column);
}

// Rises from row to row by the same step, as a time or a number does.
bool counts(const std::vector<double>& values) {
  const double step = (values.back() - values.front()) / static_cast<double>(values.size() - 1);
  for (std::size_t i = 1; i < values.size(); ++i) {
    if (!(std::abs(values[i] - values[i - 1] - step) <= 0.01 * std::abs(step)) || step <= 0.0) return false;
  }
  return true;
}

// The pair of columns that lies nearest to a circle. Of three the order says which plane they are of.
std::optional<CoordinateCircle> nameless_circle(const ColumnTable& table) {
  if (table.dated) return std::nullopt;
  const Coordinates are = has_no_names(table) ? Coordinates::of_table_without_names : Coordinates::found;
  std::vector<std::size_t> columns;
  for (std::size_t i = 0; i < std::min(table.columns.size(), kMostColumns); ++i) {
    if (could_be_coordinate(table.columns[i]) && !counts(table.columns[i].values)) columns.push_back(i);
  }
  std::optional<CoordinateCircle> nearest;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    for (std::size_t k = i + 1; k < columns.size(); ++k) {
      const bool is_zx = columns.size() == 3 && i == 0 && k == 2 && has_no_names(table);
      const auto circle = circle_or_none(table, columns[is_zx ? k : i], columns[is_zx ? i : k], are);
      if (!circle || (nearest && circle->off >= nearest->off)) continue;
      nearest = circle;
      if (columns.size() == 3 && has_no_names(table))
        nearest->plane = plane_of(static_cast<int>(is_zx ? k : i), static_cast<int>(is_zx ? i : k));
    }
  }
  return nearest;
}

// A turn, of 360 deg or 2 pi, to a reading's step.
std::optional<double> unit_of_a_turn(const std::vector<double>& angle) {
  const double span = span_of(angle);
  const auto [low, high] = std::minmax_element(angle.begin(), angle.end());
  if (std::max(std::abs(*low), std::abs(*high)) > 2.1 * span) return std::nullopt;
  for (const double turn : {360.0, 2.0 * kPi}) {
    if (std::abs(span - turn) <= 0.03 * turn) return 2.0 * kPi / turn;
  }
  return std::nullopt;
}

// Deg, or rad where the numbers stay within a turn of those: as deg they would be no arc.
double likely_unit(const std::vector<double>& angle) { return span_of(angle) <= 2.05 * kPi ? 1.0 : rad_from_deg(1.0); }

std::vector<double> angles_of(const std::vector<double>& angle, double rad_per_unit) {
  std::vector<double> angle_rad(angle.size());
  std::transform(angle.begin(), angle.end(), angle_rad.begin(), [&](double value) { return value * rad_per_unit; });
  return unwrapped(std::move(angle_rad));
}

std::optional<std::size_t> column_called(const ColumnTable& table, ColumnWord word) {
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    if (word_of(table.columns[i]) == word) return i;
  }
  return std::nullopt;
}

// A table over time may hold an angle beside other things: there, only a column that is named. Both columns of a table
// with one a direction, else the first that can be.
std::vector<std::size_t> value_columns(const ColumnTable& table, std::size_t angle) {
  std::vector<std::size_t> named, of_direction, others;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const ColumnWord word = word_of(table.columns[i]);
    if (i == angle || is_commanded(table.columns[i])) continue;
    if (!table.columns[i].unit.empty() && !mm_per_unit(table.columns[i])) continue;  // an angle's error, say
    if (word == ColumnWord::length || word == ColumnWord::deviation) {
      (direction_of(table.columns[i]) ? of_direction : named).push_back(i);
    } else if (word == ColumnWord::none) {
      others.push_back(i);
    }
  }
  if (of_direction.size() == 2 &&
      direction_of(table.columns[of_direction[0]]) != direction_of(table.columns[of_direction[1]])) {
    return of_direction;
  }
  if (column_called(table, ColumnWord::time)) others.clear();
  for (const std::vector<std::size_t>& columns : {named, of_direction, others}) {
    if (!columns.empty()) return {columns.front()};
  }
  return {};
}

}  // namespace

double likely_mm_per_unit(double radius) {
  if (radius > kLargestRadius) return 1e-3;
  if (radius < kSmallestRadius) return 1e3;
  const bool is_usual = std::any_of(std::begin(kUsualRadii_mm), std::end(kUsualRadii_mm), [&](double usual_mm) {
    return std::abs(25.4 * radius - usual_mm) <= kNearUsual * usual_mm;
  });
  return is_usual && std::abs(radius - std::round(radius)) > kFarFromWhole ? 25.4 : 1.0;
}

std::vector<double> unwrapped(std::vector<double> angle_rad) {
  for (std::size_t i = 1; i < angle_rad.size(); ++i) {
    angle_rad[i] = angle_rad[i - 1] + std::remainder(angle_rad[i] - angle_rad[i - 1], 2.0 * kPi);
  }
  return angle_rad;
}

std::vector<CircleRun> runs_of(const std::vector<double>& unwrapped_rad) {
  std::vector<CircleRun> runs;
  if (unwrapped_rad.size() < 2) return runs;
  std::size_t start = 0, extreme = 0;
  double sign = 0.0;
  for (std::size_t i = 1; i < unwrapped_rad.size(); ++i) {
    const double from_start = unwrapped_rad[i] - unwrapped_rad[start];
    if (sign == 0.0 && std::abs(from_start) > kBack_rad) sign = from_start > 0.0 ? 1.0 : -1.0;
    if (sign * unwrapped_rad[i] >= sign * unwrapped_rad[extreme]) {
      extreme = i;
    } else if (sign * (unwrapped_rad[extreme] - unwrapped_rad[i]) > kBack_rad) {
      runs.push_back({start, extreme});
      start = extreme;
      extreme = i;
      sign = -sign;
    }
  }
  runs.push_back({start, unwrapped_rad.size() - 1});
  const double step_rad = middle_step_rad(unwrapped_rad);
  for (CircleRun& run : runs) run = moving(unwrapped_rad, run, step_rad);
  double longest_rad = 0.0;
  for (const CircleRun& run : runs) longest_rad = std::max(longest_rad, std::abs(run.travel_rad));
  const double shortest_rad = std::min(kShortest_rad, kShortestOfLongest * longest_rad);
  std::erase_if(runs, [&](const CircleRun& run) { return std::abs(run.travel_rad) < shortest_rad; });
  return runs;
}

std::optional<CoordinateCircle> coordinate_circle(const ColumnTable& table, bool cut_off) {
  if (table.columns.size() < 2 || table.columns.front().values.size() < kFewestReadings || is_log(table))
    return std::nullopt;
  std::optional<CoordinateCircle> circle = named_circle(table, false, cut_off);
  if (!circle && !cut_off) circle = nameless_circle(table);
  if (!circle) return std::nullopt;
  if (const auto commanded = named_circle(table, true, cut_off)) circle->commanded_radius = commanded->radius;
  return circle;
}

std::optional<PolarCircle> polar_circle(const ColumnTable& table, bool cut_off) {
  if (table.columns.size() < 2 || table.columns.front().values.size() < kFewestReadings || is_log(table))
    return std::nullopt;
  PolarCircle circle;
  const std::optional<std::size_t> named = column_called(table, ColumnWord::angle);
  const std::optional<double> turn = named ? std::nullopt : unit_of_a_turn(table.columns.front().values);
  const bool is_stated = stated_radius_mm(table.preamble).has_value();  // above two columns without names
  if (!named && !((turn || is_stated) && has_no_names(table))) return std::nullopt;
  circle.angle = named.value_or(0);
  const NumberColumn& angle = table.columns[circle.angle];
  circle.rad_per_unit = turn ? *turn : rad_per_unit(angle).value_or(likely_unit(angle.values));
  circle.values = value_columns(table, circle.angle);
  if (circle.values.empty()) return std::nullopt;
  std::vector<double> angle_rad = angles_of(angle.values, circle.rad_per_unit);
  for (std::size_t row = 0; row < angle_rad.size(); ++row) circle.rows.push_back(row);
  if (std::vector<std::size_t> order = order_of_angles(table, angle_rad); !order.empty()) {
    circle.rows = std::move(order);
    circle.sorted = true;
    angle_rad = unwrapped(in_order(angle_rad, circle.rows));
  }
  const double least_swept_rad = rad_per_unit(angle) ? kLeastSweptArc_rad : kLeastSweptGuess_rad;
  const bool is_named = named ? word_of(table.columns[circle.values.front()]) != ColumnWord::none : is_stated;
  const bool is_arc = is_named && is_of_paths(table) && is_swept(angle_rad, least_swept_rad);
  const bool is_round =
      goes_round(angle_rad, cut_off ? kLeastArcCutOff_rad : kLeastArc_rad) && middle_step_rad(angle_rad) > 0.0;
  if (!is_arc && !is_round) return std::nullopt;
  const std::vector<double>& values = table.columns[circle.values.front()].values;
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  circle.are_lengths = *low > kLeastLength && *high - *low <= 0.2 * *high;
  const bool is_deviation = word_of(table.columns[circle.values.front()]) == ColumnWord::deviation;
  circle.are_lengths = circle.are_lengths && !is_deviation;
  return circle;
}

}  // namespace ballbar
