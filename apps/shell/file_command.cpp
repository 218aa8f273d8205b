#include "shell/file_command.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>

#include "ballbar/error.hpp"
#include "ballbar/formats/recordings/recording_file.hpp"
#include "ballbar/formats/sessions/data_file.hpp"
#include "ballbar/formats/text/archive.hpp"
#include "ballbar/formats/text/reader.hpp"
#include "ballbar/formats/text/source.hpp"
#include "shell/usage_fault.hpp"
#include "terminal/stderr_line.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar {
namespace {

enum class FileKind { recording, session, series };

std::string_view name_of(FileKind kind) {
  constexpr std::string_view kNames[] = {"recording", "session", "series"};
  return kNames[static_cast<std::size_t>(kind)];
}

// The content decides. A file of no known format is read as a series, whose reader says what is wrong with it.
FileKind kind_of(const std::string& path) {
  std::error_code absent;
  if (std::filesystem::is_directory(path, absent) && stands_for_runs(path)) return FileKind::series;
  if (std::filesystem::is_directory(path, absent) || is_archive(path)) return FileKind::session;
  const Reader* const reader = Source(path).reader();
  if (reads_recordings(reader)) return FileKind::recording;
  if (read_of<ReadSession>(reader) != nullptr) return FileKind::session;
  if (found_in(reader) == "a model") {
    throw Error(
        fmt::format("{}: expected recordings, a session or a series, found a model. Fit it to data with ballbar check "
                    "DATA --model {}.",
                    path, path));
  }
  return FileKind::series;
}

bool is_there(const std::string& path) {
  std::error_code absent;
  return !is_option(path) && std::filesystem::exists(path, absent);
}

// Takes --page [FILE] out of the words; the name of the page, nothing without the option.
std::optional<std::string> take_page(std::vector<std::string>& words, const std::vector<std::string>& commands) {
  constexpr std::string_view kOption = "--page";
  const auto option = std::find_if(words.begin(), words.end(), [&](const std::string& word) {
    return word == kOption || word.starts_with(std::string(kOption) + "=");
  });
  if (option == words.end()) return std::nullopt;
  std::string page = "page.html";
  auto last = option + 1;
  if (*option != kOption) {
    page = option->substr(kOption.size() + 1);
  } else if (last != words.end() && !is_option(*last) && (last->ends_with(".html") || !is_there(*last)) &&
             std::find(commands.begin(), commands.end(), *last) == commands.end()) {
    page = *last++;
  }
  words.erase(option, last);
  return page;
}

FileKind kind_of_all(const std::vector<std::string>& files) {
  const FileKind kind = kind_of(files.front());
  for (const std::string& file : files) {
    const FileKind other = kind_of(file);
    if (other == kind) continue;
    throw Error(
        fmt::format("{}: expected a {} as {} is, found a {}.", file, name_of(kind), files.front(), name_of(other)));
  }
  if (kind == FileKind::session && files.size() > 1) {
    throw CLI::ValidationError(
        fmt::format("expected one session, found {}. Compare two with ballbar compare A B", files.size()));
  }
  return kind;
}

std::string command_for(FileKind kind, const std::vector<std::string>& files) {
  if (kind == FileKind::session) return "drift";
  const bool are_tests = kind == FileKind::recording && std::all_of(files.begin(), files.end(), is_of_linear_axes);
  return are_tests ? "errors" : "diagnose";
}

}  // namespace

void add_page_option(CLI::App& app) {
  const auto page = std::make_shared<std::string>();  // taken out of the words before they are read
  app.add_option("--page", *page, "write a page of the files, to FILE or page.html")
      ->type_name("[FILE]")
      ->expected(0, 1);
}

std::vector<std::string> with_command(std::vector<std::string> words, const CLI::App& app) {
  std::vector<std::string> given = words;
  const auto commands = command_names(app);
  const std::optional<std::string> page = take_page(given, commands);
  if (given.empty() || !is_there(given.front()) ||
      std::find(commands.begin(), commands.end(), given.front()) != commands.end()) {
    if (!words.empty() && words.front().starts_with("--page")) {
      throw CLI::ValidationError(
          "--page: expected files and no command, found a command. Use ballbar report DATA --out page.html instead");
    }
    return words;
  }
  const auto end = std::find_if(given.begin(), given.end(), is_option);
  const FileKind kind = kind_of_all({given.begin(), end});
  std::vector<std::string> command{page ? "report" : command_for(kind, {given.begin(), end})};
  command.insert(command.end(), given.begin(), given.end());
  if (page) command.insert(command.end(), {"--out", *page});
  const bool silent = std::find(given.begin(), given.end(), "--no-diagnosis") != given.end();
  if (page && kind == FileKind::series && !silent) command.emplace_back("--diagnose");
  std::vector<std::string> typed;
  typed.reserve(command.size());
  for (const std::string& word : command) typed.push_back(shell_word(word));
  stderr_line(fmt::format("{}: as `ballbar {}`", name_of(kind), fmt::join(typed, " ")));
  return command;
}

}  // namespace ballbar
