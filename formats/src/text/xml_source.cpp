#include "text/xml_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "text/cells.hpp"

namespace ballbar {
namespace {

// No parse_eol: offsets in a text must be those of the file.
constexpr unsigned kParse = pugi::parse_cdata | pugi::parse_escapes;
constexpr double kMostAngle_deg = 3600.0;  // ten turns

// pugixml leaves entities it does not know as they are; here they are refused, and with them a DTD.
void expect_plain_xml(const SourceText& text) {
  for (std::size_t at = text.bytes.find('&'); at != std::string_view::npos; at = text.bytes.find('&', at + 1)) {
    const std::string_view entity = text.bytes.substr(at, text.bytes.substr(at, 12).find(';') + 1);  // npos + 1 is 0
    if (entity == "&amp;" || entity == "&lt;" || entity == "&gt;" || entity == "&quot;" || entity == "&apos;" ||
        entity.starts_with("&#")) {
      continue;
    }
    fail_at(text, at,
            fmt::format("expected no entity but &amp; &lt; &gt; &quot; &apos; and numbers, found {}.",
                        in_quotes(entity.empty() ? text.bytes.substr(at, 1) : entity)));
  }
  if (const std::size_t at = text.bytes.find("<!DOCTYPE"); at != std::string_view::npos) {
    fail_at(text, at, "expected XML without a document type, found <!DOCTYPE.");
  }
}

}  // namespace

void parse_xml(const SourceText& text, pugi::xml_document& document) {
  expect_plain_xml(text);
  const auto size = static_cast<std::ptrdiff_t>(text.bytes.size());
  const pugi::xml_parse_result parsed =
      document.load_buffer(text.bytes.data(), text.bytes.size(), kParse, pugi::encoding_utf8);
  if (parsed) return;
  fail_at(text, static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(parsed.offset, 0, size)),
          fmt::format("expected a complete XML file, found damage or an early end: {}. Copy the file again.",
                      parsed.description()));
}

std::size_t offset_of(pugi::xml_node node) {
  return static_cast<std::size_t>(std::max<std::ptrdiff_t>(node.offset_debug(), 0));
}

pugi::xml_node child_of(const SourceText& text, pugi::xml_node parent, const char* name, bool needed) {
  const pugi::xml_node child = parent.child(name);
  if (!child && needed) {
    fail_at(text, offset_of(parent), fmt::format("expected {} in {}, found none.", name, parent.name()));
  }
  if (const pugi::xml_node again = child.next_sibling(name)) {
    fail_at(text, offset_of(again), fmt::format("expected one {} in {}, found another.", name, parent.name()));
  }
  return child;
}

Text text_of(const SourceText& text, pugi::xml_node node) {
  const pugi::xml_node content = node.first_child();
  if (!content) return {"", offset_of(node)};
  if (content.next_sibling() || (content.type() != pugi::node_pcdata && content.type() != pugi::node_cdata)) {
    fail_at(text, offset_of(node), fmt::format("expected plain text in {}, found elements.", node.name()));
  }
  const std::string_view value = content.value();
  const std::string_view inside = trimmed(value, kBlank);
  return {inside, offset_of(content) + static_cast<std::size_t>(inside.data() - value.data())};
}

double number_of(const SourceText& text, const Text& found, std::string_view name) {
  const char* const end = found.value.data() + found.value.size();
  const PlainDecimal plain = plain_decimal(found.value.data(), end);
  if (plain.rest != nullptr && plain.rest == end) return plain.value;
  const std::string_view digits = found.value.starts_with('+') ? found.value.substr(1) : found.value;
  double value = 0.0;
  const auto [rest, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error == std::errc{} && rest == digits.data() + digits.size() && std::isfinite(value) &&
      !found.value.starts_with("+-")) {
    return value;
  }
  fail_at(
      text, found.offset,
      fmt::format("expected a finite number for {}, decimals with a point, found {}.", name, in_quotes(found.value)));
}

double positive_in(const SourceText& text, pugi::xml_node parent, const char* name) {
  const Text found = text_of(text, child_of(text, parent, name));
  const double value = number_of(text, found, name);
  if (!(value > 0.0))
    fail_at(text, found.offset, fmt::format("expected {} above 0, found {}.", name, in_quotes(found.value)));
  return value;
}

double angle_in(const SourceText& text, pugi::xml_node parent, const char* name) {
  const Text found = text_of(text, child_of(text, parent, name));
  const double angle_deg = number_of(text, found, name);
  if (std::abs(angle_deg) <= kMostAngle_deg) return angle_deg;
  fail_at(text, found.offset, fmt::format("expected {} of at most ten turns, found {}.", name, in_quotes(found.value)));
}

std::size_t index_in(const SourceText& text, pugi::xml_node parent, const char* name) {
  const Text found = text_of(text, child_of(text, parent, name));
  std::size_t value = 0;
  const auto [rest, error] = std::from_chars(found.value.data(), found.value.data() + found.value.size(), value);
  if (error == std::errc{} && rest == found.value.data() + found.value.size()) return value;
  fail_at(text, found.offset, fmt::format("expected {} as a count from 0, found {}.", name, in_quotes(found.value)));
}

}  // namespace ballbar
