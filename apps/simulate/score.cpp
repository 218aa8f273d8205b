// `ballbar simulate score`: what diagnoses find in sets in which effects may be hidden.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "model/model_options.hpp"
#include "simulate/hidden_sets.hpp"
#include "terminal/caller.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar::commands {
namespace {

namespace fs = std::filesystem;

struct ScoreOptions {
  std::string folder;
  bool details = false;
  bool json = false;
};

BlindVerdict diagnosis_verdict(const fs::path& folder) {
  ModelOptions options;
  options.data = {(folder / "data.csv").string()};
  options.model = (folder / "model.toml").string();
  const ModelData data = open_data(options);
  return verdict_of(diagnose(open_model(options, data), *data.series));
}

std::string labels(const std::vector<BoundEffect>& bounds, std::string_view between) {
  std::vector<std::string> texts;
  texts.reserve(bounds.size());
  for (const BoundEffect& bound : bounds) {
    texts.push_back(bound.columns.empty() ? bound.effect->name : label_of(bound));
  }
  return fmt::format("{}", fmt::join(texts, between));
}

std::string effects_text(const BlindVerdict& verdict) {
  std::string text = labels(verdict.named, " and ");
  if (!verdict.reported.empty()) text += (text.empty() ? "" : "; ") + labels(verdict.reported, " or ");
  return text.empty() ? "-" : text;
}

std::string d_text(const BlindAnswer& answer) {
  std::vector<std::string> texts;
  for (const double d : answer.d) texts.push_back(fmt::format("{:.0f}", d));
  return texts.empty() ? "-" : fmt::format("{}", fmt::join(texts, ", "));
}

void print_share(Table& table, const std::string& what, const Share& share) {
  if (share.of == 0) {
    table.add({what, "no set", "-", "-"});
    return;
  }
  table.add({what, fmt::format("{} of {}", share.count, share.of),
             fmt::format("{:.0f} %", 100.0 * static_cast<double>(share.count) / static_cast<double>(share.of)),
             fmt::format("{:.0f} to {:.0f} %", 100.0 * share.low, 100.0 * share.high)});
}

void print_text(const ScoredSets& scored, bool details) {
  constexpr std::size_t kRows = 20;
  Table table({"set", "kind", "truth", "d", "verdict", "effects reported", "outcome"});
  for (const ScoredSet& set : scored.sets) {
    table.add({set.name, std::string(name_of(set.answer.kind)), one_line(set.answer.what), d_text(set.answer),
               std::string(name_of(set.verdict.verdict)), one_line(effects_text(set.verdict)),
               std::string(name_of(set.outcome))});
  }
  if (!details) table.shorten(kRows);
  fmt::print("{} set{}; verdicts by ballbar diagnose\n\n{}\n", scored.sets.size(), scored.sets.size() == 1 ? "" : "s",
             table.left_aligned(table_width(150)));
  Table totals({"", "sets", "share", "95 % interval"});
  print_share(totals, "effect reported, but none hidden", scored.scores.false_calls);
  print_share(totals, "right", scored.scores.right);
  print_share(totals, "wrong", scored.scores.wrong);
  print_share(totals, "true effect named or in the reported set", scored.scores.in_set);
  print_share(totals, "effect named, but true one not in the catalogue", scored.scores.false_names);
  fmt::print("{}\n", totals.text());
  fmt::print(
      "{}",
      wrapped("Right: every hidden effect is named and nothing else is reported. Without a hidden effect: nothing "
              "found. With an effect outside the catalogue: unexplained. With inseparable effects: the true one is in "
              "the set and none is named. Wrong: another effect is named, or something is found where nothing is "
              "hidden. d: square root of the decrease of chi^2 with the hidden signal. Intervals: Wilson."));
}

void score(const ScoreOptions& options) {
  ScoredSets scored{read_answers(options.folder), {}};
  std::vector<BlindAnswer> answers;
  std::vector<BlindOutcome> outcomes;
  for (ScoredSet& set : scored.sets) {
    set.verdict = diagnosis_verdict(fs::path(options.folder) / set.name);
    set.outcome = outcome_of(set.answer, set.verdict);
    answers.push_back(set.answer);
    outcomes.push_back(set.outcome);
    show_sets("diagnosed set", answers.size(), scored.sets.size());
  }
  scored.scores = scores_of(answers, outcomes);
  options.json ? print_json(json_of(scored)) : print_text(scored, options.details);
}

}  // namespace

void add_score(CLI::App& simulate) {
  const auto options = std::make_shared<ScoreOptions>();
  CLI::App* command = simulate.add_subcommand("score", "Compare diagnoses of sets of --hidden with their answers");
  command->add_option("DIR", options->folder, "folder that simulate --hidden wrote")->required()->type_name("");
  add_details(*command, options->details);
  command->add_flag("--json", options->json, "print the result as JSON");
  command->footer(
      "Example:\n"
      "  ballbar simulate --hidden --n 20 --out hidden\n"
      "  ballbar simulate score hidden");
  command->callback([options] { score(*options); });
}

}  // namespace ballbar::commands
