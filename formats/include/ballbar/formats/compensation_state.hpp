// Where a compensation stands, so that it goes on after a restart without a jump: a JSON file.
//
//   {"format": "ballbar-compensation 1",
//    "axes": [{"name": "z", "model": "...", "resolution_um": 0.1, "counts": -31, "offset_um": -3.12, ...}]}
//
// It is written by ballbar for ballbar; `counts` and `offset_um` are for people too.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "ballbar/compensated_axes.hpp"

namespace ballbar {

struct StoredAxis {
  std::string name;
  std::string model;  // its text, which must be the same to go on
  Compensator::State state;
  LiveModel::State live;
};

std::string write_compensation(const std::vector<StoredAxis>& axes);

// `name` stands in messages. Throws Error for anything but what write_compensation wrote; whether the numbers suit the
// model is for Compensator::resume.
std::vector<StoredAxis> read_compensation(std::string_view bytes, std::string_view name);

}  // namespace ballbar
