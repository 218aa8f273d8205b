// A user's formula, checked letter by letter before muParser sees it, and cut at its lags.
//
// muParser evaluates a formula row by row, but lag(x, tau) needs the whole series: so each lag becomes a variable of
// its own, filled before the formula around it is evaluated. Names become short variables too, so that any column's
// name will do. muParser then reads a text that it accepts; its own messages are not for users.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace ballbar {

inline constexpr std::size_t kLongestFormula = 4096;    // bytes
inline constexpr std::size_t kDeepestBrackets = 50;     // in one another
inline constexpr std::size_t kMostLags = 20;            // in one formula
inline constexpr std::string_view kFormulaTime = "t";   // s
inline constexpr std::string_view kFormulaName = "n";   // names[i] is the variable n<i> of a text
inline constexpr std::string_view kFormulaLag = "lag";  // lags[i] is the variable lag<i> of a text

struct Formula {
  struct Name {
    std::string name;
    std::size_t column = 0;  // where it stands first, counted in characters from 1
  };
  struct Lag {
    std::string input;  // texts for muParser
    std::string time_constant_s;
  };
  std::vector<Name> names;  // neither function nor constant nor t; in the order of the formula
  std::vector<Lag> lags;    // inner before outer
  std::string text;         // of the whole
};

// Throws Error "formula, column 12: expected ..., found ...".
Formula parse_formula(std::string_view formula);

}  // namespace ballbar
