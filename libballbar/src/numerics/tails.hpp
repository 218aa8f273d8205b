// Chances of values as large as these.
#pragma once

#include <cstddef>

namespace ballbar {

// Of a chi^2 with so many degrees of freedom, more than none; 1 where it is not positive.
double chi2_upper_tail(double chi2, std::size_t degrees);
// The chi^2 that is exceeded with that chance, above 0 and at most 1.
double chi2_exceeded(double chance, std::size_t degrees);

// Of a t of Student beyond this on either side, of an F of Fisher above it. Degrees may be broken; 1 where F is not
// positive. Infinite degrees of the rest: the normal's, and chi^2 / degrees.
double student_tails(double t, double degrees);
double fisher_upper_tail(double f, std::size_t degrees, double degrees_of_rest);

// Of at least `least` of `count` where each has this chance.
double binomial_upper_tail(std::size_t least, std::size_t count, double chance);

}  // namespace ballbar
