#include "models/live_state_json.hpp"

#include <algorithm>

namespace ballbar {
namespace {

constexpr std::size_t kMostNumbers = 1'000'000;

std::vector<double> numbers_of(const JsonValue& value) {
  const std::size_t count = size_of_array(value);
  if (count > kMostNumbers) fail(value, "at most a million numbers");
  std::vector<double> read;
  read.reserve(count);
  for (std::size_t i = 0; i < count; ++i) read.push_back(number(element(value, i)));
  return read;
}

}  // namespace

nlohmann::ordered_json json_of(const LiveModel::State& live) {
  return {{"rows", live.rows}, {"time_s", live.time_s}, {"inputs", live.inputs}, {"kept", live.kept}};
}

LiveModel::State live_state_at(const JsonValue& value) {
  expect_keys(value, {"rows", "time_s", "inputs", "kept"});
  LiveModel::State live;
  live.rows = whole(member(value, "rows"), 0, live.time_s.size());
  const std::vector<double> time_s = numbers_of(member(value, "time_s"));
  if (time_s.size() != live.time_s.size()) fail(member(value, "time_s"), "3 numbers");
  std::copy(time_s.begin(), time_s.end(), live.time_s.begin());
  live.inputs = numbers_of(member(value, "inputs"));
  live.kept = numbers_of(member(value, "kept"));
  return live;
}

}  // namespace ballbar
