// What is logged in a data set before anything is hidden in it: speed plan, room and temperatures.
//
// All of them come from the measured 46 h record (sample-runs/spindle-46h): 1250, 2500, 3750 and 5000 rpm, each 4 h and
// then 4 h of rest; the room (T16), the coolant (T4), a bearing (T5, warm whenever the spindle turns) and the housing
// (T3).
#pragma once

#include <cstddef>
#include <random>
#include <string>
#include <vector>

#include "ballbar/series/series.hpp"

namespace ballbar::study {

using Random = std::mt19937_64;

struct Record {
  Series inputs;
  std::vector<std::size_t> readings;  // rows with a value of the target; empty: all
  std::vector<double> sigma_um;       // stated, one a reading; empty: none
};

// Means of `each` rows of 15 s.
Record rich_record(std::size_t each = 5);

// Another duty cycle: the same cycles in another order, the fastest first.
Record other_duty();

// One cycle of 4 h at 5000 rpm and 4 h of rest, a row every 75 s: speed, the room of the record and a bearing that
// warms with 25 min.
Record poor_record();

// Half an hour of rest, then one speed for 8 h, the motor's load in proportion to it; rows and columns as the poor one.
Record one_speed_record();

// A room that keeps its first temperature.
Record with_constant_room(Record record);

// Ballbar tests while a spindle warms up: 15 to 20 of them, 8 or 20 min apart, from up to half an hour before a start
// of the record on. Signals every 75 s; sigma of a test 0.2 to 0.4 um.
Record session_record(Random& random);

// A signal logged once more, as NAME_2.
Column logged_again(const Column& column);

// Signals without any meaning: sums of two low-passed random walks and noise, 1 K.
std::vector<Column> fake_temperatures(const std::vector<double>& time_s, std::size_t count, Random& random);
bool is_fake(const std::string& column);

// Columns of the measured record that are its targets here, with all signals of the rich one.
Series measured_record(std::size_t each);

}  // namespace ballbar::study
