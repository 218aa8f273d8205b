// Numbers as people write them, for sentences and tables; never for a program.
#pragma once

#include <string>
#include <string_view>

#include "ballbar/message.hpp"

namespace ballbar {

// "38.7 s", "4 min 25 s", "2 h 40 min", "124 h": to the second below an hour, to the minute below 100 h.
std::string duration_text(double duration_s);

// "20 000", "5000": rounded to an integer, in groups of three from five digits on.
std::string grouped_text(double value);

// "98 %", "over 99 %", "under 1 %".
std::string percent_text(double p);
Message percent_of(double p);
Message sure_of(double p);  // "98 % sure"

// A p-value or a small probability with two digits: "0.18", "0.00012", "< 0.000001".
std::string p_text(double p);

// "p = 0.18", "p < 0.000001".
std::string p_equals_text(double p);

// The decimals that show so many digits of a value from the first that is not 0: of 0.031 two need 3 decimals. 0 to
// `most`; 2 of what is 0 or not finite.
int decimals_showing(int digits, double value, int most = 6);

// The decimals of an error of a machine in its unit: 3 of ms, 2 of um, else 1.
int decimals_in(std::string_view unit);

// A length in um with two significant digits: "3.2", "14", "0.53", "1200".
std::string size_text(double size_um);

}  // namespace ballbar
