// ballbar-hal: a LinuxCNC component that moves axes against the thermal error their models predict. See README.md.
#include <fmt/format.h>
#include <time.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <deque>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "axis.hpp"
#include "ballbar/error.hpp"
#include "ballbar/formats/bytes.hpp"
#include "ballbar/formats/model_toml.hpp"
#include "component.hpp"
#include "state.hpp"

namespace ballbar::hal {
namespace {

constexpr std::size_t kLargestState = std::size_t{1} << 20;

struct Options {
  std::string name = "ballbar";
  std::vector<std::string> model, to, state;
  CompensationLimits limits;
  double period_s = 0.1;
  double save_s = 10.0;
  bool clock_pin = false;
};

// Never throws: a closed terminal is no reason to leave a machine without compensation.
void say(const std::string& text) { std::fputs(("ballbar-hal: " + text + "\n").c_str(), stderr); }

double now_s() { return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count(); }

// SIGTERM and SIGINT are blocked and taken here, so that none comes between two pins. True when one has come.
bool told_to_stop_within(double wait_s) {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGTERM);
  sigaddset(&signals, SIGINT);
  timespec wait{};
  wait.tv_sec = static_cast<time_t>(wait_s);
  wait.tv_nsec = static_cast<long>((wait_s - std::floor(wait_s)) * 1e9);
  return sigtimedwait(&signals, nullptr, &wait) > 0;
}

void block_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGTERM);
  sigaddset(&signals, SIGINT);
  sigprocmask(SIG_BLOCK, &signals, nullptr);
  std::signal(SIGPIPE, SIG_IGN);
}

void expect_pairs(const Options& options) {
  if (options.to.size() != options.model.size()) {
    throw Error(
        fmt::format("expected a --to for each --model, found {} for {}.", options.to.size(), options.model.size()));
  }
  if (!options.state.empty() && options.state.size() != options.model.size()) {
    throw Error(fmt::format("expected a --state for each --model or none, found {} for {}.", options.state.size(),
                            options.model.size()));
  }
  for (std::size_t a = 0; a < options.to.size(); ++a) {
    const std::string& letter = options.to[a];
    if (letter.size() != 1 || std::string_view("xyzabcuvw").find(letter) == std::string_view::npos) {
      throw Error(fmt::format("--to: expected the letter of an axis, one of x y z a b c u v w, found '{}'.", letter));
    }
    if (std::count(options.to.begin(), options.to.end(), letter) > 1) {
      throw Error(fmt::format("--to: expected each axis once, found '{}' again.", letter));
    }
  }
  if (!(options.period_s >= 0.001 && options.period_s <= 10.0)) {
    throw Error(fmt::format("--period-s: expected 0.001 to 10 s, found {}.", options.period_s));
  }
}

std::string told(const Axis& axis, const Step& step) {
  if (step.reason == Reason::none) return fmt::format("{}: not held", axis.letter());
  const bool of_column = step.reason <= Reason::out_of_range;
  return fmt::format("{}: held at {:.3f} um: {}{}", axis.letter(), step.offset.offset_um, name_of(step.reason),
                     of_column ? " at " + axis.compensator().columns()[step.offset.column] : "");
}

void save(const Options& options, const std::deque<Axis>& axes) {
  for (std::size_t a = 0; a < options.state.size(); ++a) {
    try {
      write_bytes(options.state[a], write_state(axes[a].compensator()));
    } catch (const Error& error) {
      say(error.what());
    }
  }
}

// Columns of all axes, each once; `of[a]` says where those of axis a stand.
struct Columns {
  std::vector<std::string> names;
  std::vector<std::vector<std::size_t>> of;
};

Columns columns_of(const std::deque<Axis>& axes) {
  Columns columns;
  for (const Axis& axis : axes) {
    columns.of.emplace_back();
    for (const std::string& name : axis.compensator().columns()) {
      const auto at = std::find(columns.names.begin(), columns.names.end(), name);
      columns.of.back().push_back(static_cast<std::size_t>(at - columns.names.begin()));
      if (at == columns.names.end()) columns.names.push_back(name);
    }
  }
  return columns;
}

void run(const Options& options) {
  expect_pairs(options);
  std::deque<Axis> axes;  // which cannot be moved
  std::string letters;
  for (std::size_t a = 0; a < options.model.size(); ++a) {
    const Model model = read_model(read_bytes(options.model[a], kLargestText), options.model[a]);
    axes.emplace_back(options.to[a][0], model, options.limits);
    letters += options.to[a];
    if (options.state.empty() || !std::filesystem::exists(options.state[a])) continue;
    resume(axes.back().compensator(), read_bytes(options.state[a], kLargestState), options.state[a]);
  }
  const Columns columns = columns_of(axes);
  block_signals();
  Component component(options.name, columns.names, letters, options.clock_pin);
  for (std::size_t a = 0; a < axes.size(); ++a) component.begin_at(a, axes[a].compensator().state().counts);
  component.ready();
  std::vector<Reason> reasons(axes.size(), Reason::none);
  double time_s = std::numeric_limits<double>::quiet_NaN(), saved_s = now_s();
  while (!told_to_stop_within(options.period_s)) {
    const double clock_s = options.clock_pin ? component.clock_s() : now_s();
    if (options.clock_pin && (clock_s == time_s || std::isnan(clock_s))) continue;
    time_s = clock_s;
    const std::vector<double> all = component.values();
    Reason first = Reason::none;
    for (std::size_t a = 0; a < axes.size(); ++a) {
      std::vector<double> values;
      for (const std::size_t c : columns.of[a]) values.push_back(all[c]);
      const Step step = axes[a].next(time_s, values, component.pins(a));
      component.set(a, step, axes[a].scale_mm());
      if (first == Reason::none) first = step.reason;
      if (step.reason != reasons[a]) say(told(axes[a], step));
      reasons[a] = step.reason;
    }
    component.set_reason(first);
    component.count_row();
    if (now_s() - saved_s < options.save_s && now_s() >= saved_s) continue;
    save(options, axes);
    saved_s = now_s();
  }
  save(options, axes);
}

void add_options(CLI::App& app, Options& options) {
  app.add_option("--model", options.model, "model of the axis' error, with every parameter at its start")
      ->type_name("FILE")
      ->required()
      ->allow_extra_args(false);
  app.add_option("--to", options.to, "axis that is moved; one for each --model")
      ->type_name("LETTER")
      ->required()
      ->allow_extra_args(false);
  app.add_option("--state", options.state, "what is known is kept there for the next start; one for each --model")
      ->type_name("FILE")
      ->allow_extra_args(false);
  app.add_option("--name", options.name, "of the component and its pins")->capture_default_str();
  app.add_option("--period-s", options.period_s, "between rows")->capture_default_str();
  app.add_option("--save-s", options.save_s, "between saves of the state")->capture_default_str();
  app.add_flag("--clock-pin", options.clock_pin,
               "a row is taken when the pin clock-s changes, and has that time; to replay a log");
  CompensationLimits& limits = options.limits;
  app.add_option("--resolution-um", limits.resolution_um, "of a count")->capture_default_str();
  app.add_option("--hysteresis", limits.hysteresis, "of a count, beyond the half")->capture_default_str();
  app.add_option("--rate-um-per-s", limits.rate_um_per_s, "most, of the offset")->capture_default_str();
  app.add_option("--step-um", limits.step_um, "most from row to row")->capture_default_str();
  app.add_option("--largest-um", limits.largest_um, "offset")->capture_default_str();
  app.add_option("--range-margin", limits.range_margin, "of a trained range, at either end")->capture_default_str();
  app.add_option("--spike-K", limits.spike_K, "of a temperature, at once")->capture_default_str();
  app.add_option("--heating-K-per-s", limits.heating_K_per_s, "and with the time")->capture_default_str();
  app.add_option("--stuck-s", limits.stuck_s, "a temperature may stay the same")->capture_default_str();
  app.add_option("--gap-s", limits.gap_s, "most between rows")->capture_default_str();
}

}  // namespace
}  // namespace ballbar::hal

int main(int argc, char** argv) {
  CLI::App app{"LinuxCNC component: external offsets of axes from models of their thermal error."};
  app.name("ballbar-hal");
  ballbar::hal::Options options;
  ballbar::hal::add_options(app, options);
  try {
    app.parse(argc, argv);
    ballbar::hal::run(options);
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    ballbar::hal::say(std::string(error.what()) + "; see ballbar-hal --help");
    return 2;
  } catch (const std::exception& error) {
    ballbar::hal::say(error.what());
    return 1;
  }
  return 0;
}
