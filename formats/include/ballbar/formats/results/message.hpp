// Sentences by name in a result: the English text, and beside it the messages that it is made of.
#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "ballbar/formats/results/result_type.hpp"
#include "ballbar/message.hpp"

namespace ballbar {

template <>
inline constexpr auto kResult<EffectLabel> = ResultType("EffectLabel", "An effect within a sentence.",
                                                        Field{"effect", &EffectLabel::effect, "with its columns"});

using MessageValues = TableOf<std::variant<std::string, EffectLabel, std::vector<Message>>>;
MessageValues values_of(const Message& message);

template <>
inline constexpr auto kResult<Message> = ResultType("Message",
                                                    "A sentence by its name, from which each language makes its text.",
                                                    Field{"name", &Message::name, "of formats/messages"},
                                                    Field{"values", &values_of,
                                                          "of its places: a text, an effect, or sentences within it"});

// A field of sentences has two keys: the English text, and the messages that it is made of where there are any.
// "sentence": "message", "sentences": "messages", "hint": "hint_message".
std::string message_key(std::string_view name);
template <class Texts, class Messages>
struct KeysOfSentences {
  static void describe(FieldSchema field, std::vector<FieldSchema>& fields, std::vector<ResultSchema>& all) {
    const std::string name = field.name;
    KeyOf<Texts>::describe(std::move(field), fields, all);
    KeyOf<MayLack<Messages>>::describe({message_key(name), "the same by name, for other languages", {}}, fields, all);
  }
};
template <>
struct KeyOf<Paragraph> : KeysOfSentences<std::string, std::vector<Message>> {
  static void add(Json& json, std::string_view name, const Paragraph& paragraph);
};
template <>
struct KeyOf<std::vector<Paragraph>> : KeysOfSentences<std::vector<std::string>, std::vector<std::vector<Message>>> {
  static void add(Json& json, std::string_view name, const std::vector<Paragraph>& paragraphs);
};

}  // namespace ballbar
