#include "ballbar/formats/text/given_data.hpp"

#include <map>
#include <utility>

namespace ballbar {
namespace {

thread_local std::map<std::string, std::shared_ptr<const GivenData>> all_given;

const GivenData* given(const std::filesystem::path& path) {
  if (all_given.empty()) return nullptr;
  const auto found = all_given.find(path.string());
  return found == all_given.end() ? nullptr : found->second.get();
}

}  // namespace

Given::Given(std::string name, GivenData data)
    : name_(std::move(name)),
      before_(std::exchange(all_given[name_], std::make_shared<const GivenData>(std::move(data)))) {}

Given::~Given() {
  const auto own = all_given.find(name_);
  before_ ? own->second.swap(before_) : static_cast<void>(all_given.erase(own));
}

const Series* given_series(const std::filesystem::path& path) {
  const GivenData* const data = given(path);
  const auto* const series = data == nullptr ? nullptr : std::get_if<std::shared_ptr<const Series>>(data);
  return series == nullptr ? nullptr : series->get();
}

const std::vector<Recording>* given_recordings(const std::filesystem::path& path) {
  const GivenData* const data = given(path);
  return data == nullptr ? nullptr : std::get_if<std::vector<Recording>>(data);
}

}  // namespace ballbar
