// `ballbar compensate`: offsets for the axes of a machine from a model and what its sensors say; with --from-picture
// where one sensor should sit.
#include "compensate/compensate.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "ballbar/error.hpp"
#include "ballbar/formats/models/model_toml.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "ballbar/internal/nearest_name.hpp"
#include "commands.hpp"
#include "shaft_picture/shaft_picture.hpp"
#include "terminal/command_line.hpp"
#include "terminal/log_options.hpp"
#include "terminal/option_checks.hpp"
#include "terminal/stderr_line.hpp"

namespace ballbar::commands {
namespace {

constexpr const char* kPlaceGroup = "Sensor position, from pictures or a table";

struct CompensateArguments {
  CompensationOptions compensation;
  LiveOptions live;
  ReplayOptions replay;
  WriteOptions write;
  std::vector<std::string> out;  // of these the series, .csv, are the replay's, and those of controls of --write
  std::string save;              // and the model is this one, .toml
  bool json = false;
  ShaftPictureArguments place;
};

// The model as it runs: every value held, the ranges it was trained on.
void save(const CompensateArguments& options) {
  const std::vector<CompensatedAxis> axes = axes_of(options.compensation);
  if (axes.size() != 1) {
    throw Error(fmt::format("--out {}: expected a model of one target, found {}. Save each in its own file.",
                            options.save, axes.size()));
  }
  std::vector<std::filesystem::path> inputs = paths_of(options.compensation.fit);
  const std::vector<std::filesystem::path> models = paths_of(options.compensation.models);
  inputs.insert(inputs.end(), models.begin(), models.end());
  expect_no_input({options.save}, inputs);
  write_bytes(options.save, write_model(axes.front().model));
  wrote_line(options.save);
}

// The files of --out, each for what writes its kind.
CompensateArguments sorted_out(CompensateArguments options) {
  for (const std::string& path : options.out) {
    if (path.ends_with(".csv")) {
      options.replay.out.push_back(path);
    } else if (!path.ends_with(".toml")) {
      options.write.out.push_back(path);
    } else if (options.save.empty()) {
      options.save = path;
    } else {
      throw CLI::ValidationError(
          fmt::format("--out: expected one model to write, found {} and {}", options.save, path));
    }
  }
  options.replay.json = options.write.json = options.json;
  options.write.data = options.replay.data;
  if (options.json) options.live.format = OffsetFormat::jsonl;
  return options;
}

void expect_fitting(const CompensateArguments& options) {
  const bool live = !options.live.signals.empty(), replay = !options.replay.data.empty();
  const auto expect = [](bool fits, const char* sentence) {
    if (!fits) throw CLI::ValidationError(sentence);
  };
  expect(!live || !replay, "expected --signals or --on, found both");
  const bool write = !options.write.control.empty();
  expect(!write || replay, "--write: expected --on DATA, on which the line is fitted to the model");
  expect(write || options.write.out.empty(), "--out: expected --write for a file of a control");
  expect(!write || options.replay.out.empty(), "--out: expected no .csv with --write");
  expect(write || !options.write.reversed, "--reversed-sign: expected --write");
  expect(live || replay || !options.save.empty(),
         "expected --signals FILE to run, --on DATA to try it on recorded data, or --fit DATA --out MODEL.toml");
  expect(live || replay || !options.json, "--json: expected --signals or --on");
  expect(
      replay || options.replay.out.empty(),
      "--out: expected --on for a .csv. The rows of --signals go to the standard output; --format sets their format");
  expect(options.save.empty() || !options.compensation.fit.empty(),
         "--out: expected --fit DATA for a model. The file holds the fitted parameters and the ranges of DATA");
  expect(live || options.compensation.state.empty(), "--state: expected --signals");
  const CompensationLimits& limits = options.compensation.limits;
  expect(limits.step_um >= limits.resolution_um, "--step-um: expected at least --resolution-um");
  expect(limits.largest_um >= limits.resolution_um, "--largest-um: expected at least --resolution-um");
  expect(live || !options.live.follow, "--follow: expected --signals");
}

// The place of a sensor: no model, and of --out a table.
void run_place(CompensateArguments options, const CLI::App& command) {
  for (const CLI::Option* option : command.get_options()) {
    const std::string name = option->get_name();
    if (option->count() == 0 || option->get_group() == kPlaceGroup || name == "--out" || name == "--json") continue;
    throw CLI::ValidationError(fmt::format("{}: cannot be combined with --from-picture", name));
  }
  if (options.out.size() > 1 || (options.out.size() == 1 && !options.out.front().ends_with(".csv"))) {
    throw CLI::ValidationError(
        fmt::format("--out: expected one name that ends in .csv with --from-picture, found {}", options.out.back()));
  }
  if (!options.out.empty()) options.place.out = options.out.front();
  options.place.json = options.json;
  show_shaft_picture(options.place);
}

void run(const CompensateArguments& given, CLI::App& command) {
  if (!given.place.of.files.empty()) return run_place(given, command);
  const auto is_of_place = [](const CLI::Option* option) { return option->get_group() == kPlaceGroup; };
  expect_none_given(command.get_options(is_of_place), "--from-picture");
  if (given.compensation.models.empty()) throw CLI::RequiredError("--model");
  const CompensateArguments options = sorted_out(given);
  expect_fitting(options);
  const bool live = !options.live.signals.empty(), replay = !options.replay.data.empty();
  if (!options.save.empty()) save(options);
  if (live) compensate_live(options.compensation, options.live);
  if (!options.write.control.empty()) {
    compensate_write(options.compensation, options.write);
  } else if (replay) {
    compensate_replay(options.compensation, options.replay);
  }
}

void add_place_options(CLI::App& command, ShaftPictureArguments& options) {
  ShaftPictureOptions& of = options.of;
  const auto add = [&](const char* name, auto& value, const char* what, const char* type) {
    return command.add_option(name, value, what)->group(kPlaceGroup)->type_name(type);
  };
  add("--from-picture", of.files,
      "without --model: find the sensor position for the axial elongation, from temperature pictures (PNG, JPEG) or a "
      "table .csv of x_mm and columns in degC",
      "FILE");
  add("--start-degC", of.start_degC, "temperature of zero elongation", "DEGC");
  add("--expansion-ppm-per-K", of.expansion_ppm_per_K, "thermal expansion of the spindle; default: 11.7, steel",
      "PPM/K");
  add("--plot", options.plot, "write T along x (.svg), or the picture with the result (.png), to FILE", "FILE")
      ->check(name_that_ends_in({".svg", ".png"}));
  add("--from-mm", of.from_mm, "position of the left edge of the region; default: 0", "MM");
  add("--to-mm", of.to_mm, "position of the right edge of the region", "MM");
  add("--min-degC", of.min_degC, "cold end of the colour scale; once, or once per picture", "DEGC");
  add("--max-degC", of.max_degC, "hot end of the colour scale; once, or once per picture", "DEGC");
  add("--legend", of.legend, "colour scale in the picture, inside its frame; hot end at the top or right", "X,Y,W,H");
  add("--colours", of.colours,
      "known colour scale: jet, turbo, viridis, inferno, hot, gray and others; _r at the end reverses it", "NAME");
  add("--region", of.region, "region to evaluate; default: all pixels on the scale, without the legend", "X,Y,W,H");
  add("--edge-px", of.edge_px, "margin around pixels that are not on the scale; default: 3", "PX");
  command.add_flag("--vertical", of.vertical, "let x run from top to bottom of the region")->group(kPlaceGroup);
}

}  // namespace

void add_compensate(CLI::App& app) {
  const auto options = std::make_shared<CompensateArguments>();
  CLI::App* command = app.add_subcommand("compensate", "Compute axis offsets from sensor readings");
  add_compensation_options(*command, options->compensation);
  command->get_option("--model")->required(false);
  command->add_option("--signals", options->live.signals, "growing series .csv, or - for standard input")
      ->type_name("FILE");
  command->add_flag("--follow", options->live.follow, "wait for further rows of the file");
  add_choice(*command, "--format", {"csv", "jsonl", "word"}, "csv",
             "format of the rows of --signals; word: 16 bits for a PLC",
             [options](std::size_t at) { options->live.format = static_cast<OffsetFormat>(at); });
  add_data(*command, "--on", options->replay.data, "session or series to replay: its error with compensation")
      ->type_name("DATA");
  command
      ->add_option("--out", options->out,
                   "write to FILE: .csv with --on or --from-picture, .toml with --fit, .mpf, .lis or .hal with "
                   "--write; may be repeated")
      ->type_name("FILE")
      ->allow_extra_args(false)
      ->check(name_that_ends_in({".csv", ".toml", ".mpf", ".lis", ".hal"}));
  command
      ->add_option("--write", options->write.control,
                   "with --on and --out: write the control's own compensation from one sensor: siemens, beckhoff or "
                   "linuxcnc; siemens:2 from the best two, siemens:T_a_degC,T_b_degC from these")
      ->type_name("CONTROL[:SENSORS]");
  command->add_flag("--reversed-sign", options->write.reversed,
                    "with --write: reverse the sign, if the axis moves the wrong way");
  command->add_flag("--json", options->json, "print the result as JSON; with --signals one JSON row per line");
  add_place_options(*command, options->place);
  command->footer(
      "Examples:\n"
      "  ballbar compensate --model sample-runs/spindle-rotation-huang2022/mean-point.toml --to z \\\n"
      "    --on sample-runs/spindle-rotation-huang2022\n"
      "  ballbar compensate --model live.toml --to z --on monday.csv --write siemens --out z.mpf\n"
      "  ballbar compensate --from-picture shaft.png --to-mm 330 --min-degC 22 --max-degC 48 --legend 780,71,24,198\n"
      "  ballbar compensate --from-picture shaft.csv --start-degC 22.5");
  command->callback([options, command] { run(*options, *command); });
}

}  // namespace ballbar::commands
