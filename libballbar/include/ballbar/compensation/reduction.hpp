// How much smaller a compensation made an error, and how sure that is.
#pragma once

#include <cstddef>
#include <span>

namespace ballbar {

// Of n values: what is compared from before to after.
enum class ErrorSize { mean_of_sizes, root_mean_square };

// share = 1 - size(after) / size(before); 0.7: 70 % less. sigma by leaving out each stretch of `stretch` values in turn
// (delete-a-group jackknife), a stretch being twice as long as what is left after stays alike: the lag at which its
// autocorrelation falls below 0.2, at least 1 value, at most a fifth of all.
struct Reduction {
  double before_um = 0.0;
  double after_um = 0.0;
  double share = 0.0;  // NaN where there was no error before
  double sigma = 0.0;  // NaN: fewer than 3 values
  std::size_t stretch = 1;
};

// n >= 1 errors in um before and as many after, pair by pair, in order of time.
Reduction reduction_of(std::span<const double> before_um, std::span<const double> after_um, ErrorSize size);

// Table 3 of Huang, Li, Zhao 2022 (doi 10.19650/j.cnki.cjsi.J2209226): depth of a bore from the table's surface,
// nominally 30 mm, and its diameter, nominally 175 mm, of ten workpieces without and with compensation.
//
// What the paper states of it, against the ten rows: radial 53.6 %, and 53.6 % it is. Axial 73.5 %; the means it prints
// give 73.7 %, and the rows 72.9 %: their mean with compensation is 29.994491 mm where it prints 29.994649.
struct Huang2022Bore {
  double depth_before_mm, diameter_before_mm;
  double depth_after_mm, diameter_after_mm;
};
std::span<const Huang2022Bore> huang2022_table_3();

inline constexpr double kHuang2022Depth_mm = 30.0, kHuang2022Diameter_mm = 175.0;
inline constexpr double kHuang2022Axial = 0.735, kHuang2022Radial = 0.536;  // as printed

Reduction huang2022_axial_reduction();
Reduction huang2022_radial_reduction();

}  // namespace ballbar
