// One made set through the loop: data, verdict, test, data of that test, verdict, and so on.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "verdicts/another_run.hpp"
#include "verdicts/judged.hpp"

namespace ballbar::next_test {

struct Cell {
  std::string name;    // "poor-held"
  std::string stream;  // of its random numbers
  verdicts::Recipe recipe;
};

// {poor plan, one speed} x {exact, held, late, 0.1 K}, one effect hidden at d = 10.
std::vector<Cell> cells();

struct LoopOptions {
  double hours = 12.0;          // of a test at most
  double max_rpm = 0.0;         // 0: the highest of the data
  std::size_t stages = 1;       // tests at most
  std::string plan = "design";  // or "staircase", or the name of a fixed plan
  verdicts::Places places = verdicts::Places::machine;
};

// After the data alone (the first of them), and after each test. A verdict that names ends the loop, and a design that
// has none to offer; what was said then stands in all later stages.
struct Stage {
  bool is_tested = false;  // a test was made in this stage
  verdicts::Judged judged;
  verdicts::Said said;
  double hours = 0.0;  // of all tests so far
  double promised = 0.0;
  double design_s = 0.0, diagnosis_s = 0.0;
};

struct Looped {
  verdicts::Made made;
  std::vector<Stage> stages;
};

// Throws what the core throws, and std::runtime_error for a plan that there is not.
Looped looped(const Cell& cell, std::uint64_t seed, const LoopOptions& options);

}  // namespace ballbar::next_test
