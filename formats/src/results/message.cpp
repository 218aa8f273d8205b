#include "ballbar/formats/results/message.hpp"

#include <algorithm>

namespace ballbar {
namespace {

bool is_named(const Paragraph& paragraph) {
  return std::any_of(paragraph.messages.begin(), paragraph.messages.end(),
                     [](const Message& message) { return !message.name.empty(); });
}

}  // namespace

MessageValues values_of(const Message& message) {
  MessageValues values;
  for (const auto& [name, of] : message.values) {
    if (const auto* const phrase = std::get_if<Paragraph>(&of.value)) {
      values.emplace_back(name, phrase->messages);
    } else if (const auto* const label = std::get_if<EffectLabel>(&of.value)) {
      values.emplace_back(name, *label);
    } else {
      values.emplace_back(name, std::get<std::string>(of.value));
    }
  }
  return values;
}

std::string message_key(std::string_view name) {
  constexpr std::string_view kSentence = "sentence";
  return name.starts_with(kSentence) ? "message" + std::string(name.substr(kSentence.size()))
                                     : std::string(name) + "_message";
}

void KeyOf<Paragraph>::add(Json& json, std::string_view name, const Paragraph& paragraph) {
  json[std::string(name)] = text_of(paragraph);
  if (is_named(paragraph)) json[message_key(name)] = json_value(paragraph.messages);
}

void KeyOf<std::vector<Paragraph>>::add(Json& json, std::string_view name, const std::vector<Paragraph>& paragraphs) {
  json[std::string(name)] = json_value(texts_of(paragraphs));
  if (std::none_of(paragraphs.begin(), paragraphs.end(), is_named)) return;
  Json& messages = json[message_key(name)] = Json::array();
  for (const Paragraph& paragraph : paragraphs) messages.push_back(json_value(paragraph.messages));
}

}  // namespace ballbar
