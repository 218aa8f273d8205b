// Sentences by name. What a result says is the name of a sentence of formats/messages and the values of its places,
// from which each language makes its text. text_of() makes the English one.
//
// message_catalogue.hpp, which is made of formats/messages/en.toml, has a function for each sentence:
//
//   Paragraph text = messages::remaining_error(size_text(rmse_um));
//   text += messages::noise(size_text(floor_um), messages::standstill("0 min", "60 min"));
//   text_of(text)
#pragma once

#include <concepts>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace ballbar {

struct Message;

// Sentences that stand one after the other, or a phrase within another sentence.
struct Paragraph {
  std::vector<Message> messages;

  // Defined where Message is complete.
  Paragraph();
  Paragraph(const Paragraph& other);
  Paragraph(Paragraph&& other) noexcept;
  Paragraph& operator=(const Paragraph& other);
  Paragraph& operator=(Paragraph&& other) noexcept;
  ~Paragraph();
  Paragraph(Message message);
  Paragraph& operator+=(Paragraph other);
  bool empty() const;
};

// An effect with its columns, "expansion(T_room_degC)", for which languages have names.
struct EffectLabel {
  std::string effect;
  std::string english = {};  // what it is called there; empty: the same
};

// What stands in a place: a number as it is printed, the name of a file or a column, an effect, a phrase.
struct MessageValue {
  std::variant<std::string, EffectLabel, Paragraph> value;

  MessageValue(std::string text) : value(std::move(text)) {}
  MessageValue(std::string_view text) : value(std::string(text)) {}
  MessageValue(const char* text) : value(std::string(text)) {}
  MessageValue(std::integral auto count) : value(std::to_string(count)) {}
  MessageValue(EffectLabel label) : value(std::move(label)) {}
  MessageValue(Message phrase);
  MessageValue(Paragraph phrase) : value(std::move(phrase)) {}
};

struct Message {
  std::string name, english;  // english: with {place} for each value
  std::vector<std::pair<std::string, MessageValue>> values;
};

// In English; the sentences of a paragraph with a space between them.
std::string text_of(const Message& message);
std::string text_of(const Paragraph& paragraph);
std::vector<std::string> texts_of(const std::vector<Paragraph>& paragraphs);

// "A, B and C"; "A, B, C"; "A; B; C": a message enumeration, list or semicolon_list with the places 1, 2, 3 ...
Paragraph enumerated(const std::vector<MessageValue>& parts);
Paragraph listed(const std::vector<MessageValue>& parts);
Paragraph semicolon_list(const std::vector<MessageValue>& parts);
std::vector<MessageValue> effects_of(const std::vector<std::string>& labels);

// What an effect says of itself in English: its summary, cause and so on. Other languages have it as LEVEL_EFFECT_KEY,
// "series_expansion_summary"; all but the summary without the axis, "recording_backlash_remedy". The places {a} and {b}
// of the summary are the axes.
Message effect_text(std::string_view level, std::string_view effect, std::string_view key, std::string english);

// A text that no catalogue has, such as the error of a reader: a message without a name.
Message as_it_is(std::string text);

}  // namespace ballbar
