// Pass or fail of a ballbar test: its circularity by the tolerance that was given, its stored results by the limits in
// its file. Values are compared as they are, without a guard band for their sigma.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ballbar/formats/recordings/b5r.hpp"
#include "ballbar/history/history.hpp"
#include "ballbar/message.hpp"

namespace ballbar {

// A stored result with limits in its file.
struct LimitCheck {
  StoredFeature result;
  Judgement judgement = Judgement::pass;
};
std::vector<LimitCheck> limit_checks(const B5r& b5r);

struct ToleranceCheck {
  std::optional<double> tolerance_um;  // of the circularity; nullopt: none was given
  // Largest less smallest reading of all recordings about the fitted centre, or as stored; nullopt: not known.
  std::optional<double> circularity_um;
  std::string stored_in;  // run or analysis that stores the circularity; empty: fitted
  std::vector<LimitCheck> limits;
};

// Whether all hold; a warning does. nullopt: without a tolerance, or nothing to compare.
std::optional<bool> passes(const ToleranceCheck& check);

// "circularity 7.2 um: fails the tolerance of 6 um", and a line for each stored result that a limit does not pass.
std::vector<Paragraph> tolerance_lines(const ToleranceCheck& check);

// The same of a row of a table of tests.
std::optional<bool> passes(const MachineTest& test, double tolerance_um);

}  // namespace ballbar
