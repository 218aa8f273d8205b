// The one exception of ballbar: something the user can put right.
//
// what() is a whole sentence: where (file:line:column, or the option), what was expected, what was
// found and, where there are any, the choices. A numerical outcome (not converged, parameter
// undetermined) is never an Error; it is data in the result.
#pragma once

#include <stdexcept>

namespace ballbar {

class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace ballbar
