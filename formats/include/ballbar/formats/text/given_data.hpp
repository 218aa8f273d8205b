// Data that a program holds, in the place of a file: what opens a path takes them where the path is their name.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "ballbar/circle/recording.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

using GivenData = std::variant<std::shared_ptr<const Series>, std::vector<Recording>>;  // recordings: of one test

// In this thread, for as long as it lives, the path `name` is these data, whatever it was before. A name that no file
// has, such as "<data>".
class Given {
 public:
  Given(std::string name, GivenData data);
  Given(const Given&) = delete;
  Given& operator=(const Given&) = delete;
  ~Given();

 private:
  std::string name_;
  std::shared_ptr<const GivenData> before_;  // under that name
};

// What that path is in this thread; nullptr: a file, a folder or nothing.
const Series* given_series(const std::filesystem::path& path);
const std::vector<Recording>* given_recordings(const std::filesystem::path& path);

}  // namespace ballbar
