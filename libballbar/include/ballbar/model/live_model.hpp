// Evaluates a model row by row as its inputs arrive, in O(1) per row.
//
// The results equal those of predict() over the whole series, bit by bit. Effects with memory keep a few numbers
// between rows. Effects that need rows other than the first, the previous and the current one (clock_offset) cannot run
// live.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "ballbar/effects/effect.hpp"
#include "ballbar/model/model.hpp"

namespace ballbar {

class LiveModel {
 public:
  // The state between rows, for storing. It holds rows 0, i - 1 and i, as far as they have arrived.
  struct State {
    std::size_t rows = 0;  // number of rows held, at most 3
    std::array<double, 3> time_s{};
    std::vector<double> inputs;  // three values per column, in the order of columns()
    std::vector<double> kept;    // memory of the effects, term by term
  };

  // Takes every parameter at its start value; a free constant is 0. Throws Error for a model of recordings and for an
  // effect that cannot run live.
  explicit LiveModel(const Model& model);
  LiveModel(const LiveModel&) = delete;
  LiveModel& operator=(const LiveModel&) = delete;

  // The columns that the model reads, each once.
  std::span<const std::string> columns() const { return columns_; }

  // The value of the model at this row, in um. The time must be after that of the previous row; `values` are finite, in
  // the order of columns(). Allocates no memory. A row with a result that is not finite does not change the state.
  double next(double time_s, std::span<const double> values);

  // n rows at once, on all cores; the same results as row by row. values: n of each of columns(). contributions_um: n
  // values of the first term, then n of the second, and so on. Returns false and changes nothing if a result may not be
  // finite; pass the rows one by one then.
  bool next(std::span<const double> time_s, std::span<const std::span<const double>> values,
            std::span<double> contributions_um);

  // Contribution of each term to the last row that was passed by itself, in um.
  std::span<const double> contributions_um() const { return contributions_um_; }

  const State& state() const { return state_; }

  // Treats the next row as the first.
  void begin_anew() { state_.rows = 0; }

  // Restores a stored state. Throws Error if it does not fit this model: other sizes, more than 3 rows, or times that
  // do not rise.
  void resume(const State& state);

 private:
  struct LiveTerm {
    Evaluate evaluate;
    std::vector<double> parameters;
    std::vector<std::size_t> column;  // index into columns_ of each input of the effect
    std::size_t kept = 0;             // where its memory begins in State::kept
    EffectRows rows;                  // points into state_; updated when the number of rows changes
  };

  double value_at(std::size_t row);
  void show_rows();

  double constant_um_ = 0.0;
  std::vector<std::string> columns_;
  std::vector<LiveTerm> terms_;
  State state_, before_;
  std::size_t shown_rows_ = 0;
  std::vector<double> contributions_um_;
};

}  // namespace ballbar
