#include "ballbar/model/target_columns.hpp"

#include <fmt/format.h>

#include "ballbar/error.hpp"
#include "ballbar/model/model.hpp"
#include "ballbar/nearest_name.hpp"

namespace ballbar {

void expect_explainable(const std::vector<std::string>& targets, const Series& data) {
  for (const std::string& target : targets) {
    if (find_column(data, target) == nullptr || unit_of(target) == "um") continue;
    throw Error(fmt::format("target: expected a column in um, found {}.", in_quotes(target)));
  }
  Model bare;
  bare.targets = targets;
  expect_suits(bare, data);
}

}  // namespace ballbar
