// A German logger's CSV of a date, 20 temperatures and as many decimal commas, read from memory. Its rows:
// BALLBAR_BENCH_ROWS, 1 000 000 unless given.
#include <benchmark/benchmark.h>

#include <cstdlib>
#include <string>

#include "ballbar/formats/logs/log.hpp"

namespace {

void append_decimal(std::string& text, int hundredths) {
  text += std::to_string(hundredths / 100) + ',';
  text += static_cast<char>('0' + hundredths / 10 % 10);
  text += static_cast<char>('0' + hundredths % 10);
}

std::string log_text(std::size_t rows) {
  std::string text = "Zeit";
  for (int k = 1; k <= 20; ++k)
    text += ";Temp " + std::to_string(k) +
            " [\xC2\xB0"
            "C]";
  text += '\n';
  for (std::size_t row = 0; row < rows; ++row) {
    const std::size_t second = row % 86400;
    const auto two = [](std::size_t value) { return (value < 10 ? "0" : "") + std::to_string(value); };
    text += two(1 + row / 86400 % 28) + ".11.2026 " + two(second / 3600) + ':' + two(second / 60 % 60) + ':' +
            two(second % 60);
    for (std::size_t k = 0; k < 20; ++k) {
      text += ';';
      append_decimal(text, static_cast<int>(2000 + (row * (k + 3)) % 1500));
    }
    text += '\n';
  }
  return text;
}

void import_log(benchmark::State& state) {
  const char* const rows = std::getenv("BALLBAR_BENCH_ROWS");
  const std::string bytes = log_text(rows ? std::strtoull(rows, nullptr, 10) : 1'000'000);
  for (auto _ : state) benchmark::DoNotOptimize(ballbar::read_log(bytes, "memory").series.time_s.size());
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(bytes.size()));
}

BENCHMARK(import_log)->Unit(benchmark::kMillisecond);

}  // namespace
