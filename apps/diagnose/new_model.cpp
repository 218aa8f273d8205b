#include "diagnose/new_model.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "ballbar/formats/models/model_toml.hpp"

namespace ballbar {

bool is_new_model(const ModelOptions& options) {
  std::error_code error;  // told where it is read
  if (options.model.empty()) return true;
  return options.model.is_path() &&
         std::filesystem::symlink_status(options.model.path(), error).type() == std::filesystem::file_type::not_found;
}

ModelOptions readable(ModelOptions options) {
  if (is_new_model(options)) options.model = {};
  return options;
}

std::string new_model_text(const Model& model) {
  Model start;
  start.level = model.level;
  start.targets = model.targets;
  return fmt::format("# Made by ballbar add: what is below, and {}.\n{}", start_of(model.level), write_model(start));
}

}  // namespace ballbar
