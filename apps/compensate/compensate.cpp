// `ballbar compensate`: offsets for the axes of a machine from a model and what its sensors say.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "ballbar/error.hpp"
#include "ballbar/formats/models/model_toml.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "ballbar/nearest_name.hpp"
#include "commands.hpp"
#include "compensate/compensate_live.hpp"
#include "compensate/compensate_replay.hpp"
#include "compensate/compensation_options.hpp"
#include "terminal/output_guard.hpp"

namespace ballbar::commands {
namespace {

struct Options {
  CompensationOptions compensation;
  LiveOptions live;
  ReplayOptions replay;
  std::string save;
  std::string format = "csv";
};

OffsetFormat format_of(const std::string& name) {
  if (name == "csv") return OffsetFormat::csv;
  if (name == "jsonl") return OffsetFormat::jsonl;
  if (name == "word") return OffsetFormat::word;
  throw Error(fmt::format("--format: expected csv, jsonl or word, found {}.", in_quotes(name)));
}

// The model as it runs: every value held, the ranges it was trained on.
void save(const Options& options) {
  const std::vector<CompensatedAxis> axes = axes_of(options.compensation);
  if (axes.size() != 1) {
    throw Error(fmt::format("--save: expected a model of one target, found {}: save each of its own.", axes.size()));
  }
  if (options.compensation.fit.empty()) {
    throw Error("--save: expected --fit DATA with it: the file takes what is fitted to them and their ranges.");
  }
  std::vector<std::filesystem::path> inputs(options.compensation.fit.begin(), options.compensation.fit.end());
  inputs.insert(inputs.end(), options.compensation.models.begin(), options.compensation.models.end());
  expect_no_input({options.save}, inputs);
  write_bytes(options.save, write_model(axes.front().model));
  fmt::print(stderr, "wrote {}\n", options.save);
}

void run(const Options& options) {
  const bool live = !options.live.signals.empty(), replay = !options.replay.data.empty();
  if (live && replay) throw Error("expected --signals or --replay, found both.");
  if (!live && !replay && options.save.empty()) {
    throw Error("expected --signals FILE to run, --replay DATA to try it on recorded data, or --fit DATA --save FILE.");
  }
  if (!replay && (options.replay.json || !options.replay.out.empty())) {
    throw Error(
        "expected --replay with --json and --out; rows of --signals go to the standard output, --format says "
        "how.");
  }
  if (!live && !options.compensation.state.empty()) throw Error("--state: expected --signals with it.");
  if (!live && options.live.follow) throw Error("--follow: expected --signals with it.");
  if (!options.save.empty()) save(options);
  LiveOptions how = options.live;
  how.format = format_of(options.format);
  if (live) compensate_live(options.compensation, how);
  if (replay) compensate_replay(options.compensation, options.replay);
}

}  // namespace

void add_compensate(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("compensate", "Offsets for a machine's axes, row by row, from its sensors");
  add_compensation_options(*command, options->compensation);
  command->add_option("--signals", options->live.signals, "series .csv as it grows, or - for the standard input")
      ->type_name("FILE");
  command->add_flag("--follow", options->live.follow, "wait for rows that are still to be written to the file");
  command->add_option("--format", options->format, "csv, jsonl, or word: 16 bits for a PLC; default: csv")
      ->type_name("FORMAT");
  command->add_option("--replay", options->replay.data, "session or series: what its error would have been")
      ->type_name("DATA");
  command->add_option("--out", options->replay.out, "with --replay: before, after and offset, .csv")
      ->type_name("FILE")
      ->allow_extra_args(false);
  command->add_flag("--json", options->replay.json, "with --replay: the result for a program");
  command->add_option("--save", options->save, "the fitted model, ready to run")->type_name("FILE");
  command->footer(
      "Example:\n"
      "  ballbar compensate --model sample-runs/spindle-rotation-huang2022/mean-point.toml --to z \\\n"
      "    --replay sample-runs/spindle-rotation-huang2022");
  command->callback([options] { run(*options); });
}

}  // namespace ballbar::commands
