#include "recordings/circle_runs.hpp"

#include <cmath>
#include <utility>

#include "ballbar/numerics/order_statistic.hpp"
#include "ballbar/units.hpp"

namespace ballbar {
namespace {

constexpr double kBack_rad = 5.0 * kPi / 180.0;
constexpr double kShortest_rad = 30.0 * kPi / 180.0;

// Without the readings at both ends that stand still.
CircleRun moving(const std::vector<double>& angle_rad, CircleRun run, double step_rad) {
  const double first_rad = angle_rad[run.first], last_rad = angle_rad[run.last];
  while (run.first < run.last && std::abs(angle_rad[run.first + 1] - first_rad) < 0.5 * step_rad) ++run.first;
  while (run.last > run.first && std::abs(angle_rad[run.last - 1] - last_rad) < 0.5 * step_rad) --run.last;
  run.travel_rad = angle_rad[run.last] - angle_rad[run.first];
  return run;
}

}  // namespace

std::vector<double> unwrapped(std::vector<double> angle_rad) {
  for (std::size_t i = 1; i < angle_rad.size(); ++i) {
    angle_rad[i] = angle_rad[i - 1] + std::remainder(angle_rad[i] - angle_rad[i - 1], 2.0 * kPi);
  }
  return angle_rad;
}

double middle_step_rad(const std::vector<double>& unwrapped_rad) {
  if (unwrapped_rad.size() < 2) return 0.0;
  std::vector<double> steps;
  steps.reserve(unwrapped_rad.size());
  for (std::size_t i = 1; i < unwrapped_rad.size(); ++i) {
    steps.push_back(std::abs(unwrapped_rad[i] - unwrapped_rad[i - 1]));
  }
  return median(std::move(steps));
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
  std::erase_if(runs, [](const CircleRun& run) { return std::abs(run.travel_rad) < kShortest_rad; });
  return runs;
}

}  // namespace ballbar
