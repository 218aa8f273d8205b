#include "ballbar/formats/models/prediction_state.hpp"

#include <nlohmann/json.hpp>

#include "models/live_state_json.hpp"

namespace ballbar {
namespace {

constexpr std::string_view kPredictionFormat = "ballbar-prediction 1";

}  // namespace

std::string write_prediction_state(const StoredPrediction& stored) {
  const nlohmann::ordered_json json{{"format", kPredictionFormat},
                                    {"model", stored.model},
                                    {"since_end", stored.since_end},
                                    {"live", json_of(stored.live)}};
  return json.dump(1, ' ', true, nlohmann::ordered_json::error_handler_t::replace) + '\n';
}

StoredPrediction read_prediction_state(std::string_view bytes, std::string_view name) {
  const JsonSource source = parse_json(bytes, name);
  const JsonValue root = root_of(source);
  expect_keys(root, {"format", "model", "since_end", "live"});
  choice_index(member(root, "format"), {kPredictionFormat});
  const JsonValue since_end = member(root, "since_end");
  if (!since_end.value->is_boolean()) fail(since_end, "true or false");
  return {text(member(root, "model")), since_end.value->get<bool>(), live_state_at(member(root, "live"))};
}

}  // namespace ballbar
