// Outcomes of a cell, counted and printed.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "ballbar/challenge/blind.hpp"
#include "baselines.hpp"
#include "cells.hpp"

namespace ballbar::study {

struct Tally {
  std::size_t sets = 0;
  std::size_t right = 0, wrong = 0, called = 0;
  std::size_t with_fakes = 0, fake = 0;
  std::size_t hiding = 0, in_set = 0;
  std::size_t asked_oracle = 0, separable = 0, right_of_separable = 0;
  std::size_t asked_baselines = 0;
  std::array<std::size_t, kBaselines.size()> baseline_right{}, baseline_wrong{};
  std::vector<bool> amplitude, time_constant, covered;
  std::vector<double> training, other_duty;

  void add(const Outcome& outcome);
};

// Names of the columns.
std::string heading();
// One line, and indented ones for what was measured besides.
std::string lines_of(std::size_t number, const Cell& cell, const Tally& tally);

// Whether a gate is missed by more than three standard deviations and one more.
bool clearly_missed(const Gate& gate, const Tally& tally);

}  // namespace ballbar::study
