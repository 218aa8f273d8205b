#include "diagnose/next_command.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <set>
#include <string_view>
#include <vector>

#include "ballbar/diagnosis/signatures/search.hpp"
#include "ballbar/message_catalogue.hpp"
#include "ballbar/model/model.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar {
namespace {

constexpr double kLeastP = 0.5;               // of an effect that is proposed
constexpr std::ptrdiff_t kRowsAboutJump = 3;  // another jump so near is the same

// As `add` takes it; empty where the name of a column holds the comma that parts them.
std::string text_of(const std::string& label, const std::vector<std::string>& columns) {
  const bool has_comma = std::any_of(columns.begin(), columns.end(),
                                     [](const std::string& column) { return column.find(',') != std::string::npos; });
  return has_comma ? "" : label;
}

// The effect on the columns that stand for those which measure the same quantity.
BoundEffect on_one_of_equal(const Diagnosis& found, BoundEffect effect) {
  for (const EqualColumns& one : found.equal_columns)
    std::replace(effect.columns.begin(), effect.columns.end(), one.other, one.column);
  return effect;
}

std::string typed(const std::string& effect) { return effect.empty() ? "" : shell_word(effect); }

// A sinusoid is only found from near its period, a jump from its own row.
std::string start_text(const FittedParameter& parameter, double value) {
  const int digits = parameter.shape_of == ShapeOf::onset ? 8 : parameter.shape_of == ShapeOf::period ? 6 : 4;
  return fmt::format("{}", std::stod(fmt::format("{:.{}g}", value, digits)));  // 17680, not 1.768e+04
}

std::string start_text(const FittedParameter& parameter) { return start_text(parameter, parameter.value); }

// A moment that was found, a period or a time constant, as the sentence of the verdict says it, or an exponent that the
// effect holds elsewhere.
bool is_said(const Effect& effect, const FittedParameter& parameter) {
  if (parameter.shape_of == ShapeOf::onset) return true;
  if (parameter.state == ParameterState::held) {
    const auto known = std::find_if(effect.parameters.begin(), effect.parameters.end(),
                                    [&](const Parameter& one) { return one.name == parameter.name; });
    return known != effect.parameters.end() && known->kind == ParameterKind::shape &&
           start_text(parameter) != start_text(parameter, known->start);
  }
  return parameter.unit == "s" && is_of_curve(parameter.shape_of) && parameter.state == ParameterState::free &&
         std::isfinite(parameter.sigma);
}

// With what was found: "step(onset_s = 33840)", "lagged_expansion(T_room_degC, time_constant_s = 3120)". A fit starts
// there. A model may hold several steps, each by its moment.
std::string text_of(const BoundEffect& bound, const Diagnosis& found) {
  const Candidate* one = candidate_of(found, bound);
  if (one == nullptr) return text_of(label_of(bound), bound.columns);
  std::string label = label_of(bound);
  for (const FittedParameter& parameter : one->parameters) {
    if (!is_said(*bound.effect, parameter)) continue;
    if (label.ends_with(')')) label.back() = ',';
    label += fmt::format("{}{} = {})", label.ends_with(',') ? " " : "(", parameter.name, start_text(parameter));
  }
  return text_of(label, bound.columns);
}

std::string word_of(const BoundEffect& bound, const Diagnosis& found) { return typed(text_of(bound, found)); }

std::string word_of(const Term& term) { return typed(text_of(label_of(term), term.columns)); }

// Empty where one of the effects cannot be typed.
std::string command_of(const std::string& verb, const std::vector<std::string>& effects, const ModelOptions& options,
                       const std::string& target, bool dry_run = false) {
  if (std::find(effects.begin(), effects.end(), "") != effects.end()) return "";
  const auto is_held = [](const Source& one) { return !one.empty() && !one.is_path(); };  // nobody can type it
  if (is_held(options.model) || std::any_of(options.data.begin(), options.data.end(), is_held)) return "";
  std::vector<std::string> words{"ballbar", verb};
  words.insert(words.end(), effects.begin(), effects.end());
  for (const std::string& file : names_of(options.data))
    words.push_back(shell_word(file.starts_with('-') ? "./" + file : file));
  for (const std::string& word : options.data.front().recipe().words) words.push_back(shell_word(word));
  if ((verb == "add" && !dry_run) || !options.model.empty())
    words.insert(words.end(), {"--model", shell_word(model_file(options))});
  words.insert(words.end(), {"--target", shell_word(target)});
  for (const std::string& column : options.also_input) words.insert(words.end(), {"--also-input", shell_word(column)});
  if (options.max_gap_s) words.insert(words.end(), {"--max-gap", fmt::format("{:g}s", *options.max_gap_s)});
  for (const TimeRange& range : options.left_out)
    words.insert(words.end(), {"--leave-out-times", fmt::format("{}s..{}s", range.from_s, range.to_s)});
  if (dry_run) words.emplace_back("--dry-run");
  const std::string command = fmt::format("{}", fmt::join(words, " "));
  return shortened(command, command.size()) == command ? command : "";  // a name that a terminal would obey
}

// Whether each column that the effect reads is a probable driver.
bool reads_drivers(const Diagnosis& found, const BoundEffect& bound) {
  return std::all_of(bound.columns.begin(), bound.columns.end(), [&](const std::string& column) {
    return std::any_of(found.drivers.begin(), found.drivers.end(), [&](const Driver& driver) {
      return driver.column == column && driver.p >= kNamed && driver.is_clear;
    });
  });
}

// The first that is worth a try: of what is in question, else of the most probable set.
std::vector<BoundEffect> worth_a_try(const Diagnosis& found) {
  std::vector<BoundEffect> bounds;
  for (const std::vector<BoundEffect>& group : found.equivalent) {
    if (!group.empty()) bounds.push_back(group.front());
  }
  for (const Candidate& one : found.candidates) {
    if (one.in_best_set) bounds.push_back(one.bound);
  }
  for (const BoundEffect& bound : bounds) {
    const Candidate* one = candidate_of(found, bound);
    const bool is_sure = bound.effect->level == Level::recording || reads_drivers(found, bound);
    if (one != nullptr && is_proposed(*one) && is_sure) return {bound};
  }
  return {};
}

// Whether the model holds a jump within a few rows of this one: another one there would only share its height.
bool is_in_model(const BoundEffect& bound, const Diagnosis& found) {
  const Candidate* one = candidate_of(found, bound);
  const std::vector<double>& time_s = found.base.time_s;
  if (one == nullptr || !bound.columns.empty() || !std::is_sorted(time_s.begin(), time_s.end())) return false;
  const auto row_at = [&](double s) { return std::lower_bound(time_s.begin(), time_s.end(), s) - time_s.begin(); };
  for (const FittedParameter& parameter : one->parameters) {
    if (parameter.shape_of != ShapeOf::onset) continue;
    for (const FittedParameter& held : found.base.parameters) {
      const bool is_same = held.shape_of == ShapeOf::onset && held.name == parameter.name &&
                           (held.effect == bound.effect->name || held.effect.starts_with(bound.effect->name + "("));
      if (is_same && std::abs(row_at(held.value) - row_at(parameter.value)) <= kRowsAboutJump) return true;
    }
  }
  return false;
}

bool is_own_named(const OwnValue& own, const Diagnosis& found) {
  return own.p >= (found.verdict == Verdict::named ? kNamed : kProbable);
}

bool says_a_name(const Diagnosis& found) {
  return found.verdict == Verdict::named || found.verdict == Verdict::probable;
}

// That the next command adds, or tries.
std::vector<BoundEffect> bounds_to_add(const Diagnosis& found) {
  if (found.verdict == Verdict::nothing || found.verdict == Verdict::untestable) return {};
  const std::vector<BoundEffect>& certain = found.verdict == Verdict::named ? found.named : found.probable;
  std::vector<BoundEffect> bounds = says_a_name(found) ? certain : worth_a_try(found);
  std::erase_if(bounds, [&](const BoundEffect& bound) { return is_in_model(bound, found); });
  return bounds;
}

}  // namespace

std::string model_file(const ModelOptions& options) {
  if (!options.model.empty()) return options.model.name();
  std::string name = "model.toml";
  std::error_code absent;  // then the name is free
  for (int number = 2; std::filesystem::exists(name, absent); ++number) name = fmt::format("model-{}.toml", number);
  return name;
}

bool is_proposed(const Candidate& candidate) { return candidate.p >= kLeastP; }

std::string_view name_of(Action action) {
  switch (action) {
    case Action::add:
      return "add";
    case Action::try_out:
      return "try";
    case Action::free:
      return "free";
    case Action::plan:
      break;
  }
  return "plan";
}

std::string next_command(const ModelOptions& options, const Diagnosis& found) {
  const std::vector<BoundEffect> bounds = bounds_to_add(found);
  if (bounds.empty()) return "";
  std::vector<std::string> words;
  words.reserve(bounds.size());
  for (const BoundEffect& bound : bounds) words.push_back(word_of(bound, found));
  return command_of("add", words, options, found.target, !says_a_name(found));
}

std::optional<NextAction> next_action(const ModelOptions& options, const Diagnosis& found) {
  NextAction add{says_a_name(found) ? Action::add : Action::try_out, {}, {}, {}, {}};
  for (const BoundEffect& bound : bounds_to_add(found)) {
    add.effects.push_back(text_of(bound, found));
    add.labels.push_back(label_of(bound));
  }
  const bool can_be_told = std::find(add.effects.begin(), add.effects.end(), "") == add.effects.end();
  if (!add.effects.empty() && can_be_told) return add;
  NextAction free{Action::free, {}, {}, {}, {}};
  for (const OwnValue& own : found.own) {
    if (!says_a_name(found) || !is_own_named(own, found) || options.model.empty()) continue;
    free.parameters.push_back({own.effect, own.parameter, own.fitted});
  }
  if (!free.parameters.empty()) return free;
  if (is_for_plan(found)) return NextAction{};
  return std::nullopt;
}

std::string replace_command(const ModelOptions& options, const Replacement& replacement) {
  std::vector<std::string> words;
  for (const BoundEffect& bound : replacement.without.named) words.push_back(word_of(bound, replacement.without));
  const std::string command = command_of("add", words, options, replacement.without.target);
  return command.empty() ? "" : fmt::format("{} --replace {}", command, shell_word(replacement.label));
}

std::vector<std::vector<std::string>> equal_columns_in_question(const Diagnosis& found) {
  std::vector<std::vector<std::string>> classes;
  for (const EqualColumns& one : found.equal_columns) {
    if (!classes.empty() && classes.back().front() == one.column)
      classes.back().push_back(one.other);
    else
      classes.push_back({one.column, one.other});
  }
  std::erase_if(classes, [&](const std::vector<std::string>& columns) {
    return std::none_of(found.equivalent.begin(), found.equivalent.end(), [&](const std::vector<BoundEffect>& group) {
      std::set<std::string> read;
      for (const BoundEffect& effect : group) read.insert(effect.columns.begin(), effect.columns.end());
      return std::count_if(columns.begin(), columns.end(),
                           [&](const std::string& column) { return read.contains(column); }) > 1;
    });
  });
  return classes;
}

bool is_for_plan(const Diagnosis& found) {
  const auto is_one = [&](const std::vector<BoundEffect>& group) {
    return group.size() > 1 && std::all_of(group.begin(), group.end(), [&](const BoundEffect& effect) {
             return on_one_of_equal(found, effect) == on_one_of_equal(found, group.front());
           });
  };
  if (!found.equivalent.empty() && found.probable.empty() &&
      std::all_of(found.equivalent.begin(), found.equivalent.end(), is_one))
    return false;
  if (found.verdict == Verdict::unexplained && found.equivalent.empty()) return false;  // another sensor decides
  return found.verdict != Verdict::nothing && found.verdict != Verdict::untestable &&
         (found.verdict != Verdict::named || !found.equivalent.empty() || !found.probable.empty());
}

std::string plan_command(const ModelOptions& options, const Diagnosis& found) {
  return command_of("plan", {}, options, found.target);
}

bool is_left(Verdict verdict) {
  return verdict == Verdict::probable || verdict == Verdict::driver || verdict == Verdict::equivalent ||
         verdict == Verdict::unexplained;
}

std::string train_command(const ModelOptions& options, const Diagnosis& found, bool with_model) {
  if (!options.also_input.empty() || !options.left_out.empty()) return "";  // `train` has no such options
  ModelOptions how = options;
  if (!with_model) how.model = {};
  const std::string command = command_of("train", {}, how, found.target);
  const std::string target = found.target.substr(0, found.target.find('_'));
  return command.empty() ? "" : fmt::format("{} --out {}", command, shell_word(target + ".json"));
}

std::string add_command(const ModelOptions& options, const EffectTest& tried) {
  std::vector<std::string> words;
  words.reserve(tried.added.size());
  const std::size_t first = tried.model.terms.size() - tried.added.size();
  for (std::size_t k = first; k < tried.model.terms.size(); ++k) words.push_back(word_of(tried.model.terms[k]));
  return command_of("add", words, options, tried.after.target);
}

Paragraph next_hint(const ModelOptions& options, const Diagnosis& found) {
  Paragraph hint;
  if (!says_a_name(found)) return hint;
  for (const OwnValue& own : found.own) {
    if (!is_own_named(own, found)) continue;
    hint += messages::hint_free(options.model.name(), own.parameter, EffectLabel{own.effect},
                                fmt::format("{} = {{ start = {:.4g} }}", own.parameter, own.fitted));
  }
  return hint;
}

}  // namespace ballbar
