#include "ballbar/formats/schedules/spindle_program.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "ballbar/formats/schedules/schedule_csv.hpp"
#include "schedules/program_steps.hpp"

namespace ballbar {
namespace {

template <class... Printers>
struct Printer : Printers... {
  using Printers::operator()...;
};
template <class... Printers>
Printer(Printers...) -> Printer<Printers...>;

double seconds(const steps::Wait& wait) { return static_cast<double>(wait.duration_ms) / 1e3; }

// The shortest decimal of a number that has at most four; `point`: one that has none ends in one, as Fanuc needs it,
// where X100 may be 0.1 mm.
std::string decimal(double value, bool point = false) {
  std::string text = fmt::format("{:.4f}", value);
  text.erase(text.find_last_not_of('0') + 1);
  if (!point && text.ends_with('.')) text.pop_back();
  return text;
}

std::string fanuc(const std::vector<steps::Step>& list, const std::string& name, const ProgramOptions& options) {
  std::string out = fmt::format("%\nO{:04} ({})\n", options.number, name);
  const auto number = [](double value) { return decimal(value, true); };
  const Printer print{
      [&](const steps::Comment& step) { return "(" + step.text + ")"; },
      [&](const steps::Turn& step) { return fmt::format("S{} M03", step.speed_rpm); },
      [&](const steps::Rest&) -> std::string { return "M05"; },
      [&](const steps::Orient&) -> std::string { return "M19"; },
      [&](const steps::Wait& step) { return "G04 X" + number(seconds(step)); },
      [&](const steps::Stop& step) { return fmt::format("M00 ({})", step.message); },
      [&](const steps::Line& step) {
        return fmt::format("G01 X{} Y0. F{}", number(step.x_mm), number(step.feed_mm_per_min));
      },
      [&](const steps::Circle& step) {
        return fmt::format("{} X{} Y0. I{} J0.", step.is_ccw ? "G03" : "G02", number(step.x_mm), number(-step.x_mm));
      },
  };
  out += "G21\nG17 G90 G94 G40\n";
  if (options.ballbar) out += "G54\n";
  if (options.range_m) out += fmt::format("M{}\n", *options.range_m);
  for (const steps::Step& step : list) out += std::visit(print, step) + "\n";
  return out + "M30\n%\n";
}

std::string siemens(const std::vector<steps::Step>& list, const std::string& name, const ProgramOptions& options) {
  std::string out = fmt::format("; {}\n", name);
  const auto number = [](double value) { return decimal(value); };
  const Printer print{
      [&](const steps::Comment& step) { return "; " + step.text; },
      [&](const steps::Turn& step) { return fmt::format("S{} M3", step.speed_rpm); },
      [&](const steps::Rest&) -> std::string { return "M5"; },
      [&](const steps::Orient&) -> std::string { return "SPOS=0"; },
      [&](const steps::Wait& step) { return "G4 F" + number(seconds(step)); },
      [&](const steps::Stop& step) { return fmt::format("MSG(\"{}\")\nM0\nMSG()", step.message); },
      [&](const steps::Line& step) {
        return fmt::format("G1 X{} Y0 F{}", number(step.x_mm), number(step.feed_mm_per_min));
      },
      [&](const steps::Circle& step) {
        return fmt::format("{} X{} Y0 I{} J0", step.is_ccw ? "G3" : "G2", number(step.x_mm), number(-step.x_mm));
      },
  };
  out += "G710 G17 G90 G94 G40\n";
  if (options.ballbar) out += "G54\n";
  if (options.range_m) out += fmt::format("M{}\n", *options.range_m);
  for (const steps::Step& step : list) out += std::visit(print, step) + "\n";
  return out + "M30\n";
}

std::string linuxcnc(const std::vector<steps::Step>& list, const std::string& name, const ProgramOptions& options) {
  std::string out = fmt::format("(PROGRAM {})\n", name);
  const auto number = [](double value) { return decimal(value); };
  const Printer print{
      [&](const steps::Comment& step) { return "(" + step.text + ")"; },
      [&](const steps::Turn& step) { return fmt::format("S{} M3", step.speed_rpm); },
      [&](const steps::Rest&) -> std::string { return "M5"; },
      [&](const steps::Orient&) -> std::string { return "M19 R0"; },
      [&](const steps::Wait& step) { return "G4 P" + number(seconds(step)); },
      [&](const steps::Stop& step) { return fmt::format("(MSG,{})\nM0", step.message); },
      [&](const steps::Line& step) {
        return fmt::format("G1 X{} Y0 F{}", number(step.x_mm), number(step.feed_mm_per_min));
      },
      [&](const steps::Circle& step) {
        return fmt::format("{} X{} Y0 I{} J0", step.is_ccw ? "G3" : "G2", number(step.x_mm), number(-step.x_mm));
      },
  };
  out += "G21 G17 G90 G91.1 G94 G40\n";  // G91.1: I and J from where the circle begins
  if (options.ballbar) out += "G54\n";
  for (const steps::Step& step : list) out += std::visit(print, step) + "\n";
  return out + "M2\n";
}

// In plain language every line is a numbered block.
std::string heidenhain(const std::vector<steps::Step>& list, const std::string& name, const ProgramOptions& options) {
  std::vector<std::string> lines{fmt::format("BEGIN PGM {} MM", name)};
  const auto signed_number = [](double value) { return (value < 0.0 ? "" : "+") + decimal(value); };
  if (options.range_m) lines.push_back(fmt::format("M{}", *options.range_m));
  const auto add = [&](std::initializer_list<std::string> more) { lines.insert(lines.end(), more); };
  const Printer print{
      [&](const steps::Comment& step) { add({"; " + step.text}); },
      [&](const steps::Turn& step) {
        add({fmt::format("TOOL CALL Z S{}", step.speed_rpm), "M3"});
      },
      [&](const steps::Rest&) { add({"M5"}); },
      [&](const steps::Orient&) {
        add({"CYCL DEF 13.0 ORIENTATION", "CYCL DEF 13.1 ANGLE 0", "M19"});
      },
      [&](const steps::Wait& step) {
        add({"CYCL DEF 9.0 DWELL TIME", "CYCL DEF 9.1 DWELL " + decimal(seconds(step))});
      },
      [&](const steps::Stop& step) {
        add({"; " + step.message, "M0"});
      },
      [&](const steps::Line& step) {
        add({fmt::format("L X{} Y+0 R0 F{}", signed_number(step.x_mm), decimal(step.feed_mm_per_min))});
      },
      [&](const steps::Circle& step) {
        add({"CC X+0 Y+0", fmt::format("C X{} Y+0 DR{}", signed_number(step.x_mm), step.is_ccw ? "+" : "-")});
      },
  };
  for (const steps::Step& step : list) std::visit(print, step);
  add({"M30", fmt::format("END PGM {} MM", name)});
  std::string out;
  for (std::size_t i = 0; i < lines.size(); ++i) out += fmt::format("{} {}\n", i, lines[i]);
  return out;
}

// The letters and digits of a name that every control takes: a letter first, at most 20.
std::string program_name(const std::string& name) {
  std::string plain = steps::plain_text(name, 200);
  std::erase_if(plain, [](char c) { return !(c >= 'A' && c <= 'Z') && !(c >= '0' && c <= '9'); });
  if (plain.empty() || plain.front() < 'A') plain.insert(0, "P");
  return plain.substr(0, 20);
}

struct Control {
  Dialect dialect;
  std::string_view name, file_name;
  std::string (*print)(const std::vector<steps::Step>& list, const std::string& name, const ProgramOptions& options);
};
constexpr std::array<Control, 4> kControls = {{
    {Dialect::fanuc, "Fanuc", "fanuc.nc", fanuc},
    {Dialect::siemens, "Siemens 840D", "siemens.mpf", siemens},
    {Dialect::heidenhain, "Heidenhain", "heidenhain.h", heidenhain},
    {Dialect::linuxcnc, "LinuxCNC", "linuxcnc.ngc", linuxcnc},
}};

const Control& control_of(Dialect dialect) {
  return *std::find_if(kControls.begin(), kControls.end(), [&](const Control& one) { return one.dialect == dialect; });
}

}  // namespace

std::string_view name_of(Dialect dialect) { return control_of(dialect).name; }
std::string_view file_name_of(Dialect dialect) { return control_of(dialect).file_name; }

std::string spindle_program(const Schedule& schedule, Dialect dialect, const ProgramOptions& options) {
  expect_schedule(schedule);
  steps::expect_options(schedule, options);
  return control_of(dialect).print(steps::steps_of(schedule, options), program_name(options.name), options);
}

}  // namespace ballbar
