// ballbar-hal: a LinuxCNC component that moves axes against the thermal error their models predict. See README.md.
#include <fmt/format.h>
#include <glog/logging.h>
#include <time.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ballbar/compensation/compensation.hpp"
#include "ballbar/error.hpp"
#include "compensate/compensation_options.hpp"
#include "hal/axis.hpp"
#include "hal/component.hpp"
#include "hal/hal_names.hpp"
#include "terminal/option_checks.hpp"

namespace ballbar::hal {
namespace {

struct Options {
  CompensationOptions compensation;
  std::string name = "ballbar";
  double period_s = 0.1;
  double save_s = 10.0;
  bool clock_pin = false;
  double mm_per_unit = 1.0;  // of the machine
};

// Never throws: a closed terminal is no reason to leave a machine without compensation.
void say(const std::string& text) { std::fputs(("ballbar-hal: " + text + "\n").c_str(), stderr); }

double now_s() { return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count(); }

sigset_t stop_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGTERM);
  sigaddset(&signals, SIGINT);
  return signals;
}

// SIGTERM and SIGINT are blocked and taken here, so that none comes between two pins. True when one has come.
bool stop_signal_within(double wait_s) {
  const sigset_t signals = stop_signals();
  timespec wait{};
  wait.tv_sec = static_cast<time_t>(wait_s);
  wait.tv_nsec = static_cast<long>((wait_s - std::floor(wait_s)) * 1e9);
  return sigtimedwait(&signals, nullptr, &wait) > 0;
}

void block_signals() {
  const sigset_t signals = stop_signals();
  sigprocmask(SIG_BLOCK, &signals, nullptr);
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow: then write() says so
}

void expect_period(double period_s) {
  if (period_s >= 0.001 && period_s <= 10.0) return;
  throw Error(fmt::format("--period-s: expected 0.001 to 10 s, found {}.", period_s));
}

std::string reason_text(const std::string& axis, const Step& step, const Compensator& compensator) {
  if (step.reason == Reason::none) return fmt::format("{}: not held", axis);
  const bool of_column = is_about_a_column(step.offset.hold);
  return fmt::format("{}: held at {:.3f} um: {}{}", axis, step.offset.offset_um, name_of(step.reason),
                     of_column ? " at " + compensator.columns()[step.offset.column] : "");
}

void run(const Options& options) {
  expect_period(options.period_s);
  const std::vector<CompensatedAxis> axes = axes_of(options.compensation);
  const std::string letters = letters_of(axes);
  CompensatedAxes machine(axes, options.compensation.limits);
  KeptState state(options.compensation.state, axes, machine);
  block_signals();
  Component component(options.name, machine.columns(), letters, options.clock_pin, options.mm_per_unit);
  for (std::size_t a = 0; a < machine.size(); ++a) component.begin_at(a, machine.axis(a).state().counts);
  state.keep(machine, std::nullopt, 0.0);  // refused here where it cannot be written; later that is said, and no more
  component.ready();
  state.keep(machine, std::nullopt, 0.0);  // one that cannot be written is said now
  std::vector<Axis> drives(machine.size(), Axis(options.compensation.limits));
  std::vector<Reason> reasons(machine.size(), Reason::none);
  double time_s = std::numeric_limits<double>::quiet_NaN();
  while (!stop_signal_within(options.period_s)) {
    const double clock_s = options.clock_pin ? component.clock_s() : now_s();
    if (options.clock_pin && (clock_s == time_s || std::isnan(clock_s))) continue;
    time_s = clock_s;
    for (std::size_t a = 0; a < machine.size(); ++a) drives[a].begin(component.pins(a), machine.axis(a));
    const std::span<const Offset> offsets = machine.next(time_s, component.values());
    Reason first = Reason::none;
    for (std::size_t a = 0; a < machine.size(); ++a) {
      const Step step = drives[a].end(offsets[a], machine.axis(a));
      component.set(a, step, drives[a].scale_mm());
      if (first == Reason::none) first = step.reason;
      if (step.reason != reasons[a]) say(reason_text(machine.name(a), step, machine.axis(a)));
      reasons[a] = step.reason;
    }
    component.set_reason(first);
    state.keep(machine, std::nullopt, options.save_s);
    component.count_row();
  }
  state.keep(machine, std::nullopt, 0.0);
}

void add_options(CLI::App& app, Options& options) {
  add_compensation_options(app, options.compensation);
  app.add_option("--name", options.name, "of the component and its pins")->capture_default_str();
  app.add_option("--period-s", options.period_s, "between rows")->capture_default_str();
  app.add_option("--save-s", options.save_s, "longest time between saves of the state")->capture_default_str();
  add_choice(app, "--machine-unit", {"mm", "inch"}, "mm", "LINEAR_UNITS of the machine's INI file",
             [&](std::size_t at) { options.mm_per_unit = at == 0 ? 1.0 : 25.4; });
  app.add_flag("--clock-pin", options.clock_pin,
               "a row is taken when the pin clock-s changes, and has that time; to replay a log");
}

}  // namespace
}  // namespace ballbar::hal

int main(int argc, char** argv) {
  FLAGS_minloglevel = google::GLOG_FATAL;  // of the solver, with --fit
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
