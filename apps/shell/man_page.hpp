// The page for man(1): `ballbar help --man`.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace ballbar {

// All commands and options, in roff.
std::string man_page(const CLI::App& app);

}  // namespace ballbar
