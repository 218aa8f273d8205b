#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "ballbar/error.hpp"
#include "ballbar/model/effect_argument.hpp"
#include "ballbar/nearest_name.hpp"
#include "challenge/challenge_files.hpp"

namespace ballbar {
namespace {

constexpr std::string_view kHeading = "set,verdict,effects";

std::vector<std::string_view> split(std::string_view text, char at, std::size_t most) {
  std::vector<std::string_view> parts;
  while (parts.size() + 1 < most) {
    const std::size_t end = text.find(at);
    if (end == std::string_view::npos) break;
    parts.push_back(text.substr(0, end));
    text.remove_prefix(end + 1);
  }
  parts.push_back(text);
  return parts;
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

// All columns or none: a set's own data are not asked which is meant.
BoundEffect bound_by_hand(std::string_view text) {
  const EffectText option = effect_text(text, Level::series);
  BoundEffect bound{option.effect, {}};
  for (const Input& input : option.effect->inputs) {
    for (const auto& [role, column] : option.columns) {
      if (role == input.role) bound.columns.push_back(column);
    }
  }
  if (!bound.columns.empty() && bound.columns.size() != option.effect->inputs.size()) {
    throw Error(fmt::format("expected all columns of {} or none, found {} of {}.", option.effect->name,
                            bound.columns.size(), option.effect->inputs.size()));
  }
  return bound;
}

BlindVerdict verdict_by_hand(std::string_view verdict, std::string_view effects) {
  BlindVerdict result;
  constexpr Verdict kVerdicts[] = {Verdict::named, Verdict::equivalent, Verdict::unexplained, Verdict::untestable,
                                   Verdict::nothing};
  const auto at =
      std::find_if(std::begin(kVerdicts), std::end(kVerdicts), [&](Verdict one) { return name_of(one) == verdict; });
  if (at == std::end(kVerdicts)) {
    throw Error(
        fmt::format("expected named, equivalent, unexplained, untestable or nothing, found {}.", in_quotes(verdict)));
  }
  result.verdict = *at;
  if (effects.size() > 1 && effects.front() == '"' && effects.back() == '"') {
    effects = trimmed(effects.substr(1, effects.size() - 2));
  }
  const bool has_effects = *at == Verdict::named || *at == Verdict::equivalent;
  if (has_effects == effects.empty()) {
    throw Error(has_effects ? fmt::format("expected effects behind {}, found none.", verdict)
                            : fmt::format("expected no effects behind {}, found {}.", verdict, in_quotes(effects)));
  }
  if (!has_effects) return result;
  std::vector<BoundEffect>& bounds = *at == Verdict::named ? result.named : result.reported;
  for (const std::string_view one : split(effects, ';', effects.size() + 1)) {
    bounds.push_back(bound_by_hand(trimmed(one)));
  }
  return result;
}

}  // namespace

std::vector<BlindVerdict> read_verdicts(std::string_view bytes, std::string_view name,
                                        const std::vector<SealedSet>& sets) {
  if (bytes.starts_with("\xef\xbb\xbf")) bytes.remove_prefix(3);
  std::vector<std::optional<BlindVerdict>> verdicts(sets.size());
  std::size_t number = 0;
  bool has_heading = false;
  const auto fail = [&](const std::string& sentence) { throw Error(fmt::format("{}:{}: {}", name, number, sentence)); };
  for (const std::string_view whole : split(bytes, '\n', bytes.size() + 1)) {
    ++number;
    const std::string_view line = trimmed(whole);
    if (line.empty() || line.front() == '#') continue;
    if (!has_heading) {
      if (line != kHeading) fail(fmt::format("expected the heading {}, found {}.", kHeading, in_quotes(line)));
      has_heading = true;
      continue;
    }
    const std::vector<std::string_view> cells = split(line, ',', 3);
    if (cells.size() < 2) fail(fmt::format("expected set,verdict,effects, found {}.", in_quotes(line)));
    const auto at =
        std::find_if(sets.begin(), sets.end(), [&](const SealedSet& set) { return set.name == trimmed(cells[0]); });
    if (at == sets.end()) {
      fail(fmt::format("expected a set from {} to {}, found {}.", sets.front().name, sets.back().name,
                       in_quotes(trimmed(cells[0]))));
    }
    std::optional<BlindVerdict>& verdict = verdicts[static_cast<std::size_t>(at - sets.begin())];
    if (verdict) fail(fmt::format("expected each set once, found {} again.", at->name));
    try {
      verdict = verdict_by_hand(trimmed(cells[1]), cells.size() > 2 ? trimmed(cells[2]) : std::string_view());
    } catch (const Error& error) {
      fail(error.what());
    }
  }
  std::vector<BlindVerdict> result;
  for (std::size_t i = 0; i < sets.size(); ++i) {
    if (!verdicts[i]) {
      throw Error(fmt::format("{}: expected a verdict for each of {} sets, found none for {}.", name, sets.size(),
                              sets[i].name));
    }
    result.push_back(std::move(*verdicts[i]));
  }
  return result;
}

}  // namespace ballbar
