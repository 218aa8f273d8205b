#include "ballbar/formats/series/profile_csv.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "text/table.hpp"

namespace ballbar {
namespace {

constexpr std::string_view kUnit = "_degC", kSigma = "_sigma_degC";

std::string without(std::string_view name, std::string_view ending) {
  return std::string(name.substr(0, name.size() - ending.size()));
}

}  // namespace

std::vector<NamedProfile> read_profiles(std::string_view bytes, std::string_view name) {
  const SourceText text = source_text(bytes, name);
  const TableHead head = table_head(text, comment_block(text).end);
  const auto fail_name = [&](const ColumnName& column, std::string_view expected) {
    fail_at(text, column.offset, fmt::format("expected {}, found {}.", expected, in_quotes(column.name)));
  };
  if (head.columns.front().name != "x_mm") fail_name(head.columns.front(), "x_mm as the first column");
  if (head.columns.size() < 2) fail_at(text, head.body, "expected a column of temperatures after x_mm, found none.");
  for (const ColumnName& column : head.columns) {
    if (&column == &head.columns.front()) continue;
    if (!column.name.ends_with(kUnit)) fail_name(column, "a column of temperatures, whose name ends in _degC");
  }
  const std::vector<std::vector<double>> values = table_columns(text, head, false);
  expect_rising(text, head, 0, values[0]);
  if (values[0].size() < 2) fail_at(text, text.bytes.size(), "expected at least two rows, found one.");

  std::vector<NamedProfile> profiles;
  for (std::size_t i = 1; i < values.size(); ++i) {
    if (head.columns[i].name.ends_with(kSigma)) continue;
    profiles.push_back({head.columns[i].name, {values[0], values[i], {}}});
  }
  for (std::size_t i = 1; i < values.size(); ++i) {
    if (!head.columns[i].name.ends_with(kSigma)) continue;
    const std::string of = without(head.columns[i].name, kSigma) + std::string(kUnit);
    const auto found =
        std::find_if(profiles.begin(), profiles.end(), [&](const NamedProfile& p) { return p.name == of; });
    if (found == profiles.end()) fail_name(head.columns[i], fmt::format("a column {} that this is the sigma of", of));
    for (std::size_t row = 0; row < values[i].size(); ++row) {
      if (values[i][row] < 0.0) fail_at_cell(text, head, row, i, "a standard uncertainty of 0 or more");
    }
    found->profile.sigma_degC = values[i];
  }
  return profiles;
}

std::string write_profiles(const std::vector<NamedProfile>& profiles) {
  std::string text = "x_mm";
  for (const NamedProfile& named : profiles) {
    text += "," + named.name;
    if (!named.profile.sigma_degC.empty()) text += "," + without(named.name, kUnit) + std::string(kSigma);
  }
  for (const double x_mm : profiles.front().profile.x_mm) {
    text += fmt::format("\n{}", x_mm);
    for (const NamedProfile& named : profiles) {
      text += fmt::format(",{}", temperature_at(named.profile, x_mm));
      if (!named.profile.sigma_degC.empty()) text += fmt::format(",{}", sigma_at(named.profile, x_mm));
    }
  }
  return text + "\n";
}

}  // namespace ballbar
