// Files of a machine's tests, two runs each: read, fitted with sigma, the history made. BALLBAR_BENCH_TESTS: how many
// files, 1000.
#include <benchmark/benchmark.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "ballbar/formats/text/file_bytes.hpp"
#include "ballbar/history/history.hpp"
#include "bench_data.hpp"
#include "errors/test_files.hpp"
#include "history/history_text.hpp"

namespace {

int number_of_files() {
  const char* const asked = std::getenv("BALLBAR_BENCH_TESTS");
  return asked == nullptr ? 1000 : std::atoi(asked);
}

struct Folder {
  std::filesystem::path path;
  explicit Folder(int files)
      : path(std::filesystem::temp_directory_path() / ("ballbar-history-" + std::to_string(getpid()))) {
    std::filesystem::create_directories(path);
    for (int i = 0; i < files; ++i)
      ballbar::write_bytes(path / (std::to_string(i) + ".b5r"), ballbar::bench::b5r_of_week(i));
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() { std::filesystem::remove_all(path); }
};

void history_of_folder(benchmark::State& state) {
  const int files = number_of_files();
  const Folder folder(files);
  ballbar::HistoryOptions how;
  how.every_quantity = true;
  for (auto _ : state) {
    const ballbar::FoundHistory found =
        ballbar::found_history(ballbar::read_tests({folder.path.string()}, true), {folder.path.string()}, how);
    benchmark::DoNotOptimize(ballbar::history_text(found, false));
  }
  state.SetItemsProcessed(state.iterations() * files);
}

BENCHMARK(history_of_folder)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
