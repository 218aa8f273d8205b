#include <algorithm>
#include <cstddef>
#include <optional>

#include "ballbar/error.hpp"
#include "ballbar/formats/models/model_toml.hpp"
#include "models/model_text.hpp"
#include "text/located_text.hpp"
#include "text/table_place.hpp"
#include "text/toml_source.hpp"

namespace ballbar {
namespace {

// What is held has no bounds.
bool same(const Setting& left, const Setting& right) {
  if (left.held != right.held || left.start != right.start) return false;
  return left.held || (left.lower == right.lower && left.upper == right.upper);
}

// Offset of a line, counted from 1.
std::size_t offset_of_line(std::string_view text, std::size_t line) {
  std::size_t at = 0;
  for (; line > 1 && at < text.size(); --line) at = std::min(text.find('\n', at), text.size() - 1) + 1;
  return at;
}

// The end of the value behind the equals sign, before blanks and a comment.
std::size_t value_end(std::string_view text, std::size_t at) {
  char quote = 0;
  std::size_t end = at;
  for (; at < text.size() && text[at] != '\n'; ++at) {
    if (quote == 0 && text[at] == '#') break;
    if (quote == 0 && (text[at] == '"' || text[at] == '\'')) {
      quote = text[at];
    } else if (text[at] == quote) {
      quote = 0;
    }
    if (text[at] != ' ' && text[at] != '\t' && text[at] != '\r') end = at + 1;
  }
  return end;
}

// The text with a value under a key of an effect's table: where it stands, or on a line behind the last key.
std::string with_value(std::string_view text, const TomlTable& table, const std::string& key,
                       const std::string& value) {
  std::size_t last = table.table->source().begin.line;
  for (const auto& [known, node] : *table.table) {
    last = std::max<std::size_t>(last, node.source().end.line);
    if (known.str() != key) continue;
    const std::size_t line = offset_of_line(text, known.source().begin.line);
    const std::size_t equals = text.find('=', line);
    const std::size_t end = value_end(text, equals + 1);
    return std::string(text.substr(0, equals + 1)) + ' ' + value + std::string(text.substr(end));
  }
  const std::size_t at = offset_of_line(text, last + 1);
  std::string result(text.substr(0, at));
  if (!result.ends_with('\n')) result += '\n';
  return result.append(toml_key(key) + " = " + value + '\n').append(text.substr(at));
}

// A parameter in words that read back to the setting.
std::string value_text(const Term& term, std::size_t parameter) {
  const Setting& setting = term.settings[parameter];
  const bool own = term.effect->name == "expression";
  const std::string text = setting_text(setting, term.effect->parameters[parameter], own);
  if (!text.empty()) return text;
  return setting.held ? toml_number(setting.start) : "{}";
}

struct Place {
  std::size_t term = 0, parameter = 0;
};

// Of the first setting that is another, from `from` on.
std::optional<Place> first_other(const Model& model, std::span<const Term> terms, Place from) {
  for (std::size_t t = from.term; t < terms.size(); ++t) {
    const std::size_t first = t == from.term ? from.parameter : 0;
    for (std::size_t k = first; k < terms[t].settings.size(); ++k) {
      if (!same(model.terms[t].settings[k], terms[t].settings[k])) return Place{t, k};
    }
  }
  return std::nullopt;
}

// The text with the whole table of an effect written anew, as where its parameters have tables of their own.
std::string with_table(std::string_view text, std::span<const TomlTable> effects, const TomlTable& root,
                       std::size_t number, const Term& term) {
  const std::size_t begin = line_start(text, effects[number]);
  const std::vector<TomlTable> history = subtables(root, "history");
  const std::size_t end = number + 1 < effects.size() ? start_with_comments(text, effects[number + 1])
                          : !history.empty()          ? start_with_comments(text, history[0])
                                                      : text.size();
  const std::string blank = end < text.size() ? "\n" : "";
  return std::string(text.substr(0, begin)) + effect_text(term) + blank + std::string(text.substr(end));
}

// With one effect's parameter as it is in `terms`.
std::string with_setting(const std::string& text, std::string_view name, std::span<const Term> terms, Place place,
                         const Catalogue& catalogue) {
  const TomlSource source = parse_toml(text, name);
  const TomlTable root = root_of(source);
  const std::vector<TomlTable> effects = subtables(root, "effect");
  if (!has_header(text, effects[place.term])) {
    fail_at_table(effects[place.term], "expected effects as tables [[effect]], found an array.");
  }
  const Term& term = terms[place.term];
  const std::string& key = term.effect->parameters[place.parameter].name;
  const std::string changed = with_value(text, effects[place.term], key, value_text(term, place.parameter));
  try {
    const Model model = read_model(changed, name, catalogue);
    if (same(model.terms.at(place.term).settings.at(place.parameter), term.settings[place.parameter])) return changed;
  } catch (const Error&) {  // a value that has no line of its own
  }
  return with_table(text, effects, root, place.term, term);
}

}  // namespace

std::string with_settings(std::string_view bytes, std::string_view name, std::span<const Term> terms,
                          const Catalogue& catalogue) {
  const SourceText source = source_text(bytes, name);
  std::string text(source.bytes);
  Place place;
  while (const auto other = first_other(read_model(text, name, catalogue), terms, place)) {
    text = with_setting(text, name, terms, *other, catalogue);
    place = {other->term, other->parameter + 1};
  }
  return std::string(bytes.substr(0, bytes.size() - source.bytes.size())) + text;
}

}  // namespace ballbar
