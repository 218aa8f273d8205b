#include "ballbar/formats/text/given_data.hpp"

#include <fmt/format.h>

#include <map>
#include <utility>

#include "ballbar/error.hpp"

namespace ballbar {
namespace {

thread_local std::map<std::string, GivenData> all_given;

const GivenData* given(const std::filesystem::path& path) {
  if (all_given.empty()) return nullptr;
  const auto found = all_given.find(path.string());
  return found == all_given.end() ? nullptr : &found->second;
}

}  // namespace

Given::Given(std::string name, GivenData data) : name_(std::move(name)) {
  if (all_given.emplace(name_, std::move(data)).second) return;
  throw Error(fmt::format("{}: expected a name of its own, found one that is in use.", name_));
}

Given::~Given() { all_given.erase(name_); }

const Series* given_series(const std::filesystem::path& path) {
  const GivenData* const data = given(path);
  return data == nullptr ? nullptr : std::get_if<Series>(data);
}

const std::vector<Recording>* given_recordings(const std::filesystem::path& path) {
  const GivenData* const data = given(path);
  return data == nullptr ? nullptr : std::get_if<std::vector<Recording>>(data);
}

}  // namespace ballbar
