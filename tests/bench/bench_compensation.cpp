// A compensation row by row: the compensator alone, and from lines of sensors to lines of offsets as `ballbar
// compensate
// --signals` does it. Rows a second are the items.
#include <benchmark/benchmark.h>
#include <fmt/compile.h>
#include <fmt/format.h>

#include <cmath>
#include <string>

#include "ballbar/compensation/compensation.hpp"
#include "ballbar/formats/series/live_rows.hpp"
#include "compensate/offset_text.hpp"

namespace {

using ballbar::term_of;

// The model that peer.py computes too: one effect, or four of which three are low passes.
ballbar::CompensatedAxis axis(bool four) {
  ballbar::Model model;
  model.targets = {"z_um"};
  model.terms = {term_of("expansion", {"T_front_degC"})};
  model.terms[0].settings[0].start = 2.244;
  if (four) {
    for (const auto& [column, gain, lag_s] :
         {std::tuple{"T_front_degC", 1.2, 600.0}, {"T_rear_degC", -0.8, 3600.0}, {"T_room_degC", 0.5, 7200.0}}) {
      model.terms.push_back(term_of("lagged_expansion", {column}));
      model.terms.back().settings[0].start = gain;
      model.terms.back().settings[1].start = lag_s;
    }
  }
  return {"z", model};
}

// A row a second: a spindle that warms and cools over the hour.
constexpr int kRows = 100'000;
double front_degC(int i) { return 25.0 + 5.0 * std::sin(i * 2.0 * M_PI / 3600.0); }

void compensator(benchmark::State& state) {
  ballbar::CompensatedAxes axes({axis(state.range(0) == 4)}, {});
  std::vector<double> values(axes.columns().size());
  int i = 0;
  for (auto _ : state) {
    for (std::size_t c = 0; c < values.size(); ++c) values[c] = front_degC(i) + static_cast<double>(c);
    benchmark::DoNotOptimize(axes.next(i, values).data());
    ++i;
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(compensator)->Name("compensate_rows")->Arg(1)->Arg(4);

std::string lines() {
  fmt::memory_buffer out;
  fmt::format_to(std::back_inserter(out), "time_s,T_front_degC,T_rear_degC,T_room_degC\n");
  for (int i = 0; i < kRows; ++i) {
    const double degC = front_degC(i);
    fmt::format_to(std::back_inserter(out), FMT_COMPILE("{},{:.3f},{:.3f},{:.3f}\n"), i, degC, degC + 1.0, degC + 2.0);
  }
  return fmt::to_string(out);
}

void from_text_to_text(benchmark::State& state) {
  constexpr std::size_t kPiece = std::size_t{64} << 10;
  const std::string text = lines();
  fmt::memory_buffer out;
  for (auto _ : state) {
    ballbar::CompensatedAxes axes({axis(state.range(0) == 4)}, {});
    ballbar::LiveRows rows("memory", {axes.columns().begin(), axes.columns().end()});
    for (std::size_t at = 0; at < text.size(); at += kPiece) {
      rows.add(std::string_view(text).substr(at, kPiece));
      while (const ballbar::LiveRow* row = rows.next()) {
        ballbar::append_csv(out, row->time_s, axes.next(row->time_s, row->values));
      }
      benchmark::DoNotOptimize(out.data());
      out.clear();
    }
  }
  state.SetItemsProcessed(state.iterations() * kRows);
}
BENCHMARK(from_text_to_text)->Name("compensate_text")->Arg(1)->Arg(4)->Unit(benchmark::kMillisecond);

}  // namespace
