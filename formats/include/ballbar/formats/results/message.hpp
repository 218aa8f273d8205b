// Sentences by name in a result: the English text, and beside it the messages that it is made of.
#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "ballbar/formats/results/schema.hpp"
#include "ballbar/message.hpp"

namespace ballbar {

template <>
inline constexpr auto kResult<EffectLabel> =
    ResultType{"EffectLabel", "An effect within a sentence.",
               std::tuple{Field{"effect", &EffectLabel::effect, "with its columns"}}};

using MessageValues = TableOf<std::variant<std::string, EffectLabel, std::vector<Message>>>;
MessageValues values_of(const Message& message);

template <>
inline constexpr auto kResult<Message> =
    ResultType{"Message", "A sentence by its name, from which each language makes its text.",
               std::tuple{Field{"name", &Message::name, "of formats/messages"},
                          Field{"values", &values_of, "of its places: a text, an effect, or sentences within it"}}};

// A field of sentences has two keys: the English text, and the messages that it is made of where there are any.
// "sentence": "message", "sentences": "messages", "hint": "hint_message".
template <>
struct MessagesOf<Paragraph> {
  using Type = std::vector<Message>;
};
template <>
struct MessagesOf<std::vector<Paragraph>> {
  using Type = std::vector<std::vector<Message>>;
};
template <>
struct SchemaOf<Paragraph> : SchemaOf<std::string> {};
void add_value(nlohmann::ordered_json& json, std::string_view name, const Paragraph& paragraph);
void add_value(nlohmann::ordered_json& json, std::string_view name, const std::vector<Paragraph>& paragraphs);

}  // namespace ballbar
