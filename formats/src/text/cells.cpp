#include "text/cells.hpp"

#include <algorithm>

namespace ballbar {

TextLine line_at(std::string_view bytes, std::size_t offset) {
  const std::size_t end = std::min(bytes.find('\n', offset), bytes.size());
  std::string_view text = bytes.substr(offset, end - offset);
  if (text.ends_with('\r')) text.remove_suffix(1);
  return {text, offset, std::min(end + 1, bytes.size())};
}

std::string_view trimmed(std::string_view text, std::string_view blanks) {
  text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
  return text.substr(0, text.find_last_not_of(blanks) + 1);
}

std::size_t closing_quote(std::string_view line, std::size_t open) {
  std::size_t close = line.find('"', open + 1);
  while (close != std::string_view::npos && close + 1 < line.size() && line[close + 1] == '"') {
    close = line.find('"', close + 2);
  }
  return close;
}

std::size_t cell_end(std::string_view line, std::size_t begin, char delimiter) {
  const auto end_from = [&](std::size_t at) {
    return std::min(delimiter == ' ' ? line.find_first_of(" \t", at) : line.find(delimiter, at), line.size());
  };
  const std::size_t end = end_from(begin);
  const std::size_t first = line.find_first_not_of(' ', begin);
  if (first >= end || line[first] != '"') return end;
  const std::size_t close = closing_quote(line, first);
  return close == std::string_view::npos ? end : end_from(close);
}

void split_cells(std::string_view line, char delimiter, std::vector<std::string_view>& cells) {
  cells.clear();
  const auto next = [&](std::size_t at) {
    return delimiter == ' ' ? std::min(line.find_first_not_of(" \t", at), line.size()) : at;
  };
  std::size_t begin = next(0);
  if (delimiter == ' ' && begin == line.size()) return;
  while (true) {
    const std::size_t end = cell_end(line, begin, delimiter);
    cells.push_back(line.substr(begin, end - begin));
    if (end == line.size()) return;
    begin = next(end + 1);
    if (delimiter == ' ' && begin == line.size()) return;
  }
}

std::string unquoted(std::string_view cell) {
  if (cell.size() < 2 || !cell.starts_with('"') || !cell.ends_with('"')) return std::string(cell);
  cell = cell.substr(1, cell.size() - 2);
  std::string text;
  for (std::size_t at = 0; at < cell.size(); ++at) {
    text += cell[at];
    if (cell.substr(at, 2) == "\"\"") ++at;
  }
  return text;
}

}  // namespace ballbar
