// `ballbar man` prints the page for man(1).
#pragma once

namespace CLI {
class App;
}

namespace ballbar {

void add_man_command(CLI::App& app);

}  // namespace ballbar
