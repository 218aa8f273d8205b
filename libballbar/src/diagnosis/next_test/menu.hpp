// The tests that a shop can do, as schedules.
#pragma once

#include <string>
#include <vector>

#include "ballbar/diagnosis/next_test/schedule.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

struct MenuLimits {
  double most_hours = 12.0;
  double max_rpm = 0.0;                              // 0: the highest speed of the data
  bool load = false, room = false, coolant = false;  // what can be moved
};

struct MenuItem {
  std::string kind;   // "random speeds": the same at every length
  std::string doing;  // a phrase for a sentence
  double hours = 0.0;
  Schedule schedule;
};

// Kinds by lengths of 4, 8, 12, 24 h up to most_hours, and that; a reading as often as the data have one, at most 2000.
// Of a machine whose data have no speed, only what stands beside it: the room, the coolant.
std::vector<MenuItem> menu_of(const Series& data, const std::string& target, const MenuLimits& limits);

}  // namespace ballbar
