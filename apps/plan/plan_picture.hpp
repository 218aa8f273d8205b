// The picture of a plan.
#pragma once

#include <string>

#include "plan/plan_contents.hpp"

namespace ballbar {

// SVG of 960 px: title and text, the schedule's speed (and load, room and coolant, where they are set), below it what
// each hypothesis expects with a band of one sigma, the six of the largest p; shaded where they part. Any text is
// escaped, what is not finite is left out, a long curve is drawn by 500 of its points.
std::string plan_picture(const PlanContents& contents);

}  // namespace ballbar
