#include "ballbar/circle/elongation_correction.hpp"

#include <cmath>

#include "ballbar/units.hpp"

namespace ballbar {

double elongation_correction_um(ElongationForm form, double radius_mm, double height_offset_mm, double elongation_um) {
  const double elongation_mm = mm_from_um(elongation_um);
  if (form == ElongationForm::eq34) {
    // r / cos(x) - r = r (1 - cos x) / cos x = 2 r sin^2(x/2) / cos x, without the difference of near equals.
    const double x = elongation_mm / radius_mm;
    const double half = std::sin(x / 2.0);
    return um_from_mm(radius_mm * 2.0 * half * half / std::cos(x));
  }
  const double lifted_mm = height_offset_mm + elongation_mm;
  const double before_mm = std::hypot(radius_mm, height_offset_mm);
  const double after_mm = std::hypot(radius_mm, lifted_mm);
  // after - before = (after^2 - before^2) / (after + before)
  return um_from_mm((lifted_mm - height_offset_mm) * (lifted_mm + height_offset_mm) / (after_mm + before_mm));
}

}  // namespace ballbar
