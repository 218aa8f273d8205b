// Sentences for events and their remedies.
#pragma once

#include <string>

#include "ballbar/message.hpp"
#include "history/events.hpp"

namespace ballbar {

struct EventTexts {
  Paragraph sentence, remedy;
};

EventTexts texts_of(const AllSeries& all, const Event& event);

std::string day_text(double time_s);  // "2025-09-04"

// "squareness XY", "5.0 ± 0.2 um".
Message quantity_of(std::string_view name, Plane plane);
std::string amount_text(double value, double sigma, std::string_view unit);

}  // namespace ballbar
