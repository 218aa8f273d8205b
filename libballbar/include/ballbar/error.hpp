// The one exception of ballbar: something the user can put right.
//
// what() is a whole sentence: where (file:line:column, or the option), what was expected, what was found and, where
// there are any, the choices: "log.csv:12:4: expected a number, found 'n/a'".
//
// A numerical outcome is never an Error: a fit that did not converge, a parameter that the data do not determine and a
// test without power are data in the result. A broken rule of the library itself (an index beyond the end) is not
// checked for.
//
// No function leaves half a result behind: after an Error the arguments are as before. Classes with a state say so.
#pragma once

#include <stdexcept>

namespace ballbar {

// Thrown by value, caught by reference. Safe to pass between threads.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace ballbar
