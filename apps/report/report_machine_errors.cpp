// The errors of a machine as a part of a report: what `errors --json` says, and the curves that the page draws.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <utility>

#include "ballbar/error.hpp"
#include "ballbar/units.hpp"
#include "errors/machine_errors_result.hpp"
#include "report/report_results.hpp"

namespace ballbar {
namespace {

namespace fs = std::filesystem;
using Places = std::vector<std::size_t>;  // in Fitted::recordings

// Values of all recordings, one after the other, as one column for each. To a nanometre, a tenth of what instruments
// write: a curve needs no more, and there are many.
std::vector<Bulk> each(const std::vector<double>& values, const std::vector<Recording>& recordings) {
  std::vector<Bulk> all;
  std::size_t at = 0;
  for (const Recording& recording : recordings) {
    Bulk& one = all.emplace_back();
    for (std::size_t i = 0; i < recording.length_mm.size(); ++i)
      one.values.push_back(std::round(values[at++] * 1e3) / 1e3);
  }
  return all;
}

struct CircleOfRecording {
  double radius_um = 0.0, a_um = 0.0, b_um = 0.0;
};

// The circle that the first recordings of both directions share, without what shifts it between them; a further
// recording has one of its own beside it.
CircleOfRecording circle_of(const MachineErrors& found, std::size_t recording) {
  CircleOfRecording circle;
  const std::pair<const char*, double*> parts[] = {
      {"global_scale", &circle.radius_um}, {"centre_a", &circle.a_um}, {"centre_b", &circle.b_um}};
  for (const FittedGain& gain : found.gains) {
    if (gain.effect != nullptr || (gain.recording && *gain.recording != recording)) continue;
    for (const auto& [name, part] : parts) {
      if (gain.name == name || (gain.recording && gain.name.starts_with(name))) *part += gain.value;
    }
  }
  return circle;
}

// r(t) = |(a + R cos t, b + R sin t, h)| - L, R = L + radius
std::vector<double> circle_um(const MachineErrors& found, const std::vector<Recording>& recordings) {
  std::vector<double> values;
  for (std::size_t k = 0; k < recordings.size(); ++k) {
    const Recording& recording = recordings[k];
    const CircleOfRecording circle = circle_of(found, k);
    const double radius_mm = recording.nominal_length_mm + mm_from_um(circle.radius_um);
    values.reserve(values.size() + recording.angle_rad.size());
    for (const double angle_rad : recording.angle_rad) {
      const double length_mm =
          std::hypot(mm_from_um(circle.a_um) + radius_mm * std::cos(angle_rad),
                     mm_from_um(circle.b_um) + radius_mm * std::sin(angle_rad), recording.height_offset_mm);
      values.push_back(um_from_mm(length_mm - recording.nominal_length_mm));
    }
  }
  return values;
}

// Where they lay is nobody's business whom the page is mailed to.
std::string with_file_names(std::string text, const std::vector<std::string>& files) {
  for (const std::string& file : files) {
    const std::size_t at = text.find(file);
    if (at != std::string::npos) text.replace(at, file.size(), fs::path(file).filename().string());
  }
  return text;
}

MachineErrorsOfTest part_of(const ErrorsReport& report, const Places& places) {
  MachineErrorsOfTest part{report, {}, places, each(circle_um(report.found, report.recordings), report.recordings),
                           {},     {}};
  for (const std::string& file : report.files) part.files.push_back(fs::path(file).filename().string());
  for (const RankedError& one : report.found.ranked) {
    part.curves.emplace_back(one.effect->name,
                             each(curve_of(report.found, one.effect, report.recordings), report.recordings));
    part.pages.push_back({one.effect, report.recordings.front().plane});
  }
  return part;
}

// A test is both directions, and what else is in their file.
std::vector<Places> tests_of(const Fitted& fitted) {
  std::vector<std::optional<std::size_t>> partner(fitted.recordings.size());
  for (const FittedPair& pair : fitted.pairs) partner[std::max(pair.ccw, pair.cw)] = std::min(pair.ccw, pair.cw);
  std::vector<Places> tests;
  for (std::size_t place = 0; place < fitted.recordings.size(); ++place) {
    const FittedRecording& one = fitted.recordings[place];
    if (one.recording.kind != Kind::circle || one.recording.motion != Motion::linear_axes) continue;
    const auto together = std::find_if(tests.begin(), tests.end(), [&](const Places& test) {
      return std::any_of(test.begin(), test.end(), [&](std::size_t other) {
        return partner[place] == other || fitted.recordings[other].file == one.file;
      });
    });
    if (together == tests.end()) {
      tests.push_back({place});
    } else {
      together->push_back(place);
    }
  }
  return tests;
}

}  // namespace

MachineErrorsPart machine_errors_part(const Fitted& fitted, const StatedCircle& stated) {
  MachineErrorsPart part;
  for (const Places& places : tests_of(fitted)) {
    std::vector<std::string> files;
    for (const std::size_t place : places) {
      const std::string& file = fitted.recordings[place].file;
      if (std::find(files.begin(), files.end(), file) == files.end()) files.push_back(file);
    }
    try {
      const ErrorsReports found = errors_reports_of({files.begin(), files.end()}, {.circle = stated});
      if (found.groups.size() != 1 || found.groups.front().recordings.size() != places.size()) continue;
      part.tests.push_back(part_of(found.groups.front(), places));
      part.conclusions.push_back(conclusion(found.groups.front()));
    } catch (const Error& error) {  // the recordings are worth looking at without
      part.remarks.push_back(
          fmt::format("The errors of the machine are not known: {}", with_file_names(error.what(), files)));
    }
  }
  return part;
}

}  // namespace ballbar
