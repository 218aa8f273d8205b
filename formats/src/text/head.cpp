#include "text/head.hpp"

#include <algorithm>

namespace ballbar {

std::string_view text_of_head(std::string_view head) {
  if (head.starts_with("\xEF\xBB\xBF")) head.remove_prefix(3);
  if (has_nul(head)) return {};
  head.remove_prefix(std::min(head.find_first_not_of(" \t\r\n"), head.size()));
  return head;
}

bool has_nul(std::string_view head) { return head.find('\0') != std::string_view::npos; }

std::string_view format_name(std::string_view head) {
  std::string_view text = text_of_head(head);
  if (text.starts_with('<')) return {};
  while (!text.empty()) {
    std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    const auto skip = [&](std::string_view skipped) {
      line.remove_prefix(std::min(line.find_first_not_of(skipped), line.size()));
    };
    skip("# \t");
    if (!line.starts_with("format")) continue;
    line.remove_prefix(6);
    skip(" \t");
    if (!line.starts_with('=')) continue;
    line.remove_prefix(1);
    skip(" \t");
    if (!line.starts_with('"') && !line.starts_with('\'')) continue;
    line.remove_prefix(1);
    return line.substr(0, line.find_first_of(" \"'\r"));
  }
  return {};
}

std::string_view after_comments(std::string_view head) {
  std::string_view text = text_of_head(head);
  while (text.starts_with('#')) text.remove_prefix(std::min(text.find('\n'), text.size() - 1) + 1);
  return text;
}

std::string_view xml_root(std::string_view head) {
  std::string_view text = text_of_head(head);
  const auto skip_past = [&](std::string_view end) {
    const std::size_t at = text.find(end);
    text.remove_prefix(at == std::string_view::npos ? text.size() : at + end.size());
    text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
  };
  while (text.starts_with("<?") || text.starts_with("<!--")) skip_past(text.starts_with("<?") ? "?>" : "-->");
  if (!text.starts_with('<') || text.starts_with("<!")) return {};
  text.remove_prefix(1);
  return text.substr(0, text.find_first_of(" \t\r\n/>"));
}

}  // namespace ballbar
