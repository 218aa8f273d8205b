// `ballbar ledger --model M`: the revisions of a model, one per row.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <string_view>

#include "ballbar/formats/models/model_history.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "ballbar/revision/revision.hpp"
#include "commands.hpp"
#include "diagnose/revision_results.hpp"
#include "terminal/caller.hpp"
#include "terminal/command_line.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar::commands {
namespace {

struct LedgerArguments {
  Source model;
  Catalogue catalogue = built_in_catalogue();
  bool details = false;
  bool json = false;
};

std::string known(double value, int decimals) { return std::isfinite(value) ? fixed(value, decimals) : "-"; }

// A figure of a row that only some ledgers have.
struct Figure {
  std::string_view name;
  double LedgerRow::*value;
  int decimals = 3;
};

Table table_of(const std::vector<LedgerRow>& rows) {
  const bool several =
      std::any_of(rows.begin(), rows.end(), [&](const LedgerRow& row) { return row.target != rows.front().target; });
  std::vector<std::string> heading{"revision"};
  if (several) heading.emplace_back("target");
  const bool of_axes = std::any_of(rows.begin(), rows.end(), is_of_axes);
  // A figure that no row has would only take room from the names of the revisions.
  std::vector<Figure> figures{{"forecast um", &LedgerRow::forecast_um},
                              {of_axes ? "chi^2" : "2 ln B", &LedgerRow::likelihood_ratio, 1},
                              {"threshold", &LedgerRow::threshold, 1}};
  std::erase_if(figures, [&](const Figure& figure) {
    return std::none_of(rows.begin(), rows.end(),
                        [&](const LedgerRow& row) { return std::isfinite(row.*figure.value); });
  });
  heading.insert(heading.end(), {"parameters", "RMSE um", "times noise", "left-out um"});
  for (const Figure& figure : figures) heading.emplace_back(figure.name);
  heading.emplace_back("verdict");
  Table table(heading);
  for (const LedgerRow& row : rows) {
    std::vector<std::string> cells{fmt::format("{} {}", row.revision, one_line(row.change))};
    if (several) cells.push_back(one_line(row.target));
    cells.insert(cells.end(), {fmt::format("{}", row.parameters), fixed(row.rmse_um, 3), known(row.times_floor, 2),
                               known(row.held_out_um, 3)});
    for (const Figure& figure : figures) cells.push_back(known(row.*figure.value, figure.decimals));
    cells.push_back(one_line(row.verdict));
    table.add(std::move(cells));
  }
  return table;
}

void run(const LedgerArguments& options) {
  const std::vector<LedgerRow> rows =
      read_ledger(options.model.bytes(kLargestText), options.model.name(), options.catalogue);
  if (options.json) {
    print_json(json_of(ledger_of(rows)));
    return;
  }
  if (rows.empty()) {
    fmt::print("{} has no ledger yet: `ballbar add` writes its first row.\n", options.model.name());
    return;
  }
  const auto same = [&](const LedgerRow& row) { return row.target == rows.front().target; };
  fmt::print("{}{}\n\n{}\n", options.model.name(),
             std::all_of(rows.begin(), rows.end(), same) ? ", " + shortened(rows.front().target, 40) : "",
             table_of(rows).text(table_width()));
  const std::vector<LedgerEntry> entries = ledger_of(rows).rows;
  const std::size_t first = options.details ? 0 : entries.size() - 1;
  for (std::size_t k = first; k < entries.size(); ++k) fmt::print("{}", wrapped(entries[k].sentence));
  if (first > 0) fmt::print("\n{}", details_text("a sentence on each revision"));
}

}  // namespace

void add_ledger(CLI::App& app) {
  const auto options = std::make_shared<LedgerArguments>();
  CLI::App* command = app.add_subcommand("ledger", "What a model went through: every revision and its error");
  options->catalogue = catalogue_of(*command);
  add_source(*command, "--model", options->model, "model.toml with a ledger")->type_name("FILE")->required();
  add_details(*command, options->details);
  command->add_flag("--json", options->json, "print the result as JSON");
  command->footer(
      "Example, after `ballbar add ... --out model.toml`:\n"
      "  ballbar ledger --model model.toml");
  command->callback([options] { run(*options); });
}

}  // namespace ballbar::commands
