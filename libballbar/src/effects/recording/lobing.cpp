#include <cmath>

#include "effects/evaluate.hpp"
#include "effects/recording_rows.hpp"

namespace ballbar::catalogue {
namespace {

// c cos k theta + s sin k theta
struct Lobing {
  template <class T>
  T operator()(const EffectRows& rows, std::size_t i, const T* p, T*) const {
    using std::cos, std::sin;
    const std::span<const double> angle_rad = rows.inputs[0];
    const T phase_rad = p[2] * angle_rad[i];
    return p[0] * cos(phase_rad) + p[1] * sin(phase_rad);
  }
};

}  // namespace

extern const Effect kLobing{
    "lobing",
    Level::recording,
    {.summary = "The path has three or more equal lobes per turn.",
     .cause =
         "Form error of a ball or its cup, a part clamped in a three-jaw chuck, or races and rollers of a bearing.",
     .formula = "cosine cos(k theta) + sine sin(k theta), k lobes a turn",
     .signature = "Lobes of equal height at fixed angles, equal in both directions and at every feed.",
     .confused_with = {"cyclic_error_a", "cyclic_error_b", "vibration", "straightness_a", "straightness_b"},
     .separated_by = "Turn the ball in its cup and repeat: lobes of the ball turn with it. Another feed moves a "
                     "vibration and another radius moves a cyclic error; lobes keep their number and height.",
     .remedy = "Clean or replace ball and cup; check the chuck jaws and the bearing.",
     .validity = "3 to 15 lobes; one and two lobes are the circle and the oval.",
     .source = "Harmonic of the radius; not from a paper."},
    {angle_input()},
    {gain_within("cosine_um", "um", 1000.0, "amplitude of the part with a lobe along +A"),
     gain_within("sine_um", "um", 1000.0, "amplitude of the part with no deviation along +A"),
     {"lobes",
      "1",
      ParameterKind::shape,
      3.0,
      3.0,
      15.0,
      {3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0, 11.0, 12.0, 13.0, 14.0, 15.0},
      "lobes per turn, a whole number",
      true}},
    by_reading<3>(Lobing{}),
};

}  // namespace ballbar::catalogue
