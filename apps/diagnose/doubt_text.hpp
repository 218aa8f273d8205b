// Why an effect is not named, or not supported, in words.
#pragma once

#include <string>
#include <vector>

#include "ballbar/diagnosis/verdict/diagnose.hpp"
#include "ballbar/message.hpp"

namespace ballbar {

// A phrase of the effect: "its gain differs from cycle to cycle", of one on recordings "from recording to recording".
Message message_of(Doubt doubt, const Effect& effect);

// "0.251 ± 0.002 um/K, over 18 K ": of an effect with a gain in um/K and an amplitude; else empty. The span is that of
// the temperature as the effect takes it.
Paragraph coefficient_of(const Candidate& candidate);

// Of all its doubts, in their order.
std::vector<Paragraph> doubts_of(const Candidate& candidate);

}  // namespace ballbar
