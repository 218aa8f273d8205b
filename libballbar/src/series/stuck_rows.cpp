#include "series/stuck_rows.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "series/equal_rows.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kFewestStuck = 15, kMostOfRows = 20;  // rows; one of so many is the fewest, too
constexpr std::size_t kMostRuns = 3;                        // a column with more rests by nature
constexpr std::size_t kWindow = 10;                         // rows
constexpr double kFewestNoisy = 2.0, kFewestAtEnd = 5.0;    // windows; where no jump follows
constexpr double kCatchesUp = 3.0;                          // resolutions
constexpr double kLeap = 3.0;                               // largest changes elsewhere
// How many such runs there would be by chance, where windows are at rest independently of each other.
constexpr double kByChance = 1.0, kByChanceAtEnd = 0.001;  // at the end of the column no jump tells more

// Of the windows outside the runs that do not mostly rise or fall: as many independent ones in which the noise shows,
// and the share of those that are at rest. Where nearly all rise or fall, the share is that of all windows.
struct Windows {
  double noisy = 0.0, share_at_rest = 1.0;
  bool mostly_move = false;
};

Windows windows_outside(const std::vector<double>& values, const std::vector<RowRange>& runs) {
  std::vector<double> path(values.size(), 0.0);  // sum of the changes up to each row
  for (std::size_t i = 1; i < values.size(); ++i) path[i] = path[i - 1] + std::abs(values[i] - values[i - 1]);
  std::size_t noisy = 0, at_rest = 0, all = 0, next = 0;
  for (std::size_t begin = 0; begin + kWindow <= values.size(); ++begin) {
    while (next < runs.size() && runs[next].end <= begin) ++next;
    if (next < runs.size() && runs[next].begin < begin + kWindow) continue;
    const std::size_t last = begin + kWindow - 1;
    const double changes = path[last] - path[begin];
    ++all;
    at_rest += values[last] == values[begin] && changes == 0.0 ? 1 : 0;
    noisy += std::abs(values[last] - values[begin]) < 0.5 * changes ? 1 : 0;
  }
  // Laplace's rule of succession; windows overlap.
  const double overlap = static_cast<double>(kWindow), independent = static_cast<double>(noisy) / overlap;
  const bool mostly_move = independent < kFewestNoisy && 2 * (noisy + at_rest) < all;
  return {independent,
          (static_cast<double>(at_rest) + overlap) /
              (static_cast<double>(mostly_move ? all : noisy + at_rest) + 2.0 * overlap),
          mostly_move};
}

// Whether the value jumps behind the run to where it is, rather than begins to move.
bool catches_up(const std::vector<double>& values, const RowRange& run, double least) {
  const double jump = std::abs(values[run.end] - values[run.begin]);
  const double next = run.end + 1 < values.size() ? std::abs(values[run.end + 1] - values[run.end]) : 0.0;
  return jump >= least && next <= 0.5 * jump;
}

// Whether it jumps there by far more than from any row to the next elsewhere.
bool leaps(const std::vector<double>& values, const RowRange& run) {
  double largest = 0.0;
  for (std::size_t i = 1; i < values.size(); ++i)
    if (i != run.end) largest = std::max(largest, std::abs(values[i] - values[i - 1]));
  return std::abs(values[run.end] - values[run.begin]) > kLeap * largest;
}

double smallest_change(const std::vector<double>& values) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < values.size(); ++i) {
    const double change = std::abs(values[i] - values[i - 1]);
    if (change > 1e-9) least = std::min(least, change);
  }
  return least;
}

}  // namespace

std::vector<RowRange> stuck_runs(const std::vector<double>& values, bool is_body) {
  const std::size_t fewest = std::max(kFewestStuck, values.size() / kMostOfRows);
  std::vector<RowRange> runs = equal_rows(values);
  std::erase_if(runs, [&](const RowRange& run) { return run.end - run.begin < fewest; });
  if (runs.empty() || runs.size() > kMostRuns) return {};
  const Windows others = windows_outside(values, runs);
  if (others.noisy < kFewestNoisy && !(others.mostly_move && is_body)) return {};
  const double windows = static_cast<double>(values.size()) / static_cast<double>(kWindow);
  const double least = kCatchesUp * smallest_change(values) * (1.0 - 1e-6);
  std::erase_if(runs, [&](const RowRange& run) {
    const double by_chance = windows * std::pow(others.share_at_rest, static_cast<double>(run.end - run.begin) /
                                                                          static_cast<double>(kWindow));
    if (others.mostly_move && (run.end == values.size() || !leaps(values, run))) return true;
    if (run.end == values.size()) return by_chance > kByChanceAtEnd || others.noisy < kFewestAtEnd;
    return by_chance > kByChance || !catches_up(values, run, least);
  });
  return runs;
}

}  // namespace ballbar
