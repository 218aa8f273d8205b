// Chances of values as large as these.
#pragma once

#include <cstddef>

namespace ballbar {

// Of a chi^2 with so many degrees of freedom, more than none; 1 where it is not positive.
double chi2_upper_tail(double chi2, std::size_t degrees);

// Of at least `least` of `count` where each has this chance.
double binomial_upper_tail(std::size_t least, std::size_t count, double chance);

}  // namespace ballbar
