// The F-test of added columns.
#pragma once

namespace ballbar::study {

// Chance of a larger F with these degrees of freedom: I_x(d2/2, d1/2), x = d2 / (d2 + d1 F), I the regularised
// incomplete beta function. NIST DLMF 8.17. To 1e-10.
double p_of_f(double f, double d1, double d2);

}  // namespace ballbar::study
