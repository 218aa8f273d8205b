#include "ballbar/next_test.hpp"

namespace ballbar {

std::vector<NextTest> next_tests(const Model&, const Series&, const Diagnosis&) { return {}; }

}  // namespace ballbar
