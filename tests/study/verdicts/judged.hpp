// Whether what the diagnosis says of a made set is true.
#pragma once

#include <string>
#include <vector>

#include "made.hpp"
#include "verdict_of.hpp"

namespace ballbar::verdicts {

inline constexpr double kSure = 0.9;  // a probability from which a driver or an own value counts as said

struct Stated {
  double p = 0.0;
  bool is_true = false;
};

struct Covered {
  bool is_gain = false;
  bool covers = false;
};

struct Judged {
  bool right = false, wrong = false;
  bool probably_right = false, probably_wrong = false;  // verdict `probable`
  bool driver_right = false, driver_wrong = false;
  bool in_set = false;        // every truth is named, probable or in an equivalent set
  bool any = false;           // a truth is named, and nothing else
  bool nothing_said = false;  // verdict `nothing` or `untestable`
  bool undecided = false;     // outside: no cause named, no driver, not `nothing`
  bool is_clear = false;      // one who knows the noise could name the truth
  double took_s = 0.0;
  std::vector<Stated> stated;    // in-catalogue sets: of every effect with a probability above 0.05
  std::vector<Covered> covered;  // of rightly named effects
};

// Effect and columns; of a bending the two columns in either order.
bool is_same(const Truth& truth, const Member& member);

Judged judged(const Made& made, const Said& said);

std::string line_of(const Made& made, const Said& said, const Judged& judged);

}  // namespace ballbar::verdicts
