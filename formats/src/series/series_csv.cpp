#include "ballbar/formats/series/series_csv.hpp"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <utility>

#include "ballbar/error.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "text/cells.hpp"
#include "text/head.hpp"
#include "text/readers.hpp"
#include "text/table.hpp"
#include "text/toml_source.hpp"

namespace ballbar {
namespace {

constexpr std::string_view kFormat = "ballbar-series 1";

constexpr Key kRootKeys[] = {
    {"format", "text", "\"ballbar-series 1\"; without it the comments are prose"},
    {"title", "text", "what the series is; for people"},
    {"method", "text", "method of the drift; `drift --out` writes it"},
    {"reference_s", "s", "time of the reference row; `drift --out` writes it"},
    {"started", "text", "wall clock at `time_s` = 0, \"2026-11-22T13:05:10\"; `import` writes it"},
    {"clock", "true or false", "false: `time_s` numbers the rows, because the file has no time; default true"},
    {"columns", "tables", "what the name does not state: `[columns.NAME]`, one table per column"},
    {"five_probe", "table", "what is known of five probes"},
};
constexpr Key kColumnKeys[] = {
    {"role", "text",
     "what the column is; else the unit of its name tells: \"structure\", \"ambient\", \"coolant\", \"bearing\", "
     "\"mean_point\", \"housing\", \"speed\", \"load\", \"event\", \"measured\"; needed"},
};
constexpr Key kFiveProbeKeys[] = {
    {"spacing_mm", "mm", "distance of the planes 1 and 2, above 0; without it there is no tilt"},
    {"plane_1_from_nose_mm", "mm", "distance of plane 1 from the nose, for `--from-nose`"},
    {"resolution_um", "um", "step of a probe's reading, above 0"},
    {"linearity_percent", "%", "limit of a probe's error, percent of the reading, above 0"},
    {kProbes[0], "text", "name of the column of that probe; default X1_um"},
    {kProbes[1], "text", "default X2_um"},
    {kProbes[2], "text", "default Y1_um"},
    {kProbes[3], "text", "default Y2_um"},
    {kProbes[4], "text", "default Z_um"},
};

// A line of names that are all as a series has them: the time first, then names that end in their units.
bool is_header_of_units(std::string_view head) {
  std::string_view line = after_comments(head);
  line = line.substr(0, line.find_first_of("\r\n"));
  if (!line.starts_with("time_s,") && !line.starts_with("time_min,")) return false;
  if (line.starts_with("time_s,angle_deg")) return false;
  std::vector<std::string_view> names;
  split_cells(line, ',', names);
  return std::none_of(names.begin() + 1, names.end(), [](std::string_view name) { return unit_of(name).empty(); });
}

// Comments are TOML only where one of them is a line `# format =`; otherwise they are prose.
bool has_format_line(std::string_view toml) {
  while (!toml.empty()) {
    std::string_view line = toml.substr(0, toml.find('\n'));
    toml.remove_prefix(std::min(line.size() + 1, toml.size()));
    const auto skip_blanks = [&] { line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size())); };
    skip_blanks();
    if (!line.starts_with("format")) continue;
    line.remove_prefix(6);
    skip_blanks();
    if (line.starts_with('=')) return true;
  }
  return false;
}

struct SeriesHeader {
  std::map<std::string, Role, std::less<>> roles;  // of the columns that state one
  std::optional<FiveProbe> five_probe;
  std::optional<std::string> started;
  bool has_clock = true;
};

Role role_of(const TomlTable& column) {
  const std::optional<Role> role = role_choice(column, "role");
  if (!role) fail_missing(column, "role");
  return *role;
}

// The column whose name stands under the probe's key.
std::optional<std::string> probe_column(const TomlTable& table, std::string_view probe,
                                        const std::vector<std::string_view>& columns) {
  std::optional<std::string> column = string(table, probe);
  if (!column || std::find(columns.begin(), columns.end(), *column) != columns.end()) return column;
  const std::string nearest = columns.empty() ? "" : fmt::format("; the nearest is {}", nearest_name(*column, columns));
  fail_at_key(table, probe,
              fmt::format("expected a column of readings for {}, found {}{}.", probe, in_quotes(*column), nearest));
}

// Which column a probe's readings stand in, where the file says so, and what else it states about the probes.
FiveProbe five_probe_of(const TomlTable& table, const std::vector<std::string_view>& columns) {
  expect_keys(table, kFiveProbeKeys);
  FiveProbe probe;
  probe.spacing_mm = positive(table, "spacing_mm");
  probe.plane_1_from_nose_mm = number(table, "plane_1_from_nose_mm");
  probe.resolution_um = positive(table, "resolution_um");
  probe.linearity_percent = positive(table, "linearity_percent");
  for (std::size_t i = 0; i < kProbes.size(); ++i) {
    const std::optional<std::string> column = probe_column(table, kProbes[i], columns);
    if (!column) continue;
    probe.columns[i] = *column;
    for (std::size_t before = 0; before < i; ++before) {
      if (!has(table, kProbes[before]) || probe.columns[before] != probe.columns[i]) continue;
      fail_at_key(table, kProbes[i],
                  fmt::format("expected a column of its own for each probe, found {} for {} and {}.",
                              in_quotes(probe.columns[i]), kProbes[before], kProbes[i]));
    }
  }
  return probe;
}

SeriesHeader header_of(const TomlTable& header, const TableHead& head) {
  expect_keys(header, kRootKeys);
  const std::string_view formats[] = {kFormat};
  choice_index(header, "format", formats);
  string(header, "title");
  string(header, "method");
  number(header, "reference_s");
  SeriesHeader result;
  result.started = string(header, "started");
  result.has_clock = boolean(header, "clock").value_or(true);
  if (const auto columns = subtable(header, "columns")) {
    std::vector<std::string_view> known;
    for (const ColumnName& column : head.columns) known.push_back(column.name);
    expect_keys(*columns, known);
    for (const ColumnName& name : head.columns) {
      const auto column = subtable(*columns, name.name);
      if (!column) continue;
      expect_keys(*column, kColumnKeys);
      result.roles.emplace(name.name, role_of(*column));
    }
  }
  if (const auto five_probe = subtable(header, "five_probe")) {
    std::vector<std::string_view> columns;  // the first is the time
    for (std::size_t i = 1; i < head.columns.size(); ++i) columns.push_back(head.columns[i].name);
    result.five_probe = five_probe_of(*five_probe, columns);
  }
  return result;
}

void expect_units(const SourceText& text, const TableHead& head, const SeriesHeader& header) {
  const ColumnName& time = head.columns.front();
  if (time.name != "time_s" && time.name != "time_min") {
    fail_at(text, time.offset,
            fmt::format("expected time_s or time_min as the first column, found {}.", in_quotes(time.name)));
  }
  for (std::size_t i = 1; i < head.columns.size(); ++i) {
    const ColumnName& column = head.columns[i];
    if (column.name == "time_s" || column.name == "time_min") {
      fail_at(text, column.offset, fmt::format("expected one column of time, found {} too.", in_quotes(column.name)));
    }
    if (unit_of(column.name).empty() && !header.roles.contains(column.name)) {
      fail_at(
          text, column.offset,
          fmt::format(
              "expected a name that ends in its unit, one of _um, _mm, _urad, _degC, _rpm, _A, _W, _K, _percent, _Nm, "
              "_bar, _l_per_min, _mm_per_min, _V, or a role stated for it, found {}.",
              in_quotes(column.name)));
    }
  }
  if (head.columns.size() < 2) fail_at(text, time.offset, "expected a column besides the time, found none.");
}

std::string header_of(const FiveProbe& probe) {
  std::string out = "# [five_probe]\n";
  const auto add = [&](std::string_view key, const std::optional<double>& value) {
    if (value) out += fmt::format("# {} = {}\n", key, toml_number(*value));
  };
  add("spacing_mm", probe.spacing_mm);
  add("plane_1_from_nose_mm", probe.plane_1_from_nose_mm);
  add("resolution_um", probe.resolution_um);
  add("linearity_percent", probe.linearity_percent);
  const FiveProbe usual;
  for (std::size_t i = 0; i < kProbes.size(); ++i) {
    if (probe.columns[i] == usual.columns[i]) continue;
    out += fmt::format("# {} = {}\n", kProbes[i], toml_quoted(probe.columns[i]));
  }
  return out;
}

}  // namespace

std::vector<KeyTable> series_keys() {
  return {{"", kRootKeys}, {"`[columns.NAME]`", kColumnKeys}, {"`[five_probe]`", kFiveProbeKeys}};
}

// By its format, or by a first column of time, where angles do not tell a ballbar log.
constinit const Reader readers::kSeries = {
    .found = "a series of columns over time",
    .is_yours = [](std::string_view head) { return format_name(head) == "ballbar-series" || is_header_of_units(head); },
    .read = read_series,
};

Series read_series(std::string_view bytes, std::string_view name) {
  const SourceText text = source_text(bytes, name);
  const CommentBlock comments = comment_block(text);
  const TableHead head = table_head(text, comments.end);
  SeriesHeader header;
  if (has_format_line(comments.toml)) {
    const TomlSource source = parse_toml(comments.toml, name);
    header = header_of(root_of(source), head);
  }
  expect_units(text, head, header);
  std::vector<std::vector<double>> values = table_columns(text, head, true);
  expect_rising(text, head, 0, values.front());

  Series series;
  series.five_probe = header.five_probe;
  series.started = header.started;
  series.has_clock = header.has_clock;
  series.time_s = std::move(values.front());
  if (head.columns.front().name == "time_min") {
    for (double& time : series.time_s) time *= 60.0;
    for (const std::size_t row : {std::size_t{0}, series.time_s.size() - 1}) {
      if (!std::isfinite(series.time_s[row]))
        fail_at_cell(text, head, row, 0, "a time that a double can hold in seconds");
    }
    expect_rising(text, head, 0, series.time_s);  // neighbouring doubles may have become one
  }
  for (std::size_t i = 1; i < head.columns.size(); ++i) {
    const std::string& column = head.columns[i].name;
    const auto role = header.roles.find(column);
    series.columns.push_back(
        {column, role != header.roles.end() ? role->second : role_from_unit(unit_of(column)), std::move(values[i])});
  }
  return series;
}

std::string series_header(const Series& series) {
  std::string out = fmt::format("# format = \"{}\"\n", kFormat);
  if (series.started) out += fmt::format("# started = {}\n", toml_quoted(*series.started));
  if (!series.has_clock) out += "# clock = false\n";
  for (const Column& column : series.columns) {
    const std::string_view unit = unit_of(column.name);
    if (!unit.empty() && column.role == role_from_unit(unit)) continue;
    out += fmt::format("# [columns.{}]\n# role = \"{}\"\n", toml_key(column.name), name_of(column.role));
  }
  if (series.five_probe) out += header_of(*series.five_probe);
  out += "time_s";
  for (const Column& column : series.columns) out += "," + column.name;
  return out + "\n";
}

std::string write_rows(const Series& series, std::size_t begin, std::size_t end) {
  constexpr std::size_t kLongestCell = 26;  // -1.2345678901234567e-308 and a comma
  std::string out((end - begin) * (series.columns.size() + 1) * kLongestCell, '\0');
  char* to = out.data();
  for (std::size_t row = begin; row < end; ++row) {
    to = fmt::format_to(to, FMT_COMPILE("{}"), series.time_s[row]);
    for (const Column& column : series.columns) {
      const double value = column.values[row];
      *to++ = ',';
      if (std::isfinite(value)) to = fmt::format_to(to, FMT_COMPILE("{}"), value);
    }
    *to++ = '\n';
  }
  out.resize(static_cast<std::size_t>(to - out.data()));
  return out;
}

std::string write_series(const Series& series) {
  constexpr std::size_t kRows = 4096;
  std::string text = series_header(series);
  for (std::size_t row = 0; row < series.time_s.size(); row += kRows) {
    text += write_rows(series, row, std::min(row + kRows, series.time_s.size()));
  }
  return text;
}

void write_series(const Series& series, const std::filesystem::path& path) {
  write_through(path, [&](const std::filesystem::path& temporary) {
    write_series_parts(series, series_header(series), temporary);
  });
}

void write_series_parts(const Series& series, std::string_view header, const std::filesystem::path& path) {
  constexpr std::size_t kRows = 1024;
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file << header;
  const std::size_t rows = series.time_s.size();
  for (std::size_t row = 0; row < rows && file; row += kRows) {
    file << write_rows(series, row, std::min(row + kRows, rows));
  }
  file.close();
  if (!file) throw Error(fmt::format("{}: expected space to write {} rows, found none.", path.string(), rows));
}

}  // namespace ballbar
