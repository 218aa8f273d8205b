// What a comparison of two drifts says.
#pragma once

#include "ballbar/drift/compare.hpp"
#include "ballbar/message.hpp"

namespace ballbar {

// Whether the series agree, which axis does not, since when and by how much.
Paragraph conclusion(const Comparison& comparison);

}  // namespace ballbar
