#include "ballbar/formats/controls/control_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

#include "ballbar/error.hpp"
#include "controls/control_text.hpp"

namespace ballbar {
namespace {

constexpr std::array<ControlKind, 3> kKinds = {{
    {Control::siemens, "siemens", "SINUMERIK 840D sl", ".mpf"},
    {Control::beckhoff, "beckhoff", "TwinCAT 3 CNC TF5200", ".lis"},
    {Control::linuxcnc, "linuxcnc", "LinuxCNC", ".hal"},
}};

struct NotWritten {
  std::string_view word, why;
};
constexpr std::array<NotWritten, 2> kNotWritten = {{
    {"fanuc",
     "the public FANUC manual has no formula of temperatures: thermal growth compensation along the tool (Series 15i, "
     "16i) takes a length from the PMC"},
    {"heidenhain",
     "the public HEIDENHAIN manual has a formula only for the length of a tilting head (TEMPCOMP); for an axis it has "
     "a length from the PLC without its sign (Module 9231)"},
}};

}  // namespace

std::span<const ControlKind> control_kinds() { return kKinds; }

const ControlKind& kind_of(Control control) {
  return *std::find_if(kKinds.begin(), kKinds.end(), [&](const ControlKind& kind) { return kind.control == control; });
}

Control control_of(std::string_view word) {
  std::vector<std::string_view> words;
  for (const ControlKind& kind : kKinds) {
    if (kind.word == word) return kind.control;
    words.push_back(kind.word);
  }
  for (const NotWritten& control : kNotWritten) {
    if (control.word != word) continue;
    throw Error(fmt::format("{}: not written, because {}. Send it the offsets of --signals, --format word.", word,
                            control.why));
  }
  throw Error(fmt::format("expected one of the controls {}, found \"{}\".", fmt::join(words, ", "), word));
}

Increment increment_of(Control control, double resolution_um) {
  switch (control) {
    case Control::siemens:
      return {resolution_um, false};
    case Control::beckhoff:
      return {0.1, false};
    case Control::linuxcnc:
      return {resolution_um, true};
  }
  return {resolution_um, false};
}

std::string control_file(Control control, const ControlLine& line) {
  switch (control) {
    case Control::siemens:
      return siemens_file(line);
    case Control::beckhoff:
      return beckhoff_file(line);
    case Control::linuxcnc:
      return linuxcnc_file(line);
  }
  return {};
}

}  // namespace ballbar
