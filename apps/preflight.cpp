// `ballbar preflight DATA`: what this data could show, before any residual.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "ballbar/identifiability.hpp"
#include "commands.hpp"
#include "model_options.hpp"
#include "text.hpp"

namespace ballbar::commands {
namespace {

struct Options {
  ModelOptions model;
  bool json = false;
};

const char* name_of(Testability testability) {
  switch (testability) {
    case Testability::testable:
      return "testable";
    case Testability::input_missing:
      return "input missing";
    case Testability::input_constant:
      return "input constant";
    case Testability::absorbed:
      return "absorbed by the model";
    case Testability::in_the_model:
      return "in the model";
  }
  return "testable";
}

void print_text(const Preflight& result, const std::string& title) {
  std::size_t testable = 0, apart = 0;
  for (const Prospect& prospect : result.prospects) {
    if (prospect.testability != Testability::testable) continue;
    ++testable;
    if (prospect.inseparable_from.empty()) ++apart;
  }
  fmt::print("{}\n{}, {} values\n\n{} of {} effects could be seen here, {} of them could be told from all others.\n\n",
             title, result.target, result.n, testable, result.prospects.size(), apart);
  Table table({"effect", "columns", "seen from um", "named from um", "not the model's %", "inseparable from"});
  for (const Prospect& prospect : result.prospects) {
    if (prospect.testability != Testability::testable) continue;
    const std::string more = prospect.bindings > 1 ? fmt::format(" (best of {})", prospect.bindings) : "";
    table.add(
        {prospect.effect->name, fmt::format("{}{}", fmt::join(prospect.columns, ", "), more),
         fmt::format("{:.2f}", prospect.detectable_um), fmt::format("{:.2f}", prospect.identifiable_um),
         fmt::format("{:.0f}", 100.0 * prospect.surviving_share),
         prospect.inseparable_from.empty() ? "-" : fmt::format("{}", fmt::join(prospect.inseparable_from, ", "))});
  }
  if (testable > 0) fmt::print("{}\n", table.text());
  for (const Prospect& prospect : result.prospects) {
    if (prospect.testability == Testability::testable) continue;
    fmt::print("{}: not testable, {}.\n", prospect.effect->name, prospect.why);
  }
  fmt::print("\n{}",
             wrapped(fmt::format("um: range (max - min) that the effect would add over these data. Noise from: {}.",
                                 result.noise_source)));
}

nlohmann::ordered_json json_of(const Preflight& result) {
  nlohmann::ordered_json json;
  json["target"] = result.target;
  json["n"] = result.n;
  json["noise_source"] = result.noise_source;
  json["effects"] = nlohmann::ordered_json::array();
  for (const Prospect& prospect : result.prospects) {
    nlohmann::ordered_json row{{"effect", prospect.effect->name},
                               {"testability", name_of(prospect.testability)},
                               {"columns", prospect.columns},
                               {"bindings", prospect.bindings}};
    if (prospect.testability == Testability::testable) {
      row["surviving_share"] = prospect.surviving_share;
      row["detectable_um"] = prospect.detectable_um;
      row["identifiable_um"] = prospect.identifiable_um;
      row["inseparable_from"] = prospect.inseparable_from;
    } else {
      row["why"] = prospect.why;
    }
    json["effects"].push_back(std::move(row));
  }
  return json;
}

void run(const Options& options) {
  const ModelData data = open_data(options.model);
  const Model model = open_model(options.model, data);
  nlohmann::ordered_json targets = nlohmann::ordered_json::array();
  for (std::size_t target = 0; target < model.targets.size(); ++target) {
    const Preflight result = preflight(model, data.series, target);
    if (options.json) {
      targets.push_back(json_of(result));
    } else {
      if (target > 0) fmt::print("\n");
      print_text(result, data.title);
    }
  }
  if (options.json) {
    const nlohmann::ordered_json several{{"targets", targets}};
    fmt::print("{}\n", (targets.size() == 1 ? targets.front() : several).dump(2));
  }
}

}  // namespace

void add_preflight(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("preflight", "What these data could show, before looking at any residual");
  add_model_options(*command, options->model, false);
  command->add_flag("--json", options->json, "the result for a program");
  command->footer("Example:\n  ballbar preflight sample-runs/spindle-46h/measured.csv --target ch3_um");
  command->callback([options] { run(*options); });
}

}  // namespace ballbar::commands
