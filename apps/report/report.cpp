// `ballbar report DATA --out page.html`: everything to look at, in one file.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "ballbar/error.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "commands.hpp"
#include "page/pdf_file.hpp"
#include "page/report_page.hpp"
#include "programs/child_process.hpp"
#include "report/report_inside.hpp"
#include "report/report_subject.hpp"
#include "terminal/caller.hpp"
#include "terminal/option_checks.hpp"
#include "terminal/stderr_line.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar::commands {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

enum class Format { html, svg, json, pdf };

struct ReportArguments {
  ReportRequest of;
  std::string out;
  std::optional<Format> chosen_format;
  Format format = Format::html;
  bool json = false;
  PictureOptions pictures;
  bool open = false;
  bool without_files = false;
  bool tool = false;
};

void write_pictures(const Json& report, const ReportArguments& options) {
  const std::vector<NamedPicture> pictures = pictures_of(report, options.pictures);
  const bool one_file = ending_of(options.out) == ".svg";
  if (one_file && pictures.size() != 1) {
    std::string names;
    for (const NamedPicture& picture : pictures) names += (names.empty() ? "" : ", ") + picture.name;
    throw Error(fmt::format("--out {}: expected --picture with one of {}, or a folder for all.", options.out, names));
  }
  if (one_file) {
    write_bytes(options.out, pictures.front().svg);
    print_for_people(fmt::format("{}  {}\n", options.out, pictures.front().title));
    return;
  }
  std::error_code error;
  fs::create_directories(options.out, error);
  if (error)
    throw Error(fmt::format("--out {}: expected a folder to write to, found: {}.", options.out, error.message()));
  for (const NamedPicture& picture : pictures) {
    const fs::path path = fs::path(options.out) / (picture.name + ".svg");
    write_bytes(path, picture.svg);
    print_for_people(fmt::format("{}  {}\n", path.string(), picture.title));
  }
}

// As --format says, or the ending of --out.
Format format_of(const ReportArguments& options) {
  if (options.chosen_format) return *options.chosen_format;
  const std::string ending = ending_of(options.out);
  if (ending == ".pdf") return Format::pdf;
  return ending == ".svg" ? Format::svg : ending == ".json" ? Format::json : Format::html;
}

void expect_fitting_options(const ReportArguments& options) {
  const auto expect = [](bool fits, const std::string& sentence) {
    if (!fits) throw CLI::ValidationError(sentence);
  };
  const PictureOptions& pictures = options.pictures;
  const bool sheet = options.format == Format::pdf && pictures.names.empty();  // its one picture may be chosen in
  expect(options.format == Format::svg || sheet || (pictures.names.empty() && pictures.choices.empty()),
         fmt::format("--{}: expected --format svg; the page has all pictures",
                     pictures.names.empty() ? "choose" : "picture"));
  expect(sheet || pictures.choices.empty() || pictures.names.size() == 1, "--choose: expected one --picture");
  if (options.json) {
    expect(options.out.empty() && !options.chosen_format && !options.open,
           "--json: cannot be combined with --out, --format or --open; it prints the data of the page");
    return;
  }
  expect(!options.out.empty(), options.format == Format::svg
                                   ? "--format svg: expected --out with a folder, or a name that ends in .svg"
                                   : "expected --out with the name of the page, as in --out page.html");
  const std::string ending = ending_of(options.out);
  const std::string expected = options.format == Format::html   ? ".html"
                               : options.format == Format::json ? ".json"
                               : options.format == Format::pdf  ? ".pdf"
                                                                : "";
  expect(expected.empty() || ending == expected,
         fmt::format("--out {}: expected a name that ends in {}, found {}", options.out, expected,
                     ending.empty() ? "no ending" : ending));
  expect(!options.open || options.format == Format::html, "--open: expected a page to open, not --format");
}

void expect_out(const ReportArguments& options) {
  expect_fitting_options(options);
  if (options.json) return;
  // Before a long diagnosis rather than after it.
  const fs::path folder = fs::absolute(options.out).parent_path();
  std::error_code error;
  if (options.format != Format::svg && !fs::is_directory(folder, error)) {
    throw Error(fmt::format("--out {}: expected a folder to write to, found none of that name.", options.out));
  }
  if (options.format != Format::json) expect_page();
  if (options.format == Format::pdf) expect_pdf("--format pdf");
}

std::string text_of(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

std::string html_of(const Json& json, const Report& made, const ReportArguments& options) {
  const auto is_path = [](const Source& source) { return source.empty() || source.is_path(); };
  const ModelOptions& of = options.of.model;
  const bool all_are_files = is_path(of.model) && std::all_of(of.data.begin(), of.data.end(), is_path);
  if (options.without_files || !all_are_files) return page_of(json, nullptr);
  const Json inside = files_inside(made.files, names_of(options.of.model.data), options.of.model.model.name());
  if (inside.is_null() && !made.files.empty()) {
    stderr_line(fmt::format("the data files are not in the page, because they exceed {} MB or come from a pipe",
                            kMostInside >> 20));
  }
  return page_of(json, inside);
}

std::string bytes_of(const Json& json, const Report& made, const ReportArguments& options) {
  if (options.format == Format::json) return text_of(json) + "\n";
  if (options.format == Format::html) return html_of(json, made, options);
  return pdf_of(handover_of(json, options.pictures.choices), text_of(made.page.head.title));
}

// The page alone, with the program and without data.
void write_tool(const ReportArguments& options, const CLI::App& command) {
  for (const CLI::Option* other : command.get_options()) {
    if (other->count() == 0 || other->check_lname("tool") || other->check_lname("out")) continue;
    throw CLI::ValidationError(
        fmt::format("--tool: expected --out alone, found {}", other->get_name(other->get_positional())));
  }
  const std::string out = options.out.empty() ? "ballbar.html" : options.out;
  const std::string ending = ending_of(out);
  if (ending != ".html") {
    throw CLI::ValidationError(fmt::format("--out {}: expected a name that ends in .html, found {}", out,
                                           ending.empty() ? "no ending" : ending));
  }
  write_tool_page(out);
}

void run(ReportArguments options) {
  if (options.of.model.data.empty()) throw CLI::RequiredError("DATA");
  options.format = format_of(options);
  expect_out(options);
  std::vector<fs::path> inputs = paths_of(options.of.model.data);
  std::vector<Source> others = options.of.compare;
  others.push_back(options.of.model.model);
  for (const Source& other : others) {
    if (other.is_path()) inputs.push_back(other.path());
  }
  if (!options.json) expect_no_input({options.out}, inputs);
  const Report made = [&] {
    const ProgressLine line;
    return ReportSubject(options.of).report(!options.of.no_diagnosis);
  }();
  const Json json = json_of(made.page);
  if (options.json) return print_json(json, -1);
  expect_no_input({options.out}, made.files);
  if (options.format == Format::svg) return write_pictures(json, options);
  write_bytes(options.out, bytes_of(json, made, options));
  for (const Paragraph& sentence : made.page.head.summary) print_for_people(wrapped(sentence));
  print_for_people(left_out_text(made.skipped));
  wrote_line(options.out);
  if (options.open && !started({"xdg-open", fs::absolute(options.out).string()})) {
    warning_line(fmt::format("the program xdg-open is missing. Open {} in a browser.", options.out));
  }
}

}  // namespace

void add_report(CLI::App& app) {
  const auto options = std::make_shared<ReportArguments>();
  CLI::App* command = app.add_subcommand("report", "Write all results to one page");
  add_report_options(*command, options->of);
  command
      ->add_option("--out", options->out,
                   "write the page to FILE (.html), one picture or all pictures (.svg or a folder), its data (.json), "
                   "or one sheet (.pdf)")
      ->type_name("FILE");
  add_choice(*command, "--format", {"html", "svg", "json", "pdf"}, "by the name of --out",
             "html: the page; svg: its pictures; json: its data; pdf: one ballbar or thermal test on one sheet",
             [options](std::size_t at) { options->chosen_format = static_cast<Format>(at); });
  command->add_flag("--json", options->json, "print the data of the page as JSON");
  command->add_option("--picture", options->pictures.names, "with --format svg: only this picture; may be repeated")
      ->type_name("NAME")
      ->allow_extra_args(false);
  command
      ->add_option("--choose", options->pictures.choices,
                   "with --picture or pdf: selection in the page, such as \"recording=64 min, XY CCW\"")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command->add_option("--width", options->pictures.width_px, "with --format svg: width in pixels; default: 900")
      ->type_name("PX")
      ->check(whole_number_within(300, 4000));
  command->add_flag("--without-files", options->without_files, "omit the data files from the page");
  command->add_flag("--open", options->open, "open the page in a browser");
  command->get_option("DATA")->required(false);
  command->add_flag("--tool", options->tool, "write the whole program as one HTML file, ballbar.html");
  for (const char* name : {"--robust", "--white", "--set"}) command->get_option(name)->group("Fit of the model");
  for (const char* name : {"--picture", "--choose", "--width", "--without-files"})
    command->get_option(name)->group("Pictures and files");
  command->footer(
      "Examples:\n"
      "  ballbar report sample-runs/two-arcs-he2015 --model sample-runs/two-arcs-he2015/model.toml --out page.html\n"
      "  ballbar report sample-runs/qc20-style-b5r/00.b5r --out page.html --open\n"
      "  ballbar report sample-runs/two-arcs-he2015 --format svg --picture drift --out drift.svg\n"
      "  ballbar report --tool");
  command->callback([options, command] { options->tool ? write_tool(*options, *command) : run(*options); });
}

}  // namespace ballbar::commands
