// Writes what the benchmarks work on to a folder, for peer.py: test.b5r, log.csv, circle.csv and probes.csv.
//
//   bench_files FOLDER LOG_MB CIRCLE_READINGS PROBE_ROWS
#include <cstdlib>
#include <filesystem>
#include <iostream>

#include "ballbar/formats/recordings/ballbar_log.hpp"
#include "ballbar/formats/series/series_csv.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "bench_data.hpp"

int main(int argc, char** argv) {
  if (argc != 5) {
    std::cerr << "bench_files FOLDER LOG_MB CIRCLE_READINGS PROBE_ROWS\n";
    return 2;
  }
  const std::filesystem::path folder = argv[1];
  std::filesystem::create_directories(folder);
  ballbar::write_bytes(folder / "test.b5r", ballbar::bench::b5r_bytes());
  ballbar::write_bytes(folder / "log.csv", ballbar::bench::log_bytes(std::strtoull(argv[2], nullptr, 10) * 1'000'000));
  ballbar::write_bytes(folder / "circle.csv",
                       ballbar::write_ballbar_log(ballbar::bench::circle_of(std::strtoull(argv[3], nullptr, 10))));
  ballbar::write_bytes(folder / "probes.csv",
                       ballbar::write_series(ballbar::bench::five_probe_series(std::strtoull(argv[4], nullptr, 10))));
  return 0;
}
