// Data that a program holds, in the place of a file: what opens a path takes them where the path is their name.
#pragma once

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "ballbar/circle/recording.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

using GivenData = std::variant<Series, std::vector<Recording>>;  // recordings: of one test

// In this thread, for as long as it lives, the path `name` is these data. A name that no file has, such as "<data>".
class Given {
 public:
  Given(std::string name, GivenData data);
  Given(const Given&) = delete;
  Given& operator=(const Given&) = delete;
  ~Given();

 private:
  std::string name_;
};

// What that path is in this thread; nullptr: a file, a folder or nothing.
const Series* given_series(const std::filesystem::path& path);
const std::vector<Recording>* given_recordings(const std::filesystem::path& path);

}  // namespace ballbar
