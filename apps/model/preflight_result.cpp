#include "model/preflight_result.hpp"

namespace ballbar {

std::string_view name_of(Testability testability) {
  switch (testability) {
    case Testability::testable:
      return "testable";
    case Testability::input_missing:
      return "input missing";
    case Testability::input_constant:
      return "input constant";
    case Testability::absorbed:
      return "absorbed by the model";
    case Testability::in_the_model:
      return "in the model";
    case Testability::other_motion:
      return "other motion";
  }
  return "testable";
}

}  // namespace ballbar
