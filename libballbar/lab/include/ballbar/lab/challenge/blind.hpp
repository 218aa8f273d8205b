// Data sets with something hidden in them, to try a diagnosis on.
//
// Every set has a speed plan and a room of its own: 4 to 48 h, a row every 15 to 75 s. Its temperatures are those of a
// finite-volume spindle (finite_volume_spindle.hpp) of its own, measured to 0.1 K; which of them are logged is drawn.
// A base model of one or two effects with drawn shapes makes the target, what is hidden is added (both of the catalogue
// act on the temperatures as they are logged, so that the right model leaves noise alone), then noise: AR(1)
// with a coefficient of 0.5 to 0.98 from row to row, in a quarter of the sets heavy-tailed (Student's t with 4 degrees
// of freedom), rounded last. Every hidden signal has a stated d, 6 to 20: the norm of the signal, whitened by the true
// noise and freed of the base model, the root of the fall of chi^2 that finding it would bring. Signals of which the
// base model makes more than 95 % are not hidden.
//
//   nothing       nothing hidden
//   one, two      effects of the catalogue that are for it (EffectRules::is_common), shapes drawn off their
//                 grid; driven by inputs that are logged. Effects of time alone are not hidden: they are never named
//                 from one run
//   outside       what the catalogue does not have: speed times the room's temperature, an unlogged machine that
//                 switches on and off, the square of a temperature's rate, a resonance at one speed
//   inseparable   no diagnosis could tell: two sensors that log the same, a load that is proportional to the speed of
//                 a plan with one speed, a difference of temperatures to a room that is constant
//   spindle       a cause of the finite-volume spindle that the base model lacks, scaled; the base model's part is its
//                 best fit to the other causes. The effects that match say so themselves (EffectRules::explains), on
//                 any columns or on different ones of the cause's sensors:
//     z_centrifugal              none
//     z_rings                    T_front_degC, T_rear_degC
//     z_housing                  T_front_degC, T_rear_degC, T_motor_degC, T_housing_degC, T_coolant_degC
//     z_structure, y_structure   T_head_degC, T_column_degC, T_room_degC
//     y_bending                  T_front_degC, T_rear_degC, T_motor_degC, T_housing_degC, T_coolant_degC, T_head_degC
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ballbar/diagnosis/verdict/diagnose.hpp"
#include "ballbar/model/model.hpp"
#include "ballbar/noise/noise.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

enum class BlindKind { nothing, one, two, outside, inseparable, spindle };
std::string_view name_of(BlindKind kind);
std::optional<BlindKind> blind_kind_from_name(std::string_view name);

// Drawn: 20 % nothing, 30 % one, 15 % two, 15 % outside, 10 % inseparable, 10 % spindle.
BlindKind blind_kind(std::uint64_t seed);

struct BlindAnswer {
  BlindKind kind = BlindKind::nothing;
  std::string what;                  // a phrase: "lagged_expansion(T_room_degC)", "z_centrifugal of a spindle"
  std::vector<BoundEffect> hidden;   // one, two, inseparable: the effects; no columns: on any columns
  std::vector<BoundEffect> match;    // spindle: each of them is right
  std::vector<double> d;             // of each hidden signal
  std::vector<double> amplitude_um;  // its range, largest less smallest
};

struct BlindSet {
  Series data;  // what is logged and the target, y_um or z_um
  Model model;  // what a user believes
  BlindAnswer answer;
  std::vector<double> clean_um;                // the base model's part, one a row
  std::vector<std::vector<double>> hidden_um;  // the hidden signals
  Noise noise;                                 // the true one, rounding included
};

// The same kind and seed give the same set, of effects of the built-in catalogue.
BlindSet blind_set(BlindKind kind, std::uint64_t seed);

// What was said of a set.
struct BlindVerdict {
  Verdict verdict = Verdict::nothing;
  std::vector<BoundEffect> named;     // no columns: on any
  std::vector<BoundEffect> reported;  // any of these: probable, equivalent, or beside the named
};
BlindVerdict verdict_of(const Diagnosis& diagnosis);

//             right                                   in the set                              wrong
// nothing     nothing or untestable                   -                                       any other verdict
// one, two    named: all of it and nothing else,      every effect is named or reported       another effect is named
//             nothing reported beside it
// outside     unexplained                             -                                       any effect is named
// inseparable untestable, or not named and the        -                                       any effect is named, the
//             truth is reported                                                               true one too
// spindle     effects that match are named, no other  one that matches is reported            another effect is named
// and missed otherwise.
enum class BlindOutcome { right, in_set, missed, wrong };
std::string_view name_of(BlindOutcome outcome);  // "right", "in the set", "missed", "wrong"
BlindOutcome outcome_of(const BlindAnswer& answer, const BlindVerdict& verdict);

// A count of a number of sets, and Wilson's 95 % interval of the share behind it:
//   (p + z^2/2n -+ z sqrt(p (1 - p)/n + z^2/4n^2)) / (1 + z^2/n),  z = 1.959964, p = count/n.  n = 0: from 0 to 1.
// E. B. Wilson, Probable inference, the law of succession, and statistical inference, J. Am. Stat. Assoc. 22 (1927).
struct Share {
  std::size_t count = 0, of = 0;
  double low = 0.0, high = 1.0;
};
Share share_of(std::size_t count, std::size_t of);

struct Scores {
  Share false_calls;  // wrong, of `nothing`
  Share right;        // of all
  Share wrong;        // of all
  Share in_set;       // right or in the set, of one, two, inseparable and spindle
  Share false_names;  // wrong, of `outside`
};
// outcomes: one an answer.
Scores scores_of(std::span<const BlindAnswer> answers, std::span<const BlindOutcome> outcomes);

}  // namespace ballbar
