#include <algorithm>
#include <limits>

#include "catalogue.hpp"
#include "evaluate.hpp"

namespace ballbar::catalogue {
namespace {

// k H_i, H_i the share of the time from row i - 1 to row i that lies after the onset: 0 before it, 1 after it. An onset
// on a row's time gives the exact step just after that row. In between, one row takes the share, so that value and
// derivative agree and a solver can move the onset within the step of a row; over longer ways a search over the rows'
// times must bring it near. The first row takes the width of the second.
struct Step {
  template <class T>
  void operator()(const EffectRows& rows, const T* p, T* out) const {
    const std::span<const double> time_s = rows.time_s;
    for (std::size_t i = 0; i < time_s.size(); ++i) {
      const std::size_t end = std::min(std::max<std::size_t>(i, 1), time_s.size() - 1);
      const double width_s = end > 0 ? time_s[end] - time_s[end - 1] : 1.0;
      const T share = (time_s[i] - p[1]) / width_s;
      if (!(share > T(0.0))) {
        out[i] = T(0.0);
      } else if (share > T(1.0)) {
        out[i] = p[0];
      } else {
        out[i] = p[0] * share;
      }
    }
  }
};

}  // namespace

const Effect kStep{
    "step",
    Level::series,
    {.summary = "A jump at one moment.",
     .cause = "A knock, a magnet that slips or a change of tool that nobody logged.",
     .formula =
         "gain H(t - onset), t as in the data; a row counts with the share of the time since the row before that "
         "lies after the onset",
     .signature = "The residual jumps once and stays.",
     .confused_with = {"linear_drift", "settling", "preload_loss", "centrifugal_shift"},
     .separated_by = "Repeat the run: a knock does not come again, a physical cause does, at the same state.",
     .remedy = "Reseat the set-up and repeat; leave out the rows before or after; log events.",
     .validity = "One jump; its moment is known to the distance of two measured rows at best.",
     .source = "A shift of the set-up; no paper's equation."},
    {},
    {{"gain_um", "um", ParameterKind::gain, 0.0, -10000.0, 10000.0, {}, "height of the jump"},
     {"onset_s",
      "s",
      ParameterKind::shape,
      0.0,
      -std::numeric_limits<double>::infinity(),
      std::numeric_limits<double>::infinity(),
      {},
      "moment of the jump, in the time of the data; searched over all rows"}},
    evaluated_by<2>(Step{}),
    true,
};

}  // namespace ballbar::catalogue
