// The state of a compensation, a JSON file, so that it resumes without a jump after a restart.
//
//   {"format": "ballbar-compensation 1",
//    "signals": {"file": "/logs/live.csv", "inode": 1234, "bytes": 56789},
//    "axes": [{"name": "z", "model": "...", "resolution_um": 0.1, "counts": -31, "offset_um": -3.12, ...}]}
//
// ballbar writes it for itself; `counts` and `offset_um` are also useful to people.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ballbar/compensation/compensation.hpp"

namespace ballbar {

// A file of signals and how many of its bytes have been read. After a restart only the rest is new.
struct SignalsPlace {
  std::string file;
  std::uint64_t inode = 0;
  std::uint64_t bytes = 0;
};

struct StoredAxis {
  std::string name;
  std::string model;  // a digest that must match on resume; in files of older versions the text of the model
  Compensator::State state;
  LiveModel::State live;
};

struct StoredCompensation {
  std::vector<StoredAxis> axes;
  std::optional<SignalsPlace> signals;  // nullopt: a pipe
};

std::string write_compensation(const StoredCompensation& stored);

// `name` is used in messages. Throws Error for anything that write_compensation() would not write.
// Compensator::resume() checks the numbers against the model.
StoredCompensation read_compensation(std::string_view bytes, std::string_view name);

}  // namespace ballbar
