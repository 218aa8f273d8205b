#include "effects/evaluate.hpp"

namespace ballbar::catalogue {
namespace {

// k dL
struct AxialCrosstalk {
  template <class T>
  T operator()(const EffectRows& rows, std::size_t i, const T* p, T*) const {
    const std::span<const double> axial_um = rows.inputs[0];
    return p[0] * (axial_um[i] - axial_um[0]);
  }
};

}  // namespace

extern const Effect kAxialCrosstalk{
    "axial_crosstalk",
    Level::series,
    {.summary = "Elongation of an inclined spindle appears as radial drift.",
     .cause = "The spindle, or the direction in which it grows, is not parallel to the machine's axis.",
     .formula = "gain dL, dL the axial drift since the first row",
     .signature = "Radial drift in proportion to the axial drift, warming and cooling alike, always in one direction.",
     .confused_with = {"bearing_clearance", "expansion", "preload_loss"},
     .separated_by = "Measure the inclination of the spindle with a test bar: the gain must equal it.",
     .remedy = "Tram the spindle; 1 um/mm of inclination gives a gain of 0.001.",
     .validity = "Constant inclination during the run; gains above 0.05 have another cause.",
     .source = "Projection of the elongation on the radial direction; not from a paper."},
    {{"axial", {"um"}, "axial drift of the spindle"}},
    {gain_within("gain_um_per_um", "um/um", 10.0, "inclination of the growth, rad")},
    by_row<1>(AxialCrosstalk{}),
};

}  // namespace ballbar::catalogue
