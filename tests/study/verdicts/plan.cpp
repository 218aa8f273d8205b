#include "plan.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ballbar::verdicts {
namespace {

constexpr double kHour_s = 3600.0;

std::size_t seconds(double value) { return static_cast<std::size_t>(std::lround(value)); }

void hold(Track& track, std::size_t count, double value) {
  count = std::min(count, track.capacity() - track.size());
  track.insert(track.end(), count, value);
}

Track empty_track(std::size_t length) {
  Track track;
  track.reserve(length);
  return track;
}

Track random_speed(std::size_t length, Chance& chance) {
  Track speed = empty_track(length);
  hold(speed, seconds(chance.between(180.0, 1200.0)), 0.0);
  while (speed.size() < length) {
    const double next = chance.happens(0.25) ? 0.0 : 100.0 * std::round(chance.between(20.0, 180.0));
    if (next == speed.back()) continue;
    hold(speed, seconds(chance.log_between(300.0, 3600.0)), next);
  }
  return speed;
}

// Cuts come and go while the speed stays; a spindle that stands takes nothing.
Track random_load(const Track& speed, Chance& chance) {
  Track load = empty_track(speed.size());
  while (load.size() < speed.size()) {
    hold(load, seconds(chance.log_between(240.0, 2400.0)), chance.happens(0.4) ? 0.0 : chance.between(200.0, 3000.0));
  }
  for (std::size_t i = 0; i < load.size(); ++i) load[i] = speed[i] > 0.0 ? load[i] + 50.0 + 0.02 * speed[i] : 0.0;
  return load;
}

struct Room {
  double swing_degC = 0.0;    // half of the day's
  double door_every_s = 0.0;  // on average; 0: stays shut
  double wander_degC = 0.0;   // of a slow curve of its own
  double wander_time_s = 1800.0;
};

Track room_track(std::size_t length, const Room& room, Chance& chance) {
  const double mean_degC = chance.between(19.0, 24.0), phase_rad = chance.between(0.0, 2.0 * std::numbers::pi);
  const double recovery_s = chance.log_between(300.0, 1500.0);
  Track track = empty_track(length);
  // Two first-order bodies after a white push: smooth.
  double door = 0.0, open_for_s = 0.0, cold_degC = 0.0, first = 0.0, second = 0.0;
  for (std::size_t i = 0; i < length; ++i) {
    const auto t = static_cast<double>(i);
    if (room.door_every_s > 0.0 && open_for_s <= 0.0 && chance.happens(1.0 / room.door_every_s)) {
      open_for_s = chance.log_between(30.0, 600.0);
      cold_degC = chance.between(-5.0, -1.5);
    }
    door += ((open_for_s > 0.0 ? cold_degC : 0.0) - door) / (open_for_s > 0.0 ? 120.0 : recovery_s);
    open_for_s -= 1.0;
    first += -first / room.wander_time_s + std::sqrt(2.0 / room.wander_time_s) * chance.normal();
    second += (first - second) / room.wander_time_s;
    track.push_back(mean_degC + room.swing_degC * std::sin(2.0 * std::numbers::pi * t / (24.0 * kHour_s) + phase_rad) +
                    door + room.wander_degC * std::numbers::sqrt2 * second);
  }
  return track;
}

// Temperatures of the machine: a tank with a chiller that is on or off, the housing, the front bearing.
void add_bodies(Plan& plan, Chance& chance) {
  const Track &speed = plan[Quantity::speed], &load = plan[Quantity::load], &room = plan[Quantity::room];
  const std::size_t length = speed.size();
  const double set_degC = room[0] + chance.between(-1.5, 1.5), band_degC = chance.between(0.15, 0.5);
  const double tank_heat = chance.log_between(2e-4, 8e-4), chill = tank_heat * chance.between(6.0, 9.0);  // K/s
  const double follows_room = chance.happens(0.5) ? chance.between(0.3, 0.9) : 0.0;  // the set point goes with the room
  const double bearing_s = chance.log_between(150.0, 500.0), housing_s = chance.log_between(1500.0, 4500.0);
  const double bearing_rise = chance.between(5.0, 18.0), housing_rise = chance.between(2.0, 7.0);
  const double load_rise = chance.between(0.5, 3.0), power = chance.between(1.15, 1.55);
  const double to_coolant = chance.between(0.3, 0.7);
  double tank = set_degC, housing = to_coolant * tank + (1.0 - to_coolant) * room[0], bearing = housing;
  bool chiller_on = false;
  Track tank_track = empty_track(length), housing_track = empty_track(length), bearing_track = empty_track(length);
  for (std::size_t i = 0; i < length; ++i) {
    tank_track.push_back(tank);
    housing_track.push_back(housing);
    bearing_track.push_back(bearing);
    const double friction = std::pow(speed[i] / 18000.0, power) * std::exp(-0.012 * (bearing - housing));
    const double now_degC = set_degC + follows_room * (room[i] - room[0]);
    if (tank > now_degC + band_degC) chiller_on = true;
    if (tank < now_degC - band_degC) chiller_on = false;
    const double housing_goal = to_coolant * tank + (1.0 - to_coolant) * room[i] + 0.25 * (bearing - housing) +
                                housing_rise * friction + load_rise * load[i] / 3000.0;
    const double bearing_goal = housing + bearing_rise * friction + 0.5 * load_rise * load[i] / 3000.0;
    tank +=
        tank_heat * (1.0 + 3.0 * friction + load[i] / 3000.0) - (chiller_on ? chill : 0.0) + 2e-5 * (room[i] - tank);
    housing += (housing_goal - housing) / housing_s;
    bearing += (bearing_goal - bearing) / bearing_s;
  }
  plan[Quantity::coolant] = std::move(tank_track);
  plan[Quantity::housing] = std::move(housing_track);
  plan[Quantity::bearing] = std::move(bearing_track);
}

}  // namespace

Plan rich_plan(Chance& chance, double hours) {
  Plan plan;
  const double drawn_hours = chance.between(5.0, 12.0);
  plan.span_s = seconds((hours > 0.0 ? hours : drawn_hours) * kHour_s);
  const std::size_t length = plan.span_s + kAfter_s;
  plan[Quantity::speed] = random_speed(length, chance);
  plan[Quantity::load] = random_load(plan[Quantity::speed], chance);
  plan[Quantity::room] = room_track(
      length, {chance.between(0.8, 3.0), chance.between(0.7, 3.0) * kHour_s, chance.between(0.05, 0.3)}, chance);
  add_bodies(plan, chance);
  return plan;
}

Plan poor_plan(Chance& chance) {
  Plan plan;
  plan.span_s = seconds(2.5 * kHour_s);
  const std::size_t length = plan.span_s + kAfter_s;
  Track speed = empty_track(length);
  hold(speed, seconds(chance.between(180.0, 900.0)), 0.0);
  const double first = 100.0 * std::round(chance.between(30.0, 170.0));
  double second = first;
  while (std::abs(second - first) < 2000.0) second = 100.0 * std::round(chance.between(30.0, 170.0));
  hold(speed, seconds(chance.between(2000.0, 3600.0)), first);
  hold(speed, seconds(chance.between(1500.0, 2700.0)), second);
  hold(speed, length, 0.0);
  plan[Quantity::speed] = std::move(speed);
  plan[Quantity::load] = random_load(plan[Quantity::speed], chance);
  plan[Quantity::room] = room_track(length, {0.15, 0.0, 0.03}, chance);
  add_bodies(plan, chance);
  return plan;
}

}  // namespace ballbar::verdicts
