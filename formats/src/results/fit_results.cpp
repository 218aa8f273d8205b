#include "ballbar/formats/results/fit_results.hpp"

namespace ballbar {

std::string_view name_of(ParameterState state) {
  switch (state) {
    case ParameterState::free:
      return "free";
    case ParameterState::held:
      return "held";
    case ParameterState::on_lower_bound:
      return "on lower bound";
    case ParameterState::on_upper_bound:
      return "on upper bound";
    case ParameterState::undetermined:
      return "undetermined";
  }
  return "free";
}

}  // namespace ballbar
