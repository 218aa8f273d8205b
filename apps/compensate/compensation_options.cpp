#include "compensate/compensation_options.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <limits>

#include "ballbar/formats/models/batch_model_json.hpp"
#include "ballbar/formats/models/compensation_state.hpp"
#include "ballbar/formats/models/effect_regression_json.hpp"
#include "ballbar/formats/models/model_toml.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "ballbar/internal/fit/held_model.hpp"
#include "ballbar/internal/nearest_name.hpp"
#include "predict/predicted_job.hpp"
#include "terminal/command_line.hpp"
#include "terminal/log_options.hpp"
#include "terminal/option_checks.hpp"
#include "terminal/state_file.hpp"
#include "terminal/stderr_line.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar {
namespace {

double clock_s() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

void expect_held(const Model& model, const std::string& file) {
  for (const Term& term : model.terms) {
    for (std::size_t k = 0; k < term.settings.size(); ++k) {
      if (term.settings[k].held) continue;
      throw Error(
          fmt::format("{}: expected every parameter held, found {} of {} free; give the data to fit it to: "
                      "--fit DATA.",
                      file, term.effect->parameters[k].name, label_of(term)));
    }
  }
}

Model fitted(Model model, const std::string& file, const CompensationOptions& options, const ModelData& data) {
  ModelOptions how = options.fitting;
  how.data = options.fit;
  how.model = file;
  if (has_free(model)) model = held_at(model, fit_of(how, model, data, 0).parameters);
  model.trained = with_source(file, [&] { return ranges_of(model, *data.series); });
  return model;
}

bool is_plain(const std::string& name) {
  return !name.empty() &&
         std::all_of(name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; });
}

CLI::Option* add_limit(CLI::App& command, const std::string& name, double& limit, const char* unit,
                       const std::string& what) {
  return command.add_option(name, limit, what)->capture_default_str()->type_name(unit)->group("Limits");
}

}  // namespace

void add_compensation_options(CLI::App& command, CompensationOptions& options) {
  options.fitting.catalogue = catalogue_of(command);
  add_sources(command, "--model", options.models,
              "model.toml of one or more axes, or model.json of one; may be repeated")
      ->type_name("FILE")
      ->allow_extra_args(false)
      ->required();
  command.add_option("--to", options.axes, "axis of each target, in order: z; default: the target's own name")
      ->type_name("AXIS")
      ->allow_extra_args(false)
      ->check([](const std::string& name) {
        return is_plain(name)
                   ? std::string()
                   : fmt::format("expected a name of letters, digits and _ for an axis, found {}", in_quotes(name));
      });
  add_data(command, "--fit", options.fit, "fit free parameters to DATA; its ranges become the trained ranges")
      ->type_name("DATA")
      ->allow_extra_args(false);
  command
      .add_option("--state", options.state,
                  "continue from this file after a restart and keep it up to date; default: the first row is zero")
      ->type_name("FILE");
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  CompensationLimits& limits = options.limits;
  add_limit(command, "--resolution-um", limits.resolution_um, "UM", "smallest increment of the control")
      ->check(number_above_0());
  add_limit(command, "--hysteresis", limits.hysteresis, "SHARE",
            "hysteresis beyond half an increment, as a share of it")
      ->check(number_within(0.0, 10.0));
  add_limit(command, "--rate-um-per-s", limits.rate_um_per_s, "UM/S", "fastest change of an offset")
      ->check(number_above_0());
  add_limit(command, "--step-um", limits.step_um, "UM", "largest change from one row to the next")
      ->check(number_above_0());
  add_limit(command, "--largest-um", limits.largest_um, "UM", "largest offset")->check(number_above_0());
  add_limit(command, "--range-margin", limits.range_margin, "SHARE",
            "accepted excess over the trained range, as a share of it")
      ->check(number_within(0.0, kInfinite));
  add_limit(command, "--spike-K", limits.spike_K, "K",
            "largest change of a temperature between rows; --heating-K-per-s adds to it")
      ->check(number_above_0(true));
  add_limit(command, "--heating-K-per-s", limits.heating_K_per_s, "K/S",
            "further change of a temperature per second, up or down")
      ->check(number_within(0.0, kInfinite));
  add_limit(command, "--stuck-s", limits.stuck_s, "S",
            "longest time that a temperature may stay constant; inf: no check")
      ->check(number_above_0(true));
  add_limit(command, "--gap-s", limits.gap_s, "S", "longest time between rows")->check(number_above_0(true));
}

std::vector<CompensatedAxis> axes_of(const CompensationOptions& options) {
  std::vector<CompensatedAxis> axes;
  std::optional<ModelData> data;
  if (!options.fit.empty()) {
    ModelOptions how = options.fitting;
    how.data = options.fit;
    data = open_data(how);
  }
  const auto add = [&](Model model) {  // of one target
    const std::size_t number = axes.size();
    const std::string name = number < options.axes.size() ? options.axes[number] : stem_of(model.targets.front());
    axes.push_back({name, std::move(model)});
  };
  for (const Source& source : options.models) {
    const std::string& file = source.name();
    const std::string bytes = source.bytes(kLargestText);
    if (is_effect_regression_json(bytes)) {
      Model model = read_effect_regression(bytes, file).model;
      if (unit_of(model.targets.front()) != "um") {
        throw Error(
            fmt::format("{}: expected a target in um, for an offset is one, found {}.", file, model.targets.front()));
      }
      if (data) {
        throw Error(
            fmt::format("{}: expected a model that can be fitted, found a regression on effects, whose values are all "
                        "held; train it again on the data of --fit.",
                        file));
      }
      add(std::move(model));
      continue;
    }
    if (is_batch_model_json(bytes)) {
      throw Error(
          fmt::format("{}: expected a model of effects, whose memory runs live, found a regression over "
                      "batches.",
                      file));
    }
    const Model whole = read_model(bytes, file, options.fitting.catalogue);
    for (const std::string& target : whole.targets) {
      Model model = whole;
      model.targets = {target};
      if (data) {
        model = fitted(std::move(model), file, options, *data);
      } else {
        expect_held(model, file);
      }
      add(std::move(model));
    }
  }
  if (!options.axes.empty() && options.axes.size() != axes.size()) {
    throw Error(fmt::format("--to: expected as many axes as the models have targets, {}, found {}.", axes.size(),
                            options.axes.size()));
  }
  for (const CompensatedAxis& axis : axes) {
    if (!is_plain(axis.name)) {
      throw Error(
          fmt::format("--to: expected a name of letters, digits and _ for an axis, found {}.", in_quotes(axis.name)));
    }
  }
  return axes;
}

bool is_in_sample(const CompensationOptions& options, const std::vector<std::filesystem::path>& files) {
  return std::any_of(options.fit.begin(), options.fit.end(), [&](const Source& fitted) {
    if (!fitted.is_path()) return false;
    const std::filesystem::path path = fitted.path();
    std::error_code error;
    for (const std::filesystem::path& file : files) {
      if (std::filesystem::equivalent(file, path, error) ||
          std::filesystem::equivalent(file.parent_path(), path, error))
        return true;
    }
    return false;
  });
}

std::string parameters_text(const CompensationOptions& options, const std::vector<std::filesystem::path>& files) {
  if (options.fit.empty())
    return "The parameters are those of the model's file: whether they were fitted to these data is not known here.";
  if (is_in_sample(options, files)) {
    return "The parameters were fitted to these same data: what a model gains on data it has seen says little of what "
           "it gains on others.";
  }
  return fmt::format("The parameters were fitted to {} alone.", shortened(options.fit.front().name(), 60));
}

KeptState::KeptState(const std::string& file, const std::vector<CompensatedAxis>& axes, CompensatedAxes& machine)
    : file_(file), counts_(axes.size(), 0) {
  if (file_.empty()) return;
  lock_ = only_program(file_);
  std::vector<std::string> texts;  // which older versions stored
  for (const CompensatedAxis& axis : axes) {
    texts.push_back(write_model(axis.model));
    models_.push_back(digest_of(texts.back()));
  }
  if (!std::filesystem::exists(file_)) return;
  const StoredCompensation whole = read_compensation(read_bytes(file_, kLargestText), file_);
  const std::vector<StoredAxis>& stored = whole.axes;
  for (std::size_t a = 0; a < std::max(axes.size(), stored.size()); ++a) {
    const std::string expected = a < axes.size() ? axes[a].name : "no other axis";
    const std::string found = a < stored.size() ? stored[a].name : "none";
    if (expected != found) {
      throw Error(fmt::format("{}: expected the state of {}, found {}.", file_, expected, in_quotes(found)));
    }
    if (stored[a].model != models_[a] && stored[a].model != texts[a]) {
      throw Error(
          fmt::format("{}: expected the state of {} with this model, found one with another. Without the file "
                      "the offset begins at 0 again.",
                      file_, expected));
    }
  }
  for (std::size_t a = 0; a < stored.size(); ++a) {
    with_source(file_, [&] { machine.axis(a).resume(stored[a].state, stored[a].live); });
    counts_[a] = stored[a].state.counts;
  }
  signals_ = whole.signals;
  resumed_ = true;
}

std::uint64_t KeptState::bytes_of(const std::optional<SignalsPlace>& signals) const {
  const bool same = signals && signals_ && signals->file == signals_->file && signals->inode == signals_->inode;
  return same ? signals_->bytes : 0;
}

void KeptState::keep(const CompensatedAxes& machine, const std::optional<SignalsPlace>& signals, double at_least_s) {
  if (file_.empty()) return;
  const double now_s = clock_s();
  bool changed = !written_;
  for (std::size_t a = 0; a < machine.size(); ++a) changed |= counts_[a] != machine.axis(a).state().counts;
  if (!changed && now_s - written_s_ < at_least_s) return;
  StoredCompensation stored{{}, signals};
  for (std::size_t a = 0; a < machine.size(); ++a) {
    const Compensator& axis = machine.axis(a);
    stored.axes.push_back({machine.name(a), models_[a], axis.state(), axis.model().state()});
    counts_[a] = axis.state().counts;
  }
  written_s_ = now_s;
  try {
    write_bytes_durably(file_, write_compensation(stored));
    written_ = true;
    failed_ = false;
  } catch (const Error& error) {
    if (!written_) throw;
    if (!failed_) stderr_line(fmt::format("{} It goes on without.", error.what()));
    failed_ = true;
  }
}

}  // namespace ballbar
