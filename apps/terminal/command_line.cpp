#include "terminal/command_line.hpp"

namespace ballbar {

CommandLine* line_of(CLI::App& command) {
  CLI::App* root = &command;
  while (root->get_parent() != nullptr) root = root->get_parent();
  return dynamic_cast<CommandLine*>(root);
}

const CommandLine* line_of(const CLI::App& command) {
  const CLI::App* root = &command;
  while (root->get_parent() != nullptr) root = root->get_parent();
  return dynamic_cast<const CommandLine*>(root);
}

Source source_of(const CLI::App& command, const std::string& word) {
  const CommandLine* const line = line_of(command);
  if (line == nullptr) return word;
  const auto found = line->values.find(word);
  return found == line->values.end() ? Source(word) : found->second;
}

const Catalogue& catalogue_of(const CLI::App& command) {
  const CommandLine* const line = line_of(command);
  return line == nullptr ? built_in_catalogue() : line->catalogue;
}

CLI::Option* add_source(CLI::App& command, const std::string& name, Source& source, const std::string& help) {
  return command.add_option_function<std::string>(
      name, [&command, &source](const std::string& word) { source = source_of(command, word); }, help);
}

CLI::Option* add_sources(CLI::App& command, const std::string& name, std::vector<Source>& sources,
                         const std::string& help) {
  return command.add_option_function<std::vector<std::string>>(
      name,
      [&command, &sources](const std::vector<std::string>& words) {
        sources.clear();
        for (const std::string& word : words) sources.push_back(source_of(command, word));
      },
      help);
}

}  // namespace ballbar
