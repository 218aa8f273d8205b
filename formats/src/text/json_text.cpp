#include "text/json_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "ballbar/error.hpp"

namespace ballbar {

std::string json_text(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string json_text(double number) {
  if (std::isfinite(number)) return nlohmann::json(number).dump();
  throw Error(fmt::format("A model file holds finite numbers only: expected one, found {}.", number));
}

std::string json_text(const std::vector<std::string>& texts) {
  std::vector<std::string> quoted;
  quoted.reserve(texts.size());
  for (const std::string& text : texts) quoted.push_back(json_text(text));
  return fmt::format("[{}]", fmt::join(quoted, ", "));
}

std::string json_text(const Eigen::Ref<const Eigen::VectorXd>& numbers) {
  std::vector<std::string> texts;
  texts.reserve(static_cast<std::size_t>(numbers.size()));
  for (const double number : numbers) texts.push_back(json_text(number));
  return fmt::format("[{}]", fmt::join(texts, ", "));
}

}  // namespace ballbar
