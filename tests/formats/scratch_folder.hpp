// An empty folder of a test's own, removed with it.
#pragma once

#include <filesystem>
#include <string_view>

namespace ballbar {

class ScratchFolder {
 public:
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path write(std::string_view name, std::string_view bytes) const;  // makes its folders too

 private:
  std::filesystem::path path_;
};

// What `action` says when it throws Error, with the scratch folder's name replaced by "DIR".
template <class Action>
std::string complaint(const ScratchFolder& folder, Action action);

}  // namespace ballbar

#include "ballbar/error.hpp"

template <class Action>
std::string ballbar::complaint(const ScratchFolder& folder, Action action) {
  try {
    action();
  } catch (const Error& error) {
    std::string message = error.what();
    const std::string name = folder.path().string();
    for (std::size_t at = message.find(name); at != std::string::npos; at = message.find(name)) {
      message.replace(at, name.size(), "DIR");
    }
    return message;
  }
  return "no complaint";
}
