#include "ballbar/formats/models/runs_csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "ballbar/formats/text/file_bytes.hpp"
#include "text/cells.hpp"
#include "text/located_text.hpp"
#include "text/path_inside.hpp"

namespace ballbar {
namespace {

// They bound the memory: every row has at least a comma for each cell, but a cell takes more room than a comma.
constexpr std::size_t kMostRuns = 100000;
constexpr std::size_t kMostColumns = 100;
constexpr std::size_t kLongestPath = 4096;

struct Cell {
  std::string text;
  std::size_t offset = 0;
};

std::size_t after_blanks(std::string_view line, std::size_t at) {
  return std::min(line.find_first_not_of(" \t", at), line.size());
}

// The text of a cell, its blanks off. `line` is the file's from the offset `at` on, where the cell begins.
std::string text_of(const SourceText& text, std::string_view line, std::string_view cell, std::size_t at) {
  if (!cell.starts_with('"')) {
    if (cell.find('"') == std::string_view::npos) return std::string(cell);
    fail_at(text, at,
            fmt::format("expected quotes around a whole cell, each quote in it doubled, found {}.", in_quotes(cell)));
  }
  const std::size_t close = closing_quote(line, 0);
  if (close == std::string_view::npos) {
    fail_at(text, at, fmt::format("expected a quote that ends this cell on its line, found {}.", in_quotes(line)));
  }
  const std::size_t behind = after_blanks(line, close + 1);
  if (behind < line.size() && line[behind] != ',') {
    fail_at(text, at + behind,
            fmt::format("expected a comma after a cell in quotes, found {}.", in_quotes(line.substr(behind))));
  }
  return unquoted(cell);
}

// At most one more than kMostColumns.
std::vector<Cell> cells_of(const SourceText& text, const TextLine& line) {
  std::vector<Cell> cells;
  for (std::size_t begin = 0;; ++begin) {
    begin = after_blanks(line.text, begin);
    const std::size_t end = cell_end(line.text, begin, ',');
    Cell cell{{}, line.offset + begin};
    cell.text = text_of(text, line.text.substr(begin), trimmed(line.text.substr(begin, end - begin)), cell.offset);
    // A terminal obeys control characters, and messages show these texts.
    const auto is_control = [](char c) { return (static_cast<unsigned char>(c) < 0x20 && c != '\t') || c == 0x7F; };
    if (std::any_of(cell.text.begin(), cell.text.end(), is_control)) {
      fail_at(text, cell.offset, fmt::format("expected printable text, found {}.", in_quotes(cell.text)));
    }
    cells.push_back(std::move(cell));
    begin = end;
    if (end == line.text.size() || cells.size() > kMostColumns) return cells;
  }
}

std::vector<Cell> header_of(const SourceText& text, const TextLine& line) {
  const std::vector<Cell> names = cells_of(text, line);
  const std::string& first = names.front().text;
  if (first != "run" && first != "file") {
    const bool other_comma = first.find_first_of(";\t") != std::string::npos;
    fail_at(text, names.front().offset,
            fmt::format("expected a header whose first column is run or file, found {}{}.", in_quotes(first),
                        other_comma ? "; columns are separated by commas" : ""));
  }
  if (names.size() > kMostColumns) {
    fail_at(text, line.offset, fmt::format("expected at most {} columns, found more.", kMostColumns));
  }
  std::set<std::string_view> known;
  for (const Cell& name : names) {
    if (name.text.empty()) fail_at(text, name.offset, "expected the name of a column, found nothing.");
    if (!known.insert(name.text).second) {
      fail_at(text, name.offset, fmt::format("expected each column once, found {} again.", in_quotes(name.text)));
    }
  }
  return names;
}

bool ends_in_csv(std::string_view name) { return name.ends_with(".csv") || name.ends_with(".CSV"); }

std::filesystem::path file_of(const SourceText& text, const Cell& cell, const std::string& column) {
  if (cell.text.empty()) fail_at(text, cell.offset, fmt::format("expected a name for {}, found nothing.", column));
  if (cell.text.size() > kLongestPath) {
    fail_at(text, cell.offset,
            fmt::format("expected at most {} bytes for {}, found {}.", kLongestPath, column, cell.text.size()));
  }
  const std::string path = column == "file" || ends_in_csv(cell.text) ? cell.text : cell.text + ".csv";
  if (!stays_inside(path)) {
    fail_at(text, cell.offset,
            fmt::format("expected a {} inside the list's folder, found {}.", column, in_quotes(cell.text)));
  }
  return path;
}

std::string counted(std::size_t cells) { return fmt::format("{} cell{}", cells, cells == 1 ? "" : "s"); }

std::vector<Cell> row_of(const SourceText& text, const TextLine& line, std::size_t columns) {
  if (after_blanks(line.text, 0) == line.text.size()) {
    fail_at(text, line.offset, fmt::format("expected a row of {}, found an empty line.", counted(columns)));
  }
  if (line.text.starts_with('#')) {
    fail_at(text, line.offset, "expected comments above the header alone, found one below it.");
  }
  std::vector<Cell> cells = cells_of(text, line);
  if (cells.size() == columns) return cells;
  const std::string found = cells.size() > kMostColumns ? "more" : fmt::format("{}", cells.size());
  fail_at(text, line.offset,
          fmt::format("expected {}, one for each column, found {}; a comma in a cell needs quotes around it.",
                      counted(columns), found));
}

}  // namespace

RunList read_runs(std::string_view bytes, std::string_view name) {
  const SourceText text = source_text(bytes, name);
  // Line ends after the last row are no rows; npos + 1 is 0.
  const std::string_view body = text.bytes.substr(0, text.bytes.find_last_not_of("\r\n") + 1);
  std::size_t number = 1;
  TextLine line = line_at(body, 0);
  for (; line.text.starts_with('#'); ++number) line = line_at(body, line.next);
  if (line.offset == body.size()) {
    fail_at(text, text.bytes.size(), "expected a header such as run,speed_rpm, found the end of the file.");
  }
  const std::vector<Cell> header = header_of(text, line);
  const std::string& column = header.front().text;
  RunList list;
  for (std::size_t i = 1; i < header.size(); ++i) list.columns.push_back(header[i].text);
  std::set<std::string> files;
  while (line.next < body.size()) {
    line = line_at(body, line.next);
    ++number;
    if (list.runs.size() == kMostRuns) {
      fail_at(text, line.offset, fmt::format("expected at most {} runs, found more.", kMostRuns));
    }
    std::vector<Cell> cells = row_of(text, line, header.size());
    ListedRun run{cells.front().text, file_of(text, cells.front(), column), {}, number};
    if (!files.insert(run.file.lexically_normal().string()).second) {
      fail_at(text, cells.front().offset,
              fmt::format("expected each {} once, found {} again.", column, in_quotes(run.name)));
    }
    run.about.reserve(cells.size() - 1);
    for (std::size_t i = 1; i < cells.size(); ++i) run.about.push_back(std::move(cells[i].text));
    list.runs.push_back(std::move(run));
  }
  if (list.runs.empty()) {
    fail_at(text, text.bytes.size(), fmt::format("expected at least one {}, found the end of the file.", column));
  }
  return list;
}

RunList open_runs(const std::filesystem::path& path) {
  RunList list = read_runs(read_bytes(path, kLargestText), path.string());
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
  for (ListedRun& run : list.runs) run.file = path_inside(folder, run.file.string(), "the list");
  return list;
}

}  // namespace ballbar
