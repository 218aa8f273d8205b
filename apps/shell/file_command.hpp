// `ballbar FILE...` without a command does what the file is for:
//
//   circles of two linear axes              ballbar errors FILE...
//   other recordings                        ballbar diagnose FILE...
//   a session: a folder, session.toml       ballbar drift SESSION
//   a series, or any other table            ballbar diagnose FILE...
//
// --page [FILE] writes the page of it instead: ballbar report FILE... --out FILE, page.html where none is named. All
// else on the line is passed on.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace ballbar {

// --page in the help.
void add_page_option(CLI::App& app);

// The words with the command in front where the first is no command but a file or a folder, which is said on the
// standard error; otherwise as they are. Throws Error: files of two kinds, a model alone; CLI::ValidationError: more
// than one session, --page without a file.
std::vector<std::string> with_command(std::vector<std::string> words, const CLI::App& app);

}  // namespace ballbar
