// A plan in plain words.
#pragma once

#include <string>

#include "ballbar/diagnosis/next_test/plan.hpp"
#include "ballbar/message.hpp"

namespace ballbar {

// "random speeds, the room 3 K warmer and back"
Paragraph name_of(const ExpectedTest& test);

// "preload_loss(T_head_degC) + step(onset_s = 3600)", "nothing of the catalogue"
std::string label_of(const ExpectedCurve& curve);

// "where speed_heating(speed_rpm) heats"
Message place_of(const SensorToAdd& sensor);

// What to do, what it would show, how sure that is, and what stays open. most_hours: of the longest test considered.
Paragraph sentence_of(const TestPlan& plan, double most_hours);

}  // namespace ballbar
