// `ballbar FILE...` without a command runs the command for the kind of file:
//
//   circles of two linear axes              ballbar errors FILE...
//   other recordings                        ballbar diagnose FILE...
//   a session: a folder, session.toml       ballbar drift SESSION
//   a series, or any other table            ballbar diagnose FILE...
//
// --page [FILE] writes the page instead: ballbar report FILE... --out FILE, default page.html. All other words are
// passed on.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace ballbar {

// --page in the help.
void add_page_option(CLI::App& app);

// The words with the command in front, if the first word is a file or a folder and not a command; prints the command on
// the standard error. Otherwise the unchanged words. Throws Error for files of two kinds and for a model alone,
// CLI::ValidationError for more than one session and for --page without a file.
std::vector<std::string> with_command(std::vector<std::string> words, const CLI::App& app);

}  // namespace ballbar
