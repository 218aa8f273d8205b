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

// Of a drawn room the mean, the time of day and the recovery are drawn; of a known one only the time.
Track room_track(std::size_t length, Room& room, bool is_known, Chance& chance) {
  if (!is_known) room.mean_degC = chance.between(19.0, 24.0);
  const double phase_rad = chance.between(0.0, 2.0 * std::numbers::pi);
  if (!is_known) room.recovery_s = chance.log_between(300.0, 1500.0);
  Track track = empty_track(length);
  // Two first-order bodies after a white push: smooth.
  double door = 0.0, open_for_s = 0.0, cold_degC = 0.0, first = 0.0, second = 0.0;
  for (std::size_t i = 0; i < length; ++i) {
    const auto t = static_cast<double>(i);
    if (room.door_every_s > 0.0 && open_for_s <= 0.0 && chance.happens(1.0 / room.door_every_s)) {
      open_for_s = chance.log_between(30.0, 600.0);
      cold_degC = chance.between(-5.0, -1.5);
    }
    door += ((open_for_s > 0.0 ? cold_degC : 0.0) - door) / (open_for_s > 0.0 ? 120.0 : room.recovery_s);
    open_for_s -= 1.0;
    first += -first / room.wander_time_s + std::sqrt(2.0 / room.wander_time_s) * chance.normal();
    second += (first - second) / room.wander_time_s;
    track.push_back(room.mean_degC +
                    room.swing_degC * std::sin(2.0 * std::numbers::pi * t / (24.0 * kHour_s) + phase_rad) + door +
                    room.wander_degC * std::numbers::sqrt2 * second);
  }
  return track;
}

Bodies drawn_bodies(double room_degC, Chance& chance) {
  Bodies bodies;
  bodies.room_degC = room_degC;
  bodies.set_degC = room_degC + chance.between(-1.5, 1.5);
  bodies.band_degC = chance.between(0.15, 0.5);
  bodies.tank_heat = chance.log_between(2e-4, 8e-4);
  bodies.chill = bodies.tank_heat * chance.between(6.0, 9.0);
  bodies.follows_room = chance.happens(0.5) ? chance.between(0.3, 0.9) : 0.0;
  bodies.bearing_s = chance.log_between(150.0, 500.0);
  bodies.housing_s = chance.log_between(1500.0, 4500.0);
  bodies.bearing_rise = chance.between(5.0, 18.0);
  bodies.housing_rise = chance.between(2.0, 7.0);
  bodies.load_rise = chance.between(0.5, 3.0);
  bodies.power = chance.between(1.15, 1.55);
  bodies.to_coolant = chance.between(0.3, 0.7);
  return bodies;
}

// Their temperatures. `moved`: how much the set point is moved, a value a second; empty: not.
void add_temperatures(Plan& plan, const Track& moved) {
  const Track &speed = plan[Quantity::speed], &load = plan[Quantity::load], &room = plan[Quantity::room];
  const Bodies& bodies = plan.bodies;
  const std::size_t length = speed.size();
  const auto goal_degC = [&](std::size_t i) {
    return bodies.set_degC + bodies.follows_room * (room[i] - bodies.room_degC) + (moved.empty() ? 0.0 : moved[i]);
  };
  double tank = goal_degC(0), housing = bodies.to_coolant * tank + (1.0 - bodies.to_coolant) * room[0];
  double bearing = housing;
  bool chiller_on = false;
  Track tank_track = empty_track(length), housing_track = empty_track(length), bearing_track = empty_track(length);
  for (std::size_t i = 0; i < length; ++i) {
    tank_track.push_back(tank);
    housing_track.push_back(housing);
    bearing_track.push_back(bearing);
    const double friction = std::pow(speed[i] / 18000.0, bodies.power) * std::exp(-0.012 * (bearing - housing));
    const double now_degC = goal_degC(i);
    if (tank > now_degC + bodies.band_degC) chiller_on = true;
    if (tank < now_degC - bodies.band_degC) chiller_on = false;
    const double housing_goal = bodies.to_coolant * tank + (1.0 - bodies.to_coolant) * room[i] +
                                0.25 * (bearing - housing) + bodies.housing_rise * friction +
                                bodies.load_rise * load[i] / 3000.0;
    const double bearing_goal = housing + bodies.bearing_rise * friction + 0.5 * bodies.load_rise * load[i] / 3000.0;
    tank += bodies.tank_heat * (1.0 + 3.0 * friction + load[i] / 3000.0) - (chiller_on ? bodies.chill : 0.0) +
            2e-5 * (room[i] - tank);
    housing += (housing_goal - housing) / bodies.housing_s;
    bearing += (bearing_goal - bearing) / bodies.bearing_s;
  }
  plan[Quantity::coolant] = std::move(tank_track);
  plan[Quantity::housing] = std::move(housing_track);
  plan[Quantity::bearing] = std::move(bearing_track);
}

void add_room_and_bodies(Plan& plan, const Room& room, Chance& chance) {
  plan.room = room;
  plan[Quantity::room] = room_track(plan[Quantity::speed].size(), plan.room, false, chance);
  plan.bodies = drawn_bodies(plan[Quantity::room][0], chance);
  add_temperatures(plan, {});
}

Room lively_room(Chance& chance) {
  Room room;
  room.swing_degC = chance.between(0.8, 3.0);
  room.door_every_s = chance.between(0.7, 3.0) * kHour_s;
  room.wander_degC = chance.between(0.05, 0.3);
  return room;
}

double at_idle_W(double speed_rpm) { return speed_rpm > 0.0 ? 50.0 + 0.02 * speed_rpm : 0.0; }

// Of the cuts, over all seconds that it turned.
double mean_cut_W(const Plan& plan) {
  const Track &speed = plan[Quantity::speed], &load = plan[Quantity::load];
  double sum = 0.0, seconds_turning = 0.0;
  for (std::size_t i = plan.before_s; i < plan.before_s + plan.span_s; ++i) {
    if (!(speed[i] > 0.0)) continue;
    sum += load[i] - at_idle_W(speed[i]);
    seconds_turning += 1.0;
  }
  return seconds_turning > 0.0 ? sum / seconds_turning : 0.0;
}

// What is set follows with that time constant, from where it stands as the record begins.
Track followed(const Track& set, double time_constant_s) {
  Track result = empty_track(set.size());
  double now = set.front();
  for (const double goal : set) {
    result.push_back(now);
    now += (goal - now) / time_constant_s;
  }
  return result;
}

}  // namespace

Plan rich_plan(Chance& chance) {
  Plan plan;
  plan.span_s = seconds(chance.between(5.0, 12.0) * kHour_s);
  const std::size_t length = plan.span_s + kAfter_s;
  plan[Quantity::speed] = random_speed(length, chance);
  plan[Quantity::load] = random_load(plan[Quantity::speed], chance);
  add_room_and_bodies(plan, lively_room(chance), chance);
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
  add_room_and_bodies(plan, {.swing_degC = 0.15, .wander_degC = 0.03}, chance);
  return plan;
}

Plan one_speed_plan(Chance& chance) {
  Plan plan;
  plan.span_s = seconds(chance.between(4.0, 12.0) * kHour_s);
  const std::size_t length = plan.span_s + kAfter_s;
  Track speed = empty_track(length);
  hold(speed, seconds(chance.between(180.0, 1200.0)), 0.0);
  hold(speed, length, 100.0 * std::round(chance.between(30.0, 170.0)));
  plan[Quantity::speed] = std::move(speed);
  plan[Quantity::load] = random_load(plan[Quantity::speed], chance);
  add_room_and_bodies(plan, lively_room(chance), chance);
  return plan;
}

Plan plan_under(const Schedule& schedule, const Plan& first, Chance& chance) {
  Plan plan;
  plan.before_s = schedule.starts_warm ? first.span_s : 0;
  plan.span_s = seconds(duration_s(schedule));
  plan.bodies = first.bodies;
  plan.room = first.room;
  const std::size_t length = plan.before_s + plan.span_s + kAfter_s;
  const auto from = static_cast<std::ptrdiff_t>(first.before_s), to = from + static_cast<std::ptrdiff_t>(plan.before_s);
  const double cut_W = mean_cut_W(first);
  Track speed = empty_track(length), load = empty_track(length), room_K = empty_track(length);
  Track coolant_K = empty_track(length);
  speed.assign(first[Quantity::speed].begin() + from, first[Quantity::speed].begin() + to);
  load.assign(first[Quantity::load].begin() + from, first[Quantity::load].begin() + to);
  room_K.assign(plan.before_s, 0.0);
  coolant_K.assign(plan.before_s, 0.0);
  // Nobody starts a program and a logger at the same second.
  const double late_s = std::floor(chance.between(0.0, schedule.reading_s > 0.0 ? schedule.reading_s : 60.0));
  for (std::size_t i = 0; i < plan.span_s + kAfter_s; ++i) {
    const Dwell& dwell = dwell_at(schedule, std::max(0.0, static_cast<double>(i) - late_s));
    speed.push_back(dwell.speed_rpm);
    load.push_back(dwell.speed_rpm > 0.0 ? dwell.load * (cut_W + at_idle_W(dwell.speed_rpm)) : 0.0);
    room_K.push_back(dwell.room_K);
    coolant_K.push_back(dwell.coolant_K);
  }
  plan[Quantity::speed] = std::move(speed);
  plan[Quantity::load] = std::move(load);
  plan[Quantity::room] = room_track(length, plan.room, true, chance);
  const Track warmer = followed(room_K, 600.0);
  for (std::size_t i = 0; i < length; ++i) plan[Quantity::room][i] += warmer[i];
  add_temperatures(plan, followed(coolant_K, 120.0));
  return plan;
}

}  // namespace ballbar::verdicts
