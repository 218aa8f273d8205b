#include "diagnose/next_command.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <vector>

#include "ballbar/diagnosis/thresholds.hpp"
#include "ballbar/model/bound_effect.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar {
namespace {

std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) {
    if (c == '\'') {
      result += "'\\''";
    } else {
      result += c;
    }
  }
  return result + "'";
}

// As `add` and `try` take it, in quotes; empty where the name of a column holds the comma that parts them.
std::string word_of(const BoundEffect& bound) {
  for (const std::string& column : bound.columns) {
    if (column.find(',') != std::string::npos) return "";
  }
  return shell_word(label_of(bound));
}

// The first that is worth a try: of what is in question, else of what is most probable.
std::vector<BoundEffect> worth_a_try(const Diagnosis& found) {
  if (!found.equivalent.empty() && !found.equivalent.front().empty()) return {found.equivalent.front().front()};
  if (!found.candidates.empty()) return {found.candidates.front().bound};
  return {};
}

bool is_own_named(const OwnValue& own, const Diagnosis& found) {
  return own.p >= (found.verdict == Verdict::named ? kNamed : kProbable);
}

bool says_a_name(const Diagnosis& found) {
  return found.verdict == Verdict::named || found.verdict == Verdict::probable;
}

}  // namespace

std::string shell_word(const std::string& text) {
  const auto is_plain = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
           std::string_view("_-./=:,+@%").find(c) != std::string::npos;
  };
  return !text.empty() && std::all_of(text.begin(), text.end(), is_plain) ? text : quoted(text);
}

std::string next_command(const ModelOptions& options, const Diagnosis& found) {
  if (options.model.empty() || found.verdict == Verdict::nothing || found.verdict == Verdict::untestable) return "";
  const std::vector<BoundEffect>& certain = found.verdict == Verdict::named ? found.named : found.probable;
  const std::vector<BoundEffect> bounds = says_a_name(found) ? certain : worth_a_try(found);
  if (bounds.empty()) return "";
  std::vector<std::string> words{"ballbar", says_a_name(found) ? "add" : "try"};
  for (const BoundEffect& bound : bounds) {
    words.push_back(word_of(bound));
    if (words.back().empty()) return "";
  }
  for (const std::string& file : options.data) words.push_back(shell_word(file.starts_with('-') ? "./" + file : file));
  words.insert(words.end(), {"--model", shell_word(options.model), "--target", shell_word(found.target)});
  for (const std::string& column : options.also_input) words.insert(words.end(), {"--also-input", shell_word(column)});
  if (options.max_gap_s) words.insert(words.end(), {"--max-gap", fmt::format("{:g}s", *options.max_gap_s)});
  const std::string command = fmt::format("{}", fmt::join(words, " "));
  return shortened(command, command.size()) == command ? command : "";  // a name that a terminal would obey
}

std::string next_hint(const ModelOptions& options, const Diagnosis& found) {
  if (found.verdict == Verdict::nothing || found.verdict == Verdict::untestable) return "";
  if (options.model.empty()) {
    const bool is_recording =
        !found.candidates.empty() && found.candidates.front().bound.effect->level == Level::recording;
    return fmt::format("To go on, write a model file, {}target = \"{}\", and give it with --model.",
                       is_recording ? "level = \"recording\", " : "", found.target);
  }
  if (!says_a_name(found)) return "";
  std::string text;
  for (const OwnValue& own : found.own) {
    if (!is_own_named(own, found)) continue;
    text += fmt::format("{}In {}, free the {} of {}: {} = {{ start = {:.3g} }}.", text.empty() ? "" : " ",
                        options.model, own.parameter, own.effect, own.parameter, own.fitted);
  }
  return text;
}

}  // namespace ballbar
