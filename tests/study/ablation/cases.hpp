// The data sets of the ablation: cells of the study of verdicts, recordings, and two runs.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "../verdicts/judged.hpp"
#include "../verdicts/made.hpp"
#include "../verdicts/verdict_of.hpp"
#include "ballbar/circle/recording.hpp"

namespace ballbar::ablation {

// One data set and what is true of it.
struct Case {
  Series data;
  Model model;
  std::vector<std::string> without;
  std::optional<Motion> motion;
  std::function<verdicts::Judged(const verdicts::Said&)> judged;
  std::string what = {};  // is hidden
};

struct Cell {
  std::string name;
  std::function<Case(std::uint64_t seed)> make;
};

std::vector<Cell> cells();

}  // namespace ballbar::ablation
