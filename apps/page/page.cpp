#include "page/page.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>

#include "ballbar/error.hpp"
#include "ballbar/nearest_name.hpp"
#include "page/page_assets.hpp"
#include "programs/finished.hpp"

namespace ballbar {
namespace {

using Json = nlohmann::ordered_json;

// JSON that is also harmless within <script>: ASCII alone, and no "<" to end or comment it. Bytes that are not UTF-8
// become U+FFFD.
std::string as_script(const Json& json) {
  const std::string text = json.dump(-1, ' ', true, Json::error_handler_t::replace);
  std::string safe;
  safe.reserve(text.size());
  for (const char sign : text) {
    if (sign == '<') {
      safe += "\\u003c";
    } else {
      safe += sign;
    }
  }
  return safe;
}

std::string as_html(std::string_view text) {
  std::string safe;
  for (const char sign : text) {
    switch (sign) {
      case '<':
        safe += "&lt;";
        break;
      case '>':
        safe += "&gt;";
        break;
      case '&':
        safe += "&amp;";
        break;
      case '"':
        safe += "&quot;";
        break;
      default:
        safe += static_cast<unsigned char>(sign) < 0x20 ? ' ' : sign;
    }
  }
  return safe;
}

// As JSON has it: UTF-8 whatever the bytes were.
std::string title_of(const Json& report) {
  const Json title = Json::parse(report["title"].dump(-1, ' ', false, Json::error_handler_t::replace));
  return title.get<std::string>();
}

}  // namespace

void expect_page() {
  if (!page::kScript.empty()) return;
  throw Error(
      "this ballbar was built without its page: expected node and npm when it was built; on Debian install nodejs and "
      "npm, then run cmake -S . -B build -DBALLBAR_PAGE=ON && cmake --build build.");
}

std::string page_of(const Json& report) {
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; script-src '{}'; style-src '{}'; "
      "img-src data: blob:; base-uri 'none'; form-action 'none'\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta name=\"generator\" content=\"{}\">\n<title>{}</title>\n<style>{}</style>\n</head>\n<body>\n"
      "<noscript>This report draws its pictures by JavaScript, which is switched off here.</noscript>\n"
      "<script type=\"application/json\" id=\"report\">{}</script>\n<script>{}</script>\n</body>\n</html>\n",
      page::kScriptHash, page::kStyleHash, as_html(report["made_by"].get<std::string>()), as_html(title_of(report)),
      page::kStyle, as_script(report), page::kScript);
}

std::vector<NamedPicture> pictures_of(const Json& report, const PictureOptions& options) {
  std::string script(page::kPictures);
  script += fmt::format("\n;process.stdout.write(JSON.stringify(ballbar_pictures.draw(JSON.parse({}),{},{},{})));\n",
                        as_script(Json(report.dump(-1, ' ', true, Json::error_handler_t::replace))),
                        as_script(Json(options.names)), as_script(Json(options.choices)), options.width_px);
  const Finished node = finished("--format svg", {"node", "-"}, script, "NODE_OPTIONS=");
  if (node.not_found) {
    throw Error(
        "--format svg: expected the program node to draw with, found none; on Debian it is in the package nodejs.");
  }
  const Json answer = Json::parse(node.out, nullptr, false);
  if (node.signal != 0 || node.status != 0 || !answer.is_object()) {
    throw Error(fmt::format("--format svg: expected pictures from node, found it ended with {} {}: {}",
                            node.signal != 0 ? "signal" : "status", node.signal != 0 ? node.signal : node.status,
                            node.err.substr(0, 400)));
  }
  if (answer.contains("option")) {
    const auto known = answer["expected"].get<std::vector<std::string>>();
    throw Error(fmt::format(
        "{}: {}{}, found {}.", answer["option"].get<std::string>(),
        known.empty() ? "expected none, there is nothing to choose in this picture" : "expected one of these: ",
        fmt::join(known, "; "), in_quotes(answer["found"].get<std::string>())));
  }
  std::vector<NamedPicture> pictures;
  for (const Json& one : answer["drawn"]) {
    pictures.push_back(
        {one["name"].get<std::string>(), one["title"].get<std::string>(), one["svg"].get<std::string>()});
  }
  return pictures;
}

}  // namespace ballbar
