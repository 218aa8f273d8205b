#include "page/report_page.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <system_error>

#include "ballbar/error.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "ballbar/internal/nearest_name.hpp"
#include "page/page_assets.hpp"
#include "page/report_head.hpp"
#include "programs/child_process.hpp"

namespace ballbar {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// JSON that is also harmless within <script>: ASCII alone, and no "<" to end or comment it. Bytes that are not UTF-8
// become U+FFFD.
std::string as_script(const Json& json) {
  const std::string text = json.dump(-1, ' ', true, Json::error_handler_t::replace);
  std::string safe;
  safe.reserve(text.size());
  for (const char sign : text) safe += sign == '<' ? "\\u003c" : std::string(1, sign);
  return safe;
}

std::string as_html(std::string_view text) {
  std::string safe;
  for (const char sign : text) {
    safe += sign == '<'                               ? "&lt;"
            : sign == '>'                             ? "&gt;"
            : sign == '&'                             ? "&amp;"
            : sign == '"'                             ? "&quot;"
            : static_cast<unsigned char>(sign) < 0x20 ? " "
                                                      : std::string(1, sign);
  }
  return safe;
}

// As JSON has it: UTF-8 whatever the bytes were.
std::string title_of(const Json& report) {
  const Json title = Json::parse(report["title"].dump(-1, ' ', false, Json::error_handler_t::replace));
  return title.get<std::string>();
}

// Of a function in node.
std::string as_argument(const Json& report) {
  return fmt::format("JSON.parse({})", as_script(Json(report.dump(-1, ' ', true, Json::error_handler_t::replace))));
}

// What a function of apps/page/src/pictures.ts answers. Throws Error, beginning with `option`.
Json drawn(const std::string& option, std::string_view function, const std::string& arguments) {
  std::string script(page::kPictures);
  script += fmt::format("\n;process.stdout.write(JSON.stringify(ballbar_pictures.{}({})));\n", function, arguments);
  const ChildProcess node = child_process(option, {"node", "-"}, script, "NODE_OPTIONS=");
  if (node.not_found) {
    throw Error(fmt::format(
        "{}: expected the program node to draw with, found none; on Debian it is in the package nodejs.", option));
  }
  Json answer = Json::parse(node.out, nullptr, false);
  if (node.signal != 0 || node.status != 0 || !answer.is_object()) {
    throw Error(fmt::format("{}: expected pictures from node, found it ended with {} {}: {}", option,
                            node.signal != 0 ? "signal" : "status", node.signal != 0 ? node.signal : node.status,
                            node.err.substr(0, 400)));
  }
  return answer;
}

// Throws Error where a name or a choice is not there.
void expect_choices(const Json& answer) {
  if (!answer.contains("option")) return;
  const auto known = answer["expected"].get<std::vector<std::string>>();
  throw Error(fmt::format(
      "{}: {}{}, found {}.", answer["option"].get<std::string>(),
      known.empty() ? "expected none, there is nothing to choose in this picture" : "expected one of these: ",
      fmt::join(known, "; "), in_quotes(answer["found"].get<std::string>())));
}

// Each @MARK@ of the text once; what is put in is not looked at.
std::string filled(std::string_view text, const std::map<std::string, std::string, std::less<>>& marks) {
  std::string page;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t mark = text.find('@', at);
    page += text.substr(at, mark - at);
    if (mark == std::string_view::npos) break;
    const std::size_t end = text.find('@', mark + 1);
    page += marks.at(std::string(text.substr(mark + 1, end - mark - 1)));
    at = end + 1;
  }
  return page;
}

// Beside the program as it is installed, and as it lies in the tree where it is built.
constexpr std::array kPlaces{"../share/ballbar/ballbar.html", "../../build-tool/ballbar.html"};

fs::path tool_file() {
  std::error_code unknown;
  const fs::path program = fs::read_symlink("/proc/self/exe", unknown);
  for (const char* place : kPlaces) {
    const fs::path file = (program.parent_path() / place).lexically_normal();
    if (fs::is_regular_file(file, unknown)) return file;
  }
  throw Error(
      fmt::format("--tool: expected {} beside the program, found none: this ballbar was built without it; "
                  "sh apps/page/build-tool.sh makes it (Debian's emscripten, some minutes).",
                  (program.parent_path() / kPlaces.front()).lexically_normal().string()));
}

}  // namespace

void expect_page(std::string_view option) {
  if (!page::kScript.empty()) return;
  throw Error(fmt::format(
      "{}{}this ballbar was built without its page: expected node and npm when it was built; on Debian install nodejs "
      "and npm, then run cmake -S . -B build -DBALLBAR_PAGE=ON && cmake --build build.",
      option, option.empty() ? "" : ": "));
}

std::string page_date() {
  const char* stated = std::getenv("SOURCE_DATE_EPOCH");
  const std::time_t now =
      stated != nullptr ? static_cast<std::time_t>(std::strtoll(stated, nullptr, 10)) : std::time(nullptr);
  return fmt::format("{:%F}", stated != nullptr ? fmt::gmtime(now) : fmt::localtime(now));
}

ReportHead report_head(const std::string& title) {
  return {"ballbar-report 1", as_it_is(title), "ballbar " BALLBAR_VERSION, page_date(), {}, {}, {}};
}

std::string page_of(const Json& report, const Json& inside) {
  const auto data_block = [](std::string_view id, const Json& json) {
    return fmt::format("<script type=\"application/json\" id=\"{}\">{}</script>\n", id, as_script(json));
  };
  return filled(page::kShell,
                {{"CHARSET", "utf-8"},
                 {"SCRIPT_HASH", std::string(page::kScriptHash)},
                 {"STYLE_HASH", std::string(page::kStyleHash)},
                 {"ENGINE_SCRIPTS", ""},
                 {"ENGINE_WORKERS", ""},
                 {"MADE_BY", as_html(report["made_by"].get<std::string>())},
                 {"TITLE", as_html(title_of(report))},
                 {"STYLE", std::string(page::kStyle)},
                 {"CARRIED", data_block("report", report) + (inside.is_null() ? "" : data_block("files", inside))},
                 {"SCRIPT", std::string(page::kScript)}});
}

std::vector<NamedPicture> pictures_of(const Json& report, const PictureOptions& options) {
  const Json answer = drawn("--format svg", "draw",
                            fmt::format("{},{},{},{}", as_argument(report), as_script(Json(options.names)),
                                        as_script(Json(options.choices)), options.width_px));
  expect_choices(answer);
  std::vector<NamedPicture> pictures;
  for (const Json& one : answer["drawn"]) {
    pictures.push_back(
        {one["name"].get<std::string>(), one["title"].get<std::string>(), one["svg"].get<std::string>()});
  }
  return pictures;
}

std::string handover_of(const Json& report, const std::vector<std::string>& choices) {
  const Json answer =
      drawn("--format pdf", "draw_handover", fmt::format("{},{}", as_argument(report), as_script(Json(choices))));
  expect_choices(answer);
  if (answer["drawn"].empty()) {
    throw Error(
        "--format pdf: expected one ballbar test of two linear axes, with readings, or a drift over time without "
        "--model, "
        "found another report.");
  }
  return answer["drawn"][0]["svg"].get<std::string>();
}

std::string plot_of(const Json& parts, const std::string& conclusion) {
  Json report{{"title", ""}, {"summary", {conclusion}}, {"signals", Json::array()}};
  report.update(parts);
  const Json answer =
      drawn("--plot", "draw_sheet", fmt::format("{},{}", as_argument(report), PictureOptions{}.width_px));
  return answer["drawn"][0]["svg"].get<std::string>();
}

void write_tool_page(const std::string& out) {
  const fs::path from = tool_file();
  const std::string bytes = read_bytes(from.string(), kLargestText);
  write_bytes(out, bytes);
  fmt::print("{}, {:.1f} MB: open it in a browser and drop files on it. It needs no network and no installation.\n",
             out, 1e-6 * static_cast<double>(bytes.size()));
}

}  // namespace ballbar
