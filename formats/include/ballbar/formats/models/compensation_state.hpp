// Where a compensation stands, so that it goes on after a restart without a jump: a JSON file.
//
//   {"format": "ballbar-compensation 1",
//    "signals": {"file": "/logs/live.csv", "inode": 1234, "bytes": 56789},
//    "axes": [{"name": "z", "model": "...", "resolution_um": 0.1, "counts": -31, "offset_um": -3.12, ...}]}
//
// It is written by ballbar for ballbar; `counts` and `offset_um` are for people too.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ballbar/compensation/compensated_axes.hpp"

namespace ballbar {

// A file of signals, and how much of it has been taken: after a restart the rest alone is new.
struct SignalsPlace {
  std::string file;
  std::uint64_t inode = 0;
  std::uint64_t bytes = 0;
};

struct StoredAxis {
  std::string name;
  std::string model;  // a digest, which must be the same to go on; of older versions its text
  Compensator::State state;
  LiveModel::State live;
};

struct StoredCompensation {
  std::vector<StoredAxis> axes;
  std::optional<SignalsPlace> signals;  // nothing: a pipe
};

std::string write_compensation(const StoredCompensation& stored);

// `name` stands in messages. Throws Error for anything but what write_compensation wrote; whether the numbers suit the
// model is for Compensator::resume.
StoredCompensation read_compensation(std::string_view bytes, std::string_view name);

}  // namespace ballbar
