#include "simulate/simulated_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <system_error>

#include "ballbar/circle/circle.hpp"
#include "ballbar/error.hpp"
#include "ballbar/formats/recordings/b5r.hpp"
#include "ballbar/formats/recordings/ballbar_log.hpp"
#include "ballbar/formats/series/series_csv.hpp"
#include "ballbar/formats/sessions/session_toml.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "ballbar/formats/text/new_folder.hpp"
#include "ballbar/units.hpp"

namespace ballbar {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kLabel = "# SIMULATED by ballbar simulate, not measured.\n";

// A TOML comment; in a `.csv` behind the table's own comment sign.
std::string labelled_toml(const std::string& bytes) { return std::string(kLabel) + bytes; }
std::string labelled_csv(const std::string& bytes) { return "# " + std::string(kLabel) + bytes; }

double rounded(double value, double per_unit) { return std::round(value * per_unit) / per_unit; }

// Along the axis, not over time: a table of its own.
std::string write_profiles(const std::vector<ShaftProfile>& profiles) {
  std::string text = "x_mm";
  for (const ShaftProfile& profile : profiles) text += fmt::format(",T_{}s_degC", profile.time_s);
  text += '\n';
  for (std::size_t i = 0; i < profiles.front().shaft.x_mm.size(); ++i) {
    text += fmt::format("{}", profiles.front().shaft.x_mm[i]);
    for (const ShaftProfile& profile : profiles) text += fmt::format(",{}", rounded(profile.shaft.degC[i], 1e6));
    text += '\n';
  }
  return text;
}

// What an instrument's software would store: in a run mm to 0.1 um, in an analysis um to 0.1 um.
void store_run(B5r& test, std::size_t index, const Circle& circle, const Circularity& deviation) {
  const std::string run = fmt::format("run {}", index);
  const auto store_mm = [&](const char* name, double value_mm) {
    test.stored.push_back({run, name, "UT_LENGTH_MM", rounded(value_mm, 1e4)});
  };
  store_mm("AF_CENTRE_OFFSET_A", mm_from_um(circle.centre_a_um));
  store_mm("AF_CENTRE_OFFSET_B", mm_from_um(circle.centre_b_um));
  store_mm("AF_BEST_RADIUS", circle.radius_mm);
  store_mm("AF_CIRCULARITY", mm_from_um(deviation.circular_deviation_um));
  test.stored.push_back({run, "AF_CALCULATED_FEEDRATE", "UT_FEEDRATE", rounded(*test.runs[index].feed_mm_per_min, 10)});
}

void store_results(B5r& test) {
  std::vector<Circle> circles;
  std::vector<Circularity> deviations;
  for (std::size_t i = 0; i < test.runs.size(); ++i) {
    circles.push_back(fit_circle(test.runs[i], {.model = CircleModel::polar}));
    deviations.push_back(circularity(test.runs[i], circles[i]));
    store_run(test, i, circles[i], deviations[i]);
  }
  const auto store_um = [&](const std::string& name, double value_um) {
    test.stored.push_back({"ISO230_4 2005", name, "UT_LENGTH_UM", rounded(value_um, 10)});
  };
  for (std::size_t i = 0; i < test.runs.size(); ++i) {
    const std::string direction(name_of(test.runs[i].direction));
    store_um("AF_CIRCULAR_DEVIATION_" + direction, deviations[i].circular_deviation_um);
    store_um("AF_MAX_RADIAL_DEVIATION_" + direction, deviations[i].max_radial_um);
    store_um("AF_MIN_RADIAL_DEVIATION_" + direction, deviations[i].min_radial_um);
  }
  const Bidirectional both = bidirectional(test.runs[0], circles[0], test.runs[1], circles[1]);
  store_um("AF_CIRCULAR_DEVIATION_BIDIRECTIONAL", both.bidirectional_2005_um);
  store_um("AF_CIRCULAR_HYSTERESIS", both.hysteresis_um);
}

std::string b5r_of(const Session& session, const SessionTest& test) {
  B5r file;
  file.test_name = fmt::format("SIMULATED by ballbar, not measured: {}", session.title);
  file.ballbar_model = "simulated";
  file.software_version = "ballbar simulate";
  for (const Recording& run : test.circles) {
    if (!run.started_s) {
      throw Error(
          "A .b5r file states when its test started, and the virtual machine does not: give it a line such as "
          "started = 2024-03-04T08:00:00.");
    }
    if (run.height_offset_mm != 0.0) {
      throw Error(
          fmt::format("A .b5r file has no place for height_offset_mm: expected 0, found {}.", run.height_offset_mm));
    }
    file.runs.push_back(run);
  }
  store_results(file);
  return write_b5r(file);
}

void expect_different_seconds(const Session& session) {
  for (std::size_t i = 1; i < session.tests.size(); ++i) {
    if (session.tests[i].circles.front().started_s != session.tests[i - 1].circles.front().started_s) continue;
    throw Error(
        fmt::format("The start date of a .b5r file has whole seconds: expected tests that start in different "
                    "ones, found {} s and {} s.",
                    session.tests[i - 1].elapsed_s, session.tests[i].elapsed_s));
  }
}

SessionPlan plan_of(const SimulatedSession& simulated) {
  const Session& session = simulated.session;
  SessionPlan plan;
  plan.method = session.method;
  plan.title = session.title;
  plan.nominal_length_mm = session.nominal_length_mm;
  plan.spindle_above = session.spindle_above;
  if (!simulated.signals.columns.empty()) plan.signal_files = {"signals.csv"};
  if (!simulated.five_probe.columns.empty()) {
    plan.five_probe_file = "five-probe.csv";
    plan.ball.from_plane_1_mm = simulated.ball_from_plane_1_mm;
  }
  return plan;
}

}  // namespace

void expect_room(const std::set<fs::path>& names, const fs::path& folder, const fs::path& truth_file, bool replace) {
  if (!replace && fs::exists(truth_file)) {
    throw Error(
        fmt::format("{}: expected a new file for the truth, found one; --force replaces it.", truth_file.string()));
  }
  if (!fs::exists(folder)) return;
  if (!fs::is_directory(folder)) throw Error(fmt::format("{}: expected a folder, found a file.", folder.string()));
  if (fs::is_empty(folder)) return;
  if (!replace) {
    throw Error(
        fmt::format("{}: expected a new or an empty folder, found one that holds files; --force replaces those "
                    "of the same names.",
                    folder.string()));
  }
  const bool below = std::any_of(names.begin(), names.end(), [](const fs::path& name) {  // one folder per machine
    return name.has_parent_path() && name.extension() == ".b5r";
  });
  std::error_code unread;  // a folder that cannot be looked into is not written to either
  for (const fs::directory_entry& entry :
       fs::recursive_directory_iterator(folder, fs::directory_options::skip_permission_denied, unread)) {
    const fs::path name = entry.path().lexically_relative(folder);
    if (name.has_parent_path() && !below) continue;
    if ((name != "session.toml" && entry.path().extension() != ".b5r") || names.contains(name)) continue;
    throw Error(
        fmt::format("{}: expected a folder whose recordings are all replaced, found {}, which would mix with "
                    "the new ones; remove it first.",
                    folder.string(), name.string()));
  }
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  if (!folder.empty()) fs::create_directories(folder, error);
  if (error)
    throw Error(fmt::format("{}: expected a folder that can be made, found: {}.", folder.string(), error.message()));
}

std::vector<SimulatedFile> simulated_files(const SimulatedSession& simulated, bool as_b5r) {
  const Session& session = simulated.session;
  const bool is_series = !simulated.series.columns.empty();
  if (as_b5r && (is_series || session.method != Method::circles)) {
    throw Error(fmt::format("Only method circles makes .b5r files: expected it with --b5r, found {}.",
                            is_series ? std::string_view("series") : name_of(session.method)));
  }
  std::vector<SimulatedFile> files;
  const auto add_profiles = [&] {
    if (!simulated.profiles.empty()) files.push_back({"shaft.csv", labelled_csv(write_profiles(simulated.profiles))});
  };
  if (is_series) {
    files.push_back({"series.csv", labelled_csv(write_series(simulated.series))});
    add_profiles();
    return files;
  }
  SessionPlan plan = plan_of(simulated);
  for (const SessionTest& test : session.tests) {
    const std::string number = fmt::format("{:02}", plan.tests.size());
    SessionPlan::Test entry;
    entry.elapsed_s = test.elapsed_s;
    entry.axial_length_mm = test.axial_length_mm;
    const auto log = [&](std::string& name, std::string_view suffix, const std::optional<Recording>& recording) {
      if (!recording) return;
      name = fmt::format("{}-{}.csv", number, suffix);
      files.push_back({name, labelled_csv(write_ballbar_log(*recording))});
    };
    log(entry.c_arc, "c", test.c_arc);
    log(entry.a_arc, "a", test.a_arc);
    log(entry.rotation, "r", test.rotation);
    log(entry.axial, "z", test.axial);
    if (!test.circles.empty()) {
      entry.circle = number + ".b5r";
      files.push_back({entry.circle, b5r_of(session, test)});
    }
    plan.tests.push_back(std::move(entry));
  }
  if (session.method == Method::circles) expect_different_seconds(session);
  if (as_b5r) return files;
  if (!plan.signal_files.empty()) files.push_back({"signals.csv", labelled_csv(write_series(simulated.signals))});
  if (!plan.five_probe_file.empty())
    files.push_back({"five-probe.csv", labelled_csv(write_series(simulated.five_probe))});
  add_profiles();
  files.push_back({"session.toml", labelled_toml(write_session_plan(plan))});
  return files;
}

void write_simulated(const std::vector<SimulatedFile>& files, const Series& truth, const fs::path& folder,
                     const fs::path& truth_file, bool replace) {
  const fs::path target = folder_to_write(folder);
  std::set<fs::path> names;
  for (const SimulatedFile& file : files) names.insert(file.name);
  expect_room(names, folder, truth_file, replace);
  make_folder(target.parent_path());
  const fs::path temporary = new_folder_beside(target);
  std::error_code ignored;
  try {
    for (const SimulatedFile& file : files) write_bytes(temporary / file.name, file.bytes);
    make_folder(truth_file.parent_path());
    write_bytes(truth_file, labelled_csv(write_series(truth)));
    make_folder(target);
    for (const SimulatedFile& file : files) fs::rename(temporary / file.name, target / file.name);
    fs::remove(temporary);
  } catch (const fs::filesystem_error& failed) {
    fs::remove_all(temporary, ignored);
    throw Error(
        fmt::format("{}: expected files that can be replaced, found: {}.", folder.string(), failed.code().message()));
  } catch (...) {
    fs::remove_all(temporary, ignored);
    throw;
  }
}

}  // namespace ballbar
