// A data set with its truth.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ballbar/model/model.hpp"
#include "ballbar/series/series.hpp"
#include "hidden.hpp"
#include "logging.hpp"
#include "scatter.hpp"

namespace ballbar::verdicts {

struct Truth {
  std::string effect;
  std::vector<std::string> columns;  // in the order of the effect's inputs
  std::vector<ParameterTruth> parameters;
};

// What the user's model holds and should not.
struct OwnTruth {
  std::string effect;  // label of the term
  std::string parameter;
  double held = 0.0;
  double value = 0.0;
};

struct Made {
  Series data;
  Model model;
  std::vector<Truth> truths;
  std::optional<OwnTruth> own;
  bool is_outside = false;           // what is hidden is in no catalogue that is searched
  std::vector<std::string> drivers;  // columns that drive what is hidden
  std::vector<std::string> without;  // effects that the search leaves out
  std::string what;                  // as printed
  double sigma_um = 0.0;
  double d = 0.0;  // of each
  // Effects hidden: the probability that one who knows the noise and the other effects could state of the one that is
  // hardest to tell (rivals.hpp), and what it is taken for.
  double ideal_p = 1.0;
  std::string rival;
  std::uint64_t seed = 0;
  std::array<double, kQuantities> late_s{};  // of the columns' clocks
};

enum class Kind { nothing, effects };
enum class Noise { any, ar90, ar98, heavy, coarse };

enum class Course { rich, poor, one_speed };

struct Recipe {
  Kind kind = Kind::effects;
  Course course = Course::rich;
  std::size_t count = 1;  // of hidden effects
  bool step = false;      // and a step
  double d = 10.0;
  Noise noise = Noise::any;
  Logging logging = Logging::exact;
  double most_late = 0.0;
  double kelvin_step = 0.01;
  std::size_t fakes = 0;  // temperatures of nothing
  std::size_t row_s = 0;  // 0: drawn
};

// `stream`: another for every cell.
Made made(const Recipe& recipe, std::string_view stream, std::uint64_t seed);

}  // namespace ballbar::verdicts
