#include <fmt/format.h>
#include <zip.h>

#include <algorithm>
#include <charconv>
#include <cstring>
#include <memory>
#include <optional>
#include <pugixml.hpp>
#include <vector>

#include "ballbar/error.hpp"
#include "ballbar/internal/nearest_name.hpp"
#include "logs/log_sources.hpp"
#include "logs/number_format.hpp"
#include "text/zip_part.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kLargestPart = std::size_t{256} << 20;  // unpacked
constexpr std::size_t kMostRows = 1048576;

using Archive = std::unique_ptr<zip_t, decltype(&zip_discard)>;

Archive opened(std::string_view bytes, const std::string& name) {
  zip_error_t error;
  zip_error_init(&error);
  zip_source_t* const source = zip_source_buffer_create(bytes.data(), bytes.size(), 0, &error);
  zip_t* const archive = source == nullptr ? nullptr : zip_open_from_source(source, ZIP_RDONLY, &error);
  zip_error_fini(&error);
  if (archive != nullptr) return {archive, &zip_discard};
  if (source != nullptr) zip_source_free(source);
  throw Error(fmt::format("{}:1: expected a whole workbook (.xlsx), found a damaged archive.", name));
}

// A part of the workbook, unpacked; nullopt where there is none of that name.
std::optional<std::string> part_of(zip_t* archive, const std::string& part, const std::string& name) {
  const zip_int64_t index = zip_name_locate(archive, part.c_str(), ZIP_FL_NOCASE);
  if (index < 0) return std::nullopt;
  ZipPart unzipped = unpacked(archive, static_cast<zip_uint64_t>(index), kLargestPart);
  switch (unzipped.outcome) {
    case Unpacking::whole:
      return std::move(unzipped.bytes);
    case Unpacking::locked:
      throw Error(
          fmt::format("{}:1: expected a part {} that can be unpacked, found one that cannot.", name, in_quotes(part)));
    case Unpacking::damaged:
      throw Error(fmt::format("{}:1: expected a whole part {}, found a damaged one.", name, in_quotes(part)));
    case Unpacking::too_large:
      break;
  }
  throw Error(fmt::format(
      "{}:1: expected parts of at most 256 MiB when unpacked, found a larger one, {}; export the sheet as text.", name,
      in_quotes(part)));
}

void parse(std::string& text, const std::string& part, const std::string& name, pugi::xml_document& document) {
  const pugi::xml_parse_result result =
      document.load_buffer_inplace(text.data(), text.size(), pugi::parse_default | pugi::parse_ws_pcdata_single);
  if (!result)
    throw Error(
        fmt::format("{}:1: expected XML in the part {}, found: {}.", name, in_quotes(part), result.description()));
}

// Without the prefix of its name space.
std::string_view local(const char* name) {
  const std::string_view text(name);
  const std::size_t colon = text.find(':');
  return colon == std::string_view::npos ? text : text.substr(colon + 1);
}

pugi::xml_node child(pugi::xml_node parent, std::string_view name) {
  for (const pugi::xml_node node : parent.children()) {
    if (local(node.name()) == name) return node;
  }
  return {};
}

const char* attribute(pugi::xml_node node, std::string_view name) {
  for (const pugi::xml_attribute one : node.attributes()) {
    if (local(one.name()) == name) return one.value();
  }
  return "";
}

// All text of <t> below, without that of phonetic hints.
void append_text(pugi::xml_node node, std::string& to) {
  for (const pugi::xml_node below : node.children()) {
    const std::string_view name = local(below.name());
    if (name == "t")
      to += below.text().get();
    else if (name == "r")
      append_text(below, to);
  }
}

std::vector<std::string> shared_strings(zip_t* archive, const std::string& name) {
  std::vector<std::string> strings;
  auto text = part_of(archive, "xl/sharedStrings.xml", name);
  if (!text) return strings;
  pugi::xml_document document;
  parse(*text, "xl/sharedStrings.xml", name, document);
  for (const pugi::xml_node node : child(document, "sst").children()) {
    if (local(node.name()) != "si") continue;
    strings.emplace_back();
    append_text(node, strings.back());
  }
  return strings;
}

// Of every style of cells, by its number.
std::vector<NumberFormat> styles(zip_t* archive, const std::string& name) {
  std::vector<NumberFormat> formats;
  auto text = part_of(archive, "xl/styles.xml", name);
  if (!text) return formats;
  pugi::xml_document document;
  parse(*text, "xl/styles.xml", name, document);
  const pugi::xml_node sheet = child(document, "styleSheet");
  std::vector<std::pair<int, NumberFormat>> own;
  for (const pugi::xml_node node : child(sheet, "numFmts").children()) {
    own.emplace_back(std::atoi(attribute(node, "numFmtId")), number_format(attribute(node, "formatCode")));
  }
  for (const pugi::xml_node node : child(sheet, "cellXfs").children()) {
    const int id = std::atoi(attribute(node, "numFmtId"));
    const auto found = std::find_if(own.begin(), own.end(), [&](const auto& one) { return one.first == id; });
    formats.push_back(found != own.end() ? found->second : built_in_number_format(id));
  }
  return formats;
}

struct Sheet {
  std::string name, part;
};

struct Workbook {
  std::vector<Sheet> sheets;
  bool since_1904 = false;
};

// Sheets in their order, with the parts of the archive that hold them.
Workbook workbook_of(zip_t* archive, const std::string& name) {
  auto text = part_of(archive, "xl/workbook.xml", name);
  if (!text) throw Error(fmt::format("{}:1: expected a workbook (.xlsx), found another zip archive.", name));
  pugi::xml_document document;
  parse(*text, "xl/workbook.xml", name, document);
  pugi::xml_document relations;
  auto links = part_of(archive, "xl/_rels/workbook.xml.rels", name);
  if (links) parse(*links, "xl/_rels/workbook.xml.rels", name, relations);
  Workbook workbook;
  const pugi::xml_node root = child(document, "workbook");
  const std::string_view from = attribute(child(root, "workbookPr"), "date1904");
  workbook.since_1904 = from == "1" || from == "true";
  for (const pugi::xml_node node : child(root, "sheets").children()) {
    const std::string_view id = attribute(node, "id");
    std::string part;
    for (const pugi::xml_node link : child(relations, "Relationships").children()) {
      if (id == attribute(link, "Id") && std::string_view(attribute(link, "TargetMode")) != "External")
        part = attribute(link, "Target");
    }
    if (part.empty()) part = fmt::format("worksheets/sheet{}.xml", workbook.sheets.size() + 1);
    workbook.sheets.push_back({attribute(node, "name"), part.starts_with('/') ? part.substr(1) : "xl/" + part});
  }
  if (workbook.sheets.empty()) throw Error(fmt::format("{}:1: expected a workbook with a sheet, found none.", name));
  return workbook;
}

const Sheet& chosen(const Workbook& workbook, const std::string& sheet_name, const std::string& name) {
  std::vector<std::string_view> known;
  for (const Sheet& sheet : workbook.sheets) {
    if (sheet.name == sheet_name) return sheet;
    known.emplace_back(sheet.name);
  }
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(sheet_name.data(), sheet_name.data() + sheet_name.size(), number);
  const bool whole = error == std::errc{} && end == sheet_name.data() + sheet_name.size();
  if (whole && number >= 1 && number <= workbook.sheets.size()) return workbook.sheets[number - 1];
  throw Error(fmt::format("{}:1: expected a sheet {}, found {} sheets; the nearest is {}.", name, in_quotes(sheet_name),
                          workbook.sheets.size(), in_quotes(nearest_name(sheet_name, known))));
}

// "AB12" -> 27; nullopt where it is no place of a cell.
std::optional<std::size_t> column_of(std::string_view place) {
  std::size_t column = 0, letters = 0;
  while (letters < place.size() && place[letters] >= 'A' && place[letters] <= 'Z' && letters < 4) {
    column = column * 26 + static_cast<std::size_t>(place[letters] - 'A') + 1;
    ++letters;
  }
  if (letters == 0 || letters == 4) return std::nullopt;
  return column - 1;
}

std::string shown(pugi::xml_node cell, const std::vector<std::string>& strings,
                  const std::vector<NumberFormat>& formats, bool since_1904) {
  const std::string_view type = attribute(cell, "t");
  const char* const value = child(cell, "v").text().get();
  if (type == "s") {
    const long index = std::strtol(value, nullptr, 10);
    return index >= 0 && static_cast<std::size_t>(index) < strings.size()
               ? as_cell(strings[static_cast<std::size_t>(index)])
               : std::string();
  }
  if (type == "inlineStr") {
    std::string text;
    append_text(child(cell, "is"), text);
    return as_cell(text);
  }
  if (!type.empty() && type != "n") return as_cell(value);  // str, e, b, d
  const std::size_t style = std::strtoul(attribute(cell, "s"), nullptr, 10);
  const NumberFormat format = style < formats.size() ? formats[style] : NumberFormat::plain;
  if (format == NumberFormat::plain || *value == '\0') return as_cell(value);
  char* end = nullptr;
  const double number = std::strtod(value, &end);
  if (*end != '\0') return as_cell(value);
  if (format == NumberFormat::percent) return fmt::format("{:.15g}", number * 100.0);
  std::string days = shown_days(number, format, since_1904);
  return days.empty() ? as_cell(value) : days;
}

// A workbook with what all its sheets share.
struct OpenWorkbook {
  OpenWorkbook(std::string_view bytes, const std::string& file)
      : name(file),
        archive(opened(bytes, file)),
        workbook(workbook_of(archive.get(), file)),
        strings(shared_strings(archive.get(), file)),
        formats(styles(archive.get(), file)) {}

  std::string name;
  Archive archive;
  Workbook workbook;
  std::vector<std::string> strings;
  std::vector<NumberFormat> formats;
};

TableText text_of(const OpenWorkbook& from, const Sheet& taken) {
  auto xml = part_of(from.archive.get(), taken.part, from.name);
  if (!xml)
    throw Error(fmt::format("{}:1: expected the sheet {}, found no part {} that holds it.", from.name,
                            in_quotes(taken.name), in_quotes(taken.part)));
  pugi::xml_document document;
  parse(*xml, taken.part, from.name, document);

  TableText table;
  table.name = from.name;
  table.shape = fmt::format("a workbook, sheet {}", in_quotes(taken.name));
  table.sheet = taken.name;
  for (const Sheet& sheet : from.workbook.sheets) table.sheets.push_back(sheet.name);
  std::size_t line = 0;
  for (const pugi::xml_node row : child(child(document, "worksheet"), "sheetData").children()) {
    if (local(row.name()) != "row") continue;
    std::size_t number = std::strtoul(attribute(row, "r"), nullptr, 10);
    if (number == 0) number = line + 1;
    if (number <= line || number > kMostRows) {
      throw Error(fmt::format("{}:{}: expected rows in their order, at most {}, found row {}.", table.name, line + 1,
                              kMostRows, number));
    }
    for (; line + 1 < number; ++line) table.text += '\n';
    std::size_t column = 0;
    bool first = true;
    for (const pugi::xml_node cell : row.children()) {
      if (local(cell.name()) != "c") continue;
      const std::size_t place = column_of(attribute(cell, "r")).value_or(first ? 0 : column + 1);
      if (place >= kMostColumns || (!first && place <= column)) {
        throw Error(fmt::format("{}:{}: expected cells in their order, at most {} columns, found another place, {}.",
                                table.name, number, kMostColumns, in_quotes(attribute(cell, "r"))));
      }
      for (std::size_t k = first ? 0 : column; k < place; ++k) table.text += '\t';
      table.text += shown(cell, from.strings, from.formats, from.workbook.since_1904);
      column = place;
      first = false;
    }
    table.text += '\n';
    ++line;
    if (table.text.size() > 4 * kLargestPart) {
      throw Error(fmt::format("{}:{}: expected a sheet of at most 1 GiB, found more.", table.name, number));
    }
  }
  return table;
}

}  // namespace

TableText workbook_table(std::string_view bytes, const std::string& name, const std::string& sheet) {
  const OpenWorkbook from(bytes, name);
  return text_of(from, chosen(from.workbook, sheet, name));
}

std::vector<TableText> workbook_tables(std::string_view bytes, const std::string& name) {
  const OpenWorkbook from(bytes, name);
  std::vector<TableText> tables;
  for (const Sheet& one : from.workbook.sheets) tables.push_back(text_of(from, one));
  return tables;
}

}  // namespace ballbar
