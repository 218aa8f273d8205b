#include "diagnosis/next_test/thermal_forecast.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "ballbar/series/series.hpp"
#include "effects/low_pass.hpp"

namespace ballbar {
namespace {

std::vector<double> low_passed(const std::vector<double>& time_s, const std::vector<double>& drive, double tau_s) {
  std::vector<double> out(drive.size());
  low_pass(
      time_s, [&](std::size_t i) { return drive[i]; }, tau_s, out.data());
  return out;
}

// Rows of 60 s. The housing warms 0.4 K for each krpm^2 with 40 min, and follows the room with an hour.
Series machine(std::size_t n, double (*rpm_at)(double hours), double (*room_at)(double hours)) {
  Series data;
  Column speed{"speed_rpm", Role::speed, {}}, room{"T_room_degC", Role::ambient, {}},
      housing{"T_housing_degC", Role::housing, {}};
  std::vector<double> heat;
  for (std::size_t i = 0; i < n; ++i) {
    const double hours = static_cast<double>(i) / 60.0;
    data.time_s.push_back(3600.0 * hours);
    speed.values.push_back(rpm_at(hours));
    room.values.push_back(room_at(hours));
    heat.push_back(0.4 * std::pow(speed.values.back() / 1000.0, 2));
  }
  const std::vector<double> warm = low_passed(data.time_s, heat, 2400.0);
  const std::vector<double> ambient = low_passed(data.time_s, room.values, 3600.0);
  for (std::size_t i = 0; i < n; ++i) housing.values.push_back(warm[i] + ambient[i]);
  data.columns = {speed, room, housing};
  return data;
}

double start_and_stop(double hours) {
  if (std::fmod(hours, 3.0) >= 1.5 || hours == 0.0) return 0.0;
  return hours < 3.0 ? 5000.0 : 3000.0;
}
double rising_room(double hours) { return 20.0 + 0.2 * hours; }
double wandering_room(double hours) { return 20.0 + std::sin(hours / 0.9); }

// A column that is 20 + 0.4 LP_2400[n^2] + LP_3600[room], with time constants that are not on the grid.
TEST(thermal_forecast, a_column_follows_speed_and_room_as_it_did) {
  const Series data = machine(8 * 60, start_and_stop, wandering_room);
  const Series later = machine(
      4 * 60, [](double hours) { return hours > 1.0 ? 4000.0 : 0.0; }, rising_room);
  const auto drives = [](const Series& series) {
    return Drives{series.time_s, series.columns[0].values, series.columns[1].values, {}};
  };
  std::vector<double> random;
  std::mt19937_64 generator(1);
  for (std::size_t i = 0; i < data.time_s.size(); ++i) random.push_back(std::normal_distribution<double>()(generator));
  const std::vector<double> constant(data.time_s.size(), 21.0);
  const std::vector<Forecast> forecasts = forecasts_of(drives(data), {data.columns[2].values, random, constant});
  EXPECT_GT(forecasts[0].r2, 0.99);
  EXPECT_LT(forecasts[1].r2, 0.2);
  EXPECT_EQ(forecasts[2].r2, 1.0);
  const std::vector<double> found = predicted(forecasts[0], drives(later));
  double largest = 0.0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    largest = std::max(largest, std::abs(found[i] - later.columns[2].values[i]));
  }

  EXPECT_LT(largest, 0.5);  // of 6.8 K
  EXPECT_NEAR(predicted(forecasts[2], drives(later)).back(), 21.0, 1e-9);
}

}  // namespace
}  // namespace ballbar
