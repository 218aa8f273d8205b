#include <cmath>

#include "ballbar/circle/circle.hpp"
#include "ballbar/error.hpp"
#include "ballbar/units.hpp"
#include "numerics/autocorrelation.hpp"
#include "numerics/not_finite.hpp"

namespace ballbar {

AxialLength axial_length(const Recording& recording) {
  if (recording.kind != Kind::axial) throw Error("a circle recording has no axial length; expected an axial recording");
  const auto n = static_cast<Eigen::Index>(recording.length_mm.size());
  if (n == 0) throw Error("the axial recording has no readings; expected at least one");
  const Eigen::ArrayXd length_um = Eigen::Map<const Eigen::ArrayXd>(recording.length_mm.data(), n) * 1e3;
  const double mean_um = length_um.mean();
  AxialLength result;
  result.length_mm = mm_from_um(mean_um);
  result.sigma_um = kUnknown;
  if (n < 2) return result;
  const Eigen::ArrayXd residual_um = length_um - mean_um;
  const double count = static_cast<double>(n);
  result.rms_um = std::sqrt(residual_um.square().mean());
  const auto rho = least_squares::autocorrelation_of(residual_um);
  result.autocorrelation = rho.phi;
  double widening = 1.0;  // of the variance of the mean: 1 + 2 sum (1 - k/n) rho(k)
  double lagged = rho.share * rho.phi;
  for (double k = 1.0; k < count && lagged > 1e-12; k += 1.0, lagged *= rho.phi) {
    widening += 2.0 * (1.0 - k / count) * lagged;
  }
  result.sigma_um = std::sqrt(residual_um.square().sum() / (count - widening) * widening / count);
  return result;
}

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
