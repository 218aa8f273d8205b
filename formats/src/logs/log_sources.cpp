#include "logs/log_sources.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include "ballbar/error.hpp"
#include "logs/log_shape.hpp"
#include "text/json_source.hpp"

namespace ballbar {
namespace {

bool is_workbook(std::string_view head) { return head.starts_with("PK\x03\x04"); }  // a zip archive

bool is_mat_file(std::string_view head) {
  return head.starts_with("MATLAB 5.0 MAT-file") || head.starts_with("MATLAB 7.3 MAT-file");
}

bool is_json(std::string_view head) {
  if (head.starts_with("\xEF\xBB\xBF")) head.remove_prefix(3);
  const std::size_t first = head.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return false;
  if (head[first] == '[') {  // [m] of a header is none
    const std::size_t next = head.find_first_not_of(" \t\r\n", first + 1);
    return next != std::string_view::npos && (head[next] == '{' || head[next] == '[');
  }
  if (head[first] != '{') return false;
  const std::size_t next = head.find_first_not_of(" \t\r\n", first + 1);
  return next != std::string_view::npos && head[next] == '"';
}

std::string cell_of(const nlohmann::json& value) {
  if (value.is_number()) return value.dump();
  if (value.is_boolean()) return value.get<bool>() ? "1" : "0";
  if (!value.is_string()) return {};
  return as_cell(value.get_ref<const std::string&>());
}

bool is_flat(const nlohmann::json& value) { return !value.is_array() && !value.is_object(); }

// [{"time_s": 0, "x_um": 1}, ...]
bool is_rows(const nlohmann::json& value) {
  return value.is_array() && value.size() > 1 &&
         std::all_of(value.begin(), value.end(), [](const auto& row) { return row.is_object() && !row.empty(); });
}

// {"time_s": [0, 1], "x_um": [1, 2], ...}; other members are of no length and left out.
bool is_columns(const nlohmann::json& value) {
  if (!value.is_object()) return false;
  std::size_t arrays = 0;
  for (const auto& [key, member] : value.items()) {
    arrays += member.is_array() && member.size() > 1 && std::all_of(member.begin(), member.end(), is_flat);
  }
  return arrays > 1;
}

std::string text_of_rows(const nlohmann::json& rows) {
  std::set<std::string> known;
  std::vector<std::string> keys;
  for (const auto& row : rows) {
    for (const auto& [key, member] : row.items()) {
      if (is_flat(member) && known.insert(key).second) keys.push_back(key);
    }
  }
  std::string text;
  for (const std::string& key : keys) text += (text.empty() ? "" : "\t") + as_cell(key);
  for (const auto& row : rows) {
    text += '\n';
    for (const std::string& key : keys) {
      if (&key != &keys.front()) text += '\t';
      const auto member = row.find(key);
      if (member != row.end()) text += cell_of(*member);
    }
  }
  return text + "\n";
}

std::string text_of_columns(const nlohmann::json& columns) {
  std::size_t rows = 0;
  std::vector<const nlohmann::json*> members;
  std::string text;
  for (const auto& [key, member] : columns.items()) {
    if (!member.is_array() || !std::all_of(member.begin(), member.end(), is_flat)) continue;
    rows = std::max(rows, member.size());
    text += (members.empty() ? "" : "\t") + as_cell(key);
    members.push_back(&member);
  }
  for (std::size_t row = 0; row < rows; ++row) {
    text += '\n';
    for (const nlohmann::json* member : members) {
      if (member != members.front()) text += '\t';
      if (row < member->size()) text += cell_of((*member)[row]);
    }
  }
  return text + "\n";
}

// The first table in it, outermost first.
const nlohmann::json* table_in(const nlohmann::json& value, int depth, std::string& path) {
  if (is_rows(value) || is_columns(value)) return &value;
  if (!value.is_object() || depth == 0) return nullptr;
  for (const auto& [key, member] : value.items()) {
    std::string below = path.empty() ? key : path + "." + key;
    if (const nlohmann::json* const found = table_in(member, depth - 1, below)) {
      path = below;
      return found;
    }
  }
  return nullptr;
}

// One object a line, as databases and brokers write them, as one array; anything else as it is.
std::string as_array(std::string_view bytes) {
  std::string text;
  std::size_t rows = 0;
  for (std::size_t begin = 0; begin < bytes.size();) {
    const std::size_t end = std::min(bytes.find('\n', begin), bytes.size());
    const std::string_view line = trimmed(bytes.substr(begin, end - begin), " \t\r");
    begin = end + 1;
    if (line.empty()) continue;
    if (!line.starts_with('{') || !line.ends_with('}')) return std::string(bytes);
    text += (rows++ == 0 ? "[" : ",\n") + std::string(line);
  }
  return rows > 1 ? text + "]" : std::string(bytes);
}

TableText json_table(std::string_view bytes, const std::string& name) {
  const JsonSource source = parse_json(as_array(bytes), name);
  std::string path;
  const nlohmann::json* const table = table_in(source.root, 2, path);
  if (table == nullptr) {
    throw Error(
        fmt::format("{}:1: expected JSON with rows, [{{\"time_s\": 0, ...}}, ...], or columns, {{\"time_s\": [0, ...], "
                    "...}}, found "
                    "neither.",
                    name));
  }
  TableText text;
  text.text = table->is_array() ? text_of_rows(*table) : text_of_columns(*table);
  text.name = path.empty() ? name : fmt::format("{}[{}]", name, path);
  text.shape = path.empty() ? "JSON" : fmt::format("JSON, \"{}\"", path);
  return text;
}

using Groups = std::vector<std::pair<std::vector<std::string>, std::vector<std::size_t>>>;

// Places of the tables by the names of their columns, the most with the same names first.
Groups by_names(const std::vector<TableText>& tables) {
  LogRecipe tabs;
  tabs.delimiter = '\t';
  tabs.time = "none";
  Groups groups;
  for (std::size_t k = 0; k < tables.size(); ++k) {
    if (!holds_table(std::string_view(tables[k].text).substr(0, kHeadBytes))) continue;
    const LogShape shape = log_shape(Source::of_text(tables[k].name, tables[k].text), tabs);
    auto group =
        std::find_if(groups.begin(), groups.end(), [&](const auto& one) { return one.first == shape.headers; });
    if (group == groups.end()) group = groups.insert(groups.end(), {shape.headers, {}});
    group->second.push_back(k);
  }
  std::stable_sort(groups.begin(), groups.end(),
                   [](const auto& a, const auto& b) { return a.second.size() > b.second.size(); });
  return groups;
}

}  // namespace

std::string as_cell(std::string_view text) {
  std::string cell(text);
  std::replace_if(
      cell.begin(), cell.end(), [](char c) { return c == '\t' || c == '\n' || c == '\r' || c == '"'; }, ' ');
  return cell;
}

bool is_table_file(std::string_view head) { return is_workbook(head) || is_mat_file(head) || is_json(head); }

WorkbookSheets workbook_sheets(std::string_view bytes, const std::string& name) {
  WorkbookSheets sheets;
  if (!is_workbook(bytes.substr(0, 512))) return sheets;
  const std::vector<TableText> tables = workbook_tables(bytes, name);
  for (const auto& [names, places] : by_names(tables)) {
    std::vector<std::string>& to = sheets.alike.empty() ? sheets.alike : sheets.others;
    for (const std::size_t k : places) to.push_back(tables[k].sheet);
  }
  return sheets;
}

std::optional<TableText> table_text(std::string_view bytes, const std::string& name, const LogRecipe& recipe) {
  const std::string_view head = bytes.substr(0, 512);
  if (is_workbook(head) && !recipe.sheet.empty()) return workbook_table(bytes, name, recipe.sheet);
  if (is_workbook(head)) {
    std::vector<TableText> tables = workbook_tables(bytes, name);
    const Groups groups = by_names(tables);
    return std::move(tables[groups.empty() ? 0 : groups.front().second.front()]);
  }
  if (is_mat_file(head)) return mat_table(bytes, name);
  if (is_json(head)) return json_table(bytes, name);
  return std::nullopt;
}

}  // namespace ballbar
