// `ballbar undo --model M`: the revision before the last.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "ballbar/formats/models/model_history.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "commands.hpp"
#include "diagnose/revision_results.hpp"
#include "terminal/caller.hpp"

namespace ballbar::commands {
namespace {

struct UndoArguments {
  std::string model;
  bool json = false;
};

void run(const UndoArguments& options) {
  const std::string bytes = read_bytes(options.model, kLargestText);
  const std::string before = without_last_revision(bytes, options.model);
  const LedgerRow undone = read_ledger(bytes, options.model).back();
  const std::size_t revision = undone.revision - 1;
  write_bytes(options.model, before);
  if (options.json) {
    print_json(json_of(Undone{options.model, revision, undone.change}));
    return;
  }
  fmt::print("{} is {}; taken back: {}\n", options.model,
             revision == 0 ? "as it started" : fmt::format("at revision {} again", revision), undone.change);
}

}  // namespace

void add_undo(CLI::App& app) {
  const auto options = std::make_shared<UndoArguments>();
  CLI::App* command = app.add_subcommand("undo", "The model as it was before its last revision");
  command->add_option("--model", options->model, "model.toml with a ledger, which is changed")
      ->type_name("FILE")
      ->required();
  command->add_flag("--json", options->json, "the result for a program");
  command->footer(
      "Example, after `ballbar add ... --out model.toml`:\n"
      "  ballbar undo --model model.toml");
  command->callback([options] { run(*options); });
}

}  // namespace ballbar::commands
