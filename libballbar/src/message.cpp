#include "ballbar/message.hpp"

#include <algorithm>
#include <array>
#include <iterator>

#include "ballbar/message_catalogue.hpp"

namespace ballbar {
namespace {

std::string text_of(const MessageValue& value) {
  if (const auto* const text = std::get_if<std::string>(&value.value)) return *text;
  if (const auto* const label = std::get_if<EffectLabel>(&value.value))
    return label->english.empty() ? label->effect : label->english;
  return text_of(std::get<Paragraph>(value.value));
}

// Of "n:word|words" the one that suits the number.
std::string_view word_of(std::string_view words, bool is_one) {
  const std::size_t bar = words.find('|');
  return is_one ? words.substr(0, bar) : words.substr(bar + 1);
}

// Parts of a list, each joined to those before it.
struct List {
  std::string_view name;
  Message (*next)(MessageValue, MessageValue);
  Message (*last)(MessageValue, MessageValue);
};
constexpr std::array kLists{List{"enumeration", messages::list_next, messages::list_last},
                            List{"list", messages::list_next, messages::list_next},
                            List{"semicolon_list", messages::list_semicolon, messages::list_semicolon}};

std::string text_of(const List& list, const Message& message) {
  std::string text;
  for (std::size_t k = 0; k < message.values.size(); ++k) {
    std::string part = text_of(message.values[k].second);
    const auto join = k + 1 == message.values.size() ? list.last : list.next;
    text = k == 0 ? std::move(part) : ballbar::text_of(join(std::move(text), std::move(part)));
  }
  return text;
}

Paragraph list_of(std::string_view name, const std::vector<MessageValue>& parts) {
  if (parts.empty()) return {};
  Message list{std::string(name), "", {}};
  for (const MessageValue& part : parts) list.values.emplace_back(std::to_string(list.values.size() + 1), part);
  return list;
}

}  // namespace

Paragraph::Paragraph() = default;
Paragraph::Paragraph(const Paragraph& other) = default;
Paragraph::Paragraph(Paragraph&& other) noexcept = default;
Paragraph& Paragraph::operator=(const Paragraph& other) = default;
Paragraph& Paragraph::operator=(Paragraph&& other) noexcept = default;
Paragraph::~Paragraph() = default;
bool Paragraph::empty() const { return messages.empty(); }

Paragraph::Paragraph(Message message) { messages.push_back(std::move(message)); }

Paragraph& Paragraph::operator+=(Paragraph other) {
  std::move(other.messages.begin(), other.messages.end(), std::back_inserter(messages));
  return *this;
}

MessageValue::MessageValue(Message phrase) : value(Paragraph(std::move(phrase))) {}

std::string text_of(const Message& message) {
  for (const List& list : kLists) {
    if (list.name == message.name) return text_of(list, message);
  }
  std::string text;
  std::string_view rest = message.english;
  while (!rest.empty()) {
    const std::size_t begin = rest.find('{');
    text += rest.substr(0, begin);
    if (begin == std::string_view::npos) break;
    const std::size_t end = rest.find('}', begin), colon = std::min(rest.find(':', begin), end);
    const std::string_view name = rest.substr(begin + 1, colon - begin - 1);
    const auto place =
        std::find_if(message.values.begin(), message.values.end(), [&](const auto& one) { return one.first == name; });
    if (place != message.values.end()) {
      const std::string value = text_of(place->second);
      text += colon == end ? value : word_of(rest.substr(colon + 1, end - colon - 1), value == "1");
    }
    rest.remove_prefix(end + 1);
  }
  return text;
}

std::string text_of(const Paragraph& paragraph) {
  std::string text;
  for (const Message& message : paragraph.messages) text += (text.empty() ? "" : " ") + text_of(message);
  return text;
}

std::vector<std::string> texts_of(const std::vector<Paragraph>& paragraphs) {
  std::vector<std::string> texts;
  texts.reserve(paragraphs.size());
  for (const Paragraph& paragraph : paragraphs) texts.push_back(text_of(paragraph));
  return texts;
}

Paragraph enumerated(const std::vector<MessageValue>& parts) { return list_of("enumeration", parts); }
Paragraph listed(const std::vector<MessageValue>& parts) { return list_of("list", parts); }
Paragraph semicolon_list(const std::vector<MessageValue>& parts) { return list_of("semicolon_list", parts); }

std::vector<MessageValue> effects_of(const std::vector<std::string>& labels) {
  std::vector<MessageValue> effects;
  effects.reserve(labels.size());
  for (const std::string& label : labels) effects.emplace_back(EffectLabel{label});
  return effects;
}

Message effect_text(std::string_view level, std::string_view effect, std::string_view key, std::string english) {
  const bool is_summary = key == "summary";
  if (!is_summary && (effect.ends_with("_a") || effect.ends_with("_b"))) effect.remove_suffix(2);
  Message message{std::string(level), std::move(english), {}};
  message.name.append("_").append(effect).append("_").append(key);
  if (is_summary) message.values = {{"a", "A"}, {"b", "B"}};
  return message;
}

Message as_it_is(std::string text) { return {"", "{text}", {{"text", std::move(text)}}}; }

}  // namespace ballbar
