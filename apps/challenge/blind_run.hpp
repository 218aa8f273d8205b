// `ballbar blind run`.
#pragma once

namespace CLI {
class App;
}

namespace ballbar::commands {

void add_blind_run(CLI::App& blind);

}  // namespace ballbar::commands
