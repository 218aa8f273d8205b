// The measured 46 h record itself: nobody knows its truth, but what it shows has to come out.
#pragma once

#include <cstdint>
#include <optional>

#include "outcome.hpp"

namespace ballbar::study {

// Seeds 1 to 3: ch3, ch1, ch5 by speed_heating with the square of the speed. Right: an effect of the room (T16) is
// named or reported on ch3 and ch1, the RMSE falls by 55 % and that of cycles left out by 50 %; on ch5 none is named.
std::optional<Outcome> measured_room(std::uint64_t seed);

// 20 fake temperatures beside the measured ones, channel by channel. Wrong: one of them is named; of other names
// nobody knows.
Outcome measured_fakes(std::uint64_t seed);

}  // namespace ballbar::study
