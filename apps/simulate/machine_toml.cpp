#include "simulate/machine_toml.hpp"

#include <fmt/format.h>

#include <array>

#include "simulate/spindle_toml.hpp"
#include "text/toml_source.hpp"

namespace ballbar {
namespace {

constexpr std::string_view kFormat = "ballbar-machine 1";

constexpr Key kRootKeys[] = {
    {"format", "text", "\"ballbar-machine 1\"; needed"},
    {"method", "text", "\"two_arcs\", the default, \"spindle_rotation\", \"circles\", or \"series\": no ballbar"},
    {"title", "text", "of the session"},
    {"seed", "number", "of the noise; default 1; `--seed` goes before it"},
    {"started", "date and time", "the machine's clock at time 0, 2015-03-02T09:00:00; `.b5r` files need it"},
    {"test_min", "min, list", "when the tests begin, rising; default: one at 0"},
    {"feed_mm_per_min", "mm/min", "feed on the path; default 1000"},
    {"plane", "text", "`circles`: \"XY\", the default, \"YZ\" or \"ZX\""},
    {"height_offset_mm", "mm", "height of the moving ball over the fixed one; default 0"},
    {"spindle_above", "true or false", "`spindle_rotation`: as in session.toml; default true"},
    {"bar", "table", "the bar and its noise"},
    {"setup", "table", "set-up errors, the same in all tests"},
    {"c_arc", "table", "`two_arcs`: the arc about C; default 90 to 450 deg, 1500 readings"},
    {"a_arc", "table", "`two_arcs`: the arc about A; default -20 to 80 deg, 800 readings"},
    {"circle", "table", "the circle of the other methods; default 0 to 360 deg, 1500 readings"},
    {"axial", "table", "`spindle_rotation`: the axial recording"},
    {"truth", "table or tables",
     "the true drift: lists of one size in `[truth]`, or a point a `[[truth]]`; default: none"},
    {"signals", "table", "what all signals have in common"},
    {"signal", "tables", "a signal each"},
    {"five_probe", "table", "five probes on a bar; without it there are none"},
    {"spindle", "table", "a motor spindle of finite volumes in the place of the truth"},
};
constexpr Key kBarKeys[] = {
    {"nominal_length_mm", "mm", "default 100"},
    {"radius_error_um", "um", "the path's radius less the nominal length; default 0"},
    {"noise_um", "um", "standard deviation of a reading; default 0.2"},
    {"autocorrelation", "1", "of that noise from reading to reading, from 0 to below 1; default 0"},
    {"resolution_um", "um", "lengths are multiples of it, 0: not rounded; default 0.1"},
    {"outlier_share", "1", "probability that a reading is off; default 0"},
    {"outlier_um", "um", "by so much; default 0"},
};
constexpr Key kSetupKeys[] = {
    {"x_um", "um", "signs as the truth; default 0"},
    {"y_um", "um", "default 0"},
    {"z_um", "um", "default 0"},
    {"run_out_um", "um", "`spindle_rotation`: eccentricity; default 0"},
};
constexpr Key kArcKeys[] = {
    {"start_deg", "deg", "first angle"},
    {"end_deg", "deg", "last angle; below the first it is clockwise"},
    {"readings", "number", "uniform in angle"},
};
constexpr Key kCircleKeys[] = {
    {"start_deg", "deg", "first angle"},
    {"end_deg", "deg", "last angle; below the first it is clockwise"},
    {"readings", "number", "uniform in angle"},
    {"harmonic2_um", "um", "`circles`: axis A too long and B too short by this over the radius; default 0"},
    {"backlash_a_um", "um", "`circles`: play of axis A; default 0"},
};
constexpr Key kAxialKeys[] = {
    {"readings", "number", "of a test; 0, the default: one length a test"},
    {"interval_s", "s", "from reading to reading; default 0.01"},
    {"offset_um", "um", "the bar's length without elongation less the nominal one; default 0"},
};
constexpr Key kTruthKeys[] = {
    {"time_min", "min", "rising; straight lines between; needed"},
    {"x_um", "um", "spindle relative to the table; default 0"},
    {"y_um", "um", "default 0"},
    {"z_um", "um", "`spindle_rotation`: elongation towards the table; default 0"},
    {"along_bar_um", "um", "`spindle_rotation`: the spindle's axis away from the table's ball; default 0"},
};
constexpr Key kSignalsKeys[] = {
    {"interval_s", "s", "from row to row; default 10"},
};
constexpr Key kSignalKeys[] = {
    {"name", "text", "of the column; ends in its unit; needed"},
    {"role", "text", "as in a series; default: by the unit"},
    {"time_min", "min, list", "of the points; straight lines between them, held beyond; needed"},
    {"value", "list", "at these times, in the unit of the name; needed"},
    {"noise", "its unit", "standard deviation; default 0"},
    {"resolution", "its unit", "0, the default: not rounded"},
};
constexpr Key kFiveProbeKeys[] = {
    {"spacing_mm", "mm", "distance of the planes 1 and 2; default 60"},
    {"interval_s", "s", "from row to row; default 60"},
    {"noise_um", "um", "standard deviation of a reading; default 0.1"},
    {"resolution_um", "um", "step of a reading; default 0.05"},
    {"tilt_a_urad_per_um", "urad/um", "tilt about X for each um of y; default 0"},
    {"tilt_b_urad_per_um", "urad/um", "tilt about Y for each um of x; default 0"},
    {"ball_offset_mm", "mm", "where along the bar the ball is, from plane 1 towards plane 2; default 0"},
};

void take_count(std::size_t& value, const TomlTable& table, std::string_view key) {
  const std::optional<std::int64_t> read = integer(table, key);
  if (!read) return;
  if (*read < 0) fail_at_key(table, key, fmt::format("expected a count not below 0 for {}, found {}.", key, *read));
  value = static_cast<std::size_t>(*read);
}

std::vector<double> s_from_min(std::vector<double> times) {
  for (double& time : times) time *= 60.0;
  return times;
}

void read_bar(const TomlTable& table, VirtualBar& bar) {
  expect_keys(table, kBarKeys);
  take(bar.nominal_length_mm, positive(table, "nominal_length_mm"));
  take(bar.radius_error_um, number(table, "radius_error_um"));
  take(bar.noise_um, number(table, "noise_um"));
  take(bar.autocorrelation, number(table, "autocorrelation"));
  take(bar.resolution_um, number(table, "resolution_um"));
  take(bar.outlier_share, number(table, "outlier_share"));
  take(bar.outlier_um, number(table, "outlier_um"));
}

void read_setup(const TomlTable& table, VirtualMachine& machine) {
  expect_keys(table, kSetupKeys);
  take(machine.setup_x_um, number(table, "x_um"));
  take(machine.setup_y_um, number(table, "y_um"));
  take(machine.setup_z_um, number(table, "z_um"));
  take(machine.run_out_um, number(table, "run_out_um"));
}

void read_sweep(const TomlTable& table, Sweep& sweep) {
  take(sweep.start_deg, number(table, "start_deg"));
  take(sweep.end_deg, number(table, "end_deg"));
  take_count(sweep.readings, table, "readings");
}

void read_arc(const TomlTable& table, Sweep& sweep) {
  expect_keys(table, kArcKeys);
  read_sweep(table, sweep);
}

void read_circle(const TomlTable& table, VirtualMachine& machine) {
  expect_keys(table, kCircleKeys);
  read_sweep(table, machine.circle);
  take(machine.harmonic2_um, number(table, "harmonic2_um"));
  take(machine.backlash_a_um, number(table, "backlash_a_um"));
}

void read_axial(const TomlTable& table, VirtualAxial& axial) {
  expect_keys(table, kAxialKeys);
  take_count(axial.readings, table, "readings");
  take(axial.interval_s, positive(table, "interval_s"));
  take(axial.offset_um, number(table, "offset_um"));
}

struct Component {
  std::string_view key;
  double TruePosition::*member;
};
constexpr Component kComponents[] = {{"x_um", &TruePosition::x_um},
                                     {"y_um", &TruePosition::y_um},
                                     {"z_um", &TruePosition::z_um},
                                     {"along_bar_um", &TruePosition::along_bar_um}};

std::vector<TruePosition> truth_from_arrays(const TomlTable& table) {
  expect_keys(table, kTruthKeys);
  std::vector<TruePosition> truth;
  for (const double time_s : s_from_min(required(numbers, table, "time_min"))) truth.push_back({.time_s = time_s});
  for (const auto& [key, member] : kComponents) {
    const std::optional<std::vector<double>> values = numbers(table, key);
    if (!values) continue;
    if (values->size() != truth.size()) {
      fail_at_key(table, key,
                  fmt::format("expected as many values for {} as for time_min, {}, found {}.", key, truth.size(),
                              values->size()));
    }
    for (std::size_t i = 0; i < truth.size(); ++i) truth[i].*member = (*values)[i];
  }
  return truth;
}

TruePosition truth_point(const TomlTable& table) {
  expect_keys(table, kTruthKeys);
  TruePosition point;
  point.time_s = required(number, table, "time_min") * 60.0;
  for (const auto& [key, member] : kComponents) take(point.*member, number(table, key));
  return point;
}

std::vector<TruePosition> read_truth(const TomlTable& root) {
  if (!has(root, "truth")) return {TruePosition{}};
  if (root.table->get("truth")->is_table()) return truth_from_arrays(*subtable(root, "truth"));
  std::vector<TruePosition> truth;
  for (const TomlTable& table : subtables(root, "truth")) truth.push_back(truth_point(table));
  return truth;
}

VirtualSignal read_signal(const TomlTable& table) {
  expect_keys(table, kSignalKeys);
  VirtualSignal signal;
  signal.name = required(string, table, "name");
  signal.role = role_from_unit(unit_of(signal.name));
  take(signal.role, role_choice(table, "role"));
  signal.time_s = s_from_min(required(numbers, table, "time_min"));
  signal.value = required(numbers, table, "value");
  if (signal.time_s.size() != signal.value.size()) {
    fail_at_key(table, "value",
                fmt::format("expected as many values as for time_min, {}, found {}.", signal.time_s.size(),
                            signal.value.size()));
  }
  take(signal.noise, number(table, "noise"));
  take(signal.resolution, number(table, "resolution"));
  return signal;
}

VirtualFiveProbe read_five_probe(const TomlTable& table) {
  expect_keys(table, kFiveProbeKeys);
  VirtualFiveProbe probe;
  probe.present = true;
  take(probe.spacing_mm, positive(table, "spacing_mm"));
  take(probe.interval_s, positive(table, "interval_s"));
  take(probe.noise_um, number(table, "noise_um"));
  take(probe.resolution_um, number(table, "resolution_um"));
  take(probe.tilt_a_urad_per_um, number(table, "tilt_a_urad_per_um"));
  take(probe.tilt_b_urad_per_um, number(table, "tilt_b_urad_per_um"));
  take(probe.ball_offset_mm, number(table, "ball_offset_mm"));
  return probe;
}

// The three methods of a session, or the spindle's series alone.
void read_method(const TomlTable& root, VirtualMachine& machine) {
  constexpr std::array kSessions{Method::two_arcs, Method::spindle_rotation, Method::circles};
  const std::array names{name_of(kSessions[0]), name_of(kSessions[1]), name_of(kSessions[2]),
                         std::string_view("series")};
  const std::optional<std::size_t> index = choice_index(root, "method", names);
  if (!index) return;
  machine.series = *index == kSessions.size();
  if (!machine.series) {
    machine.method = kSessions[*index];
    return;
  }
  for (const std::string_view key :
       {"started", "test_min", "feed_mm_per_min", "plane", "height_offset_mm", "spindle_above", "bar", "setup", "c_arc",
        "a_arc", "circle", "axial", "truth", "signals", "signal", "five_probe"}) {
    if (!has(root, key)) continue;
    fail_at_key(root, key,
                fmt::format("expected nothing but title, seed and [spindle] beside method = \"series\", which has no "
                            "ballbar, found {}.",
                            key));
  }
}

void read_root(const TomlTable& root, VirtualMachine& machine) {
  if (const std::string format = required(string, root, "format"); format != kFormat) {
    fail_at_key(root, "format", fmt::format("expected format = \"{}\", found \"{}\".", kFormat, format));
  }
  expect_keys(root, kRootKeys);
  read_method(root, machine);
  take(machine.title, string(root, "title"));
  std::size_t seed = machine.seed;
  take_count(seed, root, "seed");
  machine.seed = seed;
  machine.started_s = local_time_s(root, "started");
  machine.test_s = {0.0};
  if (std::optional<std::vector<double>> test_min = numbers(root, "test_min")) machine.test_s = s_from_min(*test_min);
  take(machine.feed_mm_per_min, positive(root, "feed_mm_per_min"));
  take(machine.plane, choice(root, "plane", {Plane::XY, Plane::YZ, Plane::ZX}));
  take(machine.height_offset_mm, number(root, "height_offset_mm"));
  take(machine.spindle_above, boolean(root, "spindle_above"));
}

}  // namespace

std::vector<KeyTable> machine_keys() {
  return {{"", kRootKeys},
          {"`[bar]`", kBarKeys},
          {"`[setup]`", kSetupKeys},
          {"`[c_arc]`, `[a_arc]`", kArcKeys},
          {"`[circle]`", kCircleKeys},
          {"`[axial]`", kAxialKeys},
          {"`[truth]`, `[[truth]]`", kTruthKeys},
          {"`[signals]`", kSignalsKeys},
          {"`[[signal]]`", kSignalKeys},
          {"`[five_probe]`", kFiveProbeKeys}};
}

VirtualMachine read_machine(std::string_view bytes, std::string_view name) {
  const TomlSource source = parse_toml(bytes, name);
  const TomlTable root = root_of(source);
  VirtualMachine machine;
  machine.name = name;
  read_root(root, machine);
  if (const auto table = subtable(root, "bar")) read_bar(*table, machine.bar);
  if (const auto table = subtable(root, "setup")) read_setup(*table, machine);
  if (const auto table = subtable(root, "c_arc")) read_arc(*table, machine.c_arc);
  if (const auto table = subtable(root, "a_arc")) read_arc(*table, machine.a_arc);
  if (const auto table = subtable(root, "circle")) read_circle(*table, machine);
  if (const auto table = subtable(root, "axial")) read_axial(*table, machine.axial);
  if (const auto table = subtable(root, "spindle")) {
    if (has(root, "truth")) fail_at_key(root, "truth", "expected the truth from [spindle] alone, found truth as well.");
    const auto last_test_s = machine.series ? std::nullopt : std::optional(machine.test_s.back());
    machine.spindle = read_spindle(*table, last_test_s);
  } else {
    if (machine.series) fail_missing(root, "spindle");
    machine.truth = read_truth(root);
  }
  if (const auto table = subtable(root, "signals")) {
    expect_keys(*table, kSignalsKeys);
    take(machine.interval_s, positive(*table, "interval_s"));
  }
  for (const TomlTable& table : subtables(root, "signal")) machine.signals.push_back(read_signal(table));
  if (const auto table = subtable(root, "five_probe")) machine.five_probe = read_five_probe(*table);
  return machine;
}

}  // namespace ballbar
