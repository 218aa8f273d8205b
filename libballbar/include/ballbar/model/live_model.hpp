// A model evaluated as its inputs arrive, a row at a time: O(1) a row, whatever came before.
//
// Row by row it gives what predict() gives over the whole series, to the last bit; an effect with memory hands its
// few numbers on. Effects that need other rows than the first, the last and this one (clock_offset) cannot run live.
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
  // Values alone, for a store. Rows 0, i - 1 and i, as many as have come.
  struct State {
    std::size_t rows = 0;  // at most 3
    std::array<double, 3> time_s{};
    std::vector<double> inputs;  // three a column, as columns()
    std::vector<double> kept;    // of the effects, term by term
  };

  // Every parameter at its start; the constant is 0 where the model leaves it free. Throws Error for a model of
  // recordings and for an effect that cannot run live.
  explicit LiveModel(const Model& model);
  LiveModel(const LiveModel&) = delete;
  LiveModel& operator=(const LiveModel&) = delete;

  // Those of the model's inputs, each once.
  std::span<const std::string> columns() const { return columns_; }

  // The model in um at this row: time after the last one's, finite values in the order of columns(). Takes no memory.
  // A row that gives no finite value is forgotten.
  double next(double time_s, std::span<const double> values);

  // n rows at once, shared out among the cores: each as if it came alone. values: n of each of columns(). Each term's
  // contributions are written one term after the other, n each. False, and nothing has changed, where a row may give no
  // finite value: then they are to come one by one.
  bool next(std::span<const double> time_s, std::span<const std::span<const double>> values,
            std::span<double> contributions_um);

  // What each term added to the last row that came alone, in their order.
  std::span<const double> contributions_um() const { return contributions_um_; }

  const State& state() const { return state_; }

  // The next row is the first.
  void begin_anew() { state_.rows = 0; }

  // Throws Error where it is that of another model: other sizes, more than 3 rows, times that do not rise.
  void resume(const State& state);

 private:
  struct LiveTerm {
    Evaluate evaluate;
    std::vector<double> parameters;
    std::vector<std::size_t> column;  // of columns_, as the effect's inputs
    std::size_t kept = 0;             // where its numbers begin
    EffectRows rows;                  // of state_, whose places stay; set where their number changes
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
