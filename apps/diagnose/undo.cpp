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
#include "terminal/command_line.hpp"
#include "terminal/state_file.hpp"

namespace ballbar::commands {
namespace {

struct UndoArguments {
  Source model;
  Catalogue catalogue = built_in_catalogue();
  bool json = false;
};

void run(const UndoArguments& options) {
  const std::string& name = options.model.name();
  const auto lock = options.model.is_path() ? only_writer(options.model.path(), "ballbar undo") : std::nullopt;
  const std::string bytes = options.model.bytes(kLargestText);
  const std::string before = without_last_revision(bytes, name, options.catalogue);
  const LedgerRow undone = read_ledger(bytes, name, options.catalogue).back();
  const std::size_t revision = undone.revision - 1;
  if (options.model.is_path()) write_bytes(name, before);
  if (options.json) {
    Undone result{name, revision, undone.change, {}};
    if (!options.model.is_path()) result.text = before;
    print_json(json_of(result));
    return;
  }
  fmt::print("{} is {}. Undone: {}\n", name,
             revision == 0 ? "as it started" : fmt::format("at revision {} again", revision), undone.change);
}

}  // namespace

void add_undo(CLI::App& app) {
  const auto options = std::make_shared<UndoArguments>();
  CLI::App* command = app.add_subcommand("undo", "The model as it was before its last revision");
  options->catalogue = catalogue_of(*command);
  add_source(*command, "--model", options->model, "model.toml with a ledger, which is changed")
      ->type_name("FILE")
      ->required();
  command->add_flag("--json", options->json, "print the result as JSON");
  command->footer(
      "Example, after `ballbar add ... --out model.toml`:\n"
      "  ballbar undo --model model.toml");
  command->callback([options] { run(*options); });
}

}  // namespace ballbar::commands
