// The keys that the text formats know, with unit and meaning. The readers refuse every other key by these lists, and
// the tables of formats/README.md are made from them.
#pragma once

#include <span>
#include <string_view>
#include <vector>

namespace ballbar {

struct Key {
  std::string_view name;
  std::string_view holds;  // a unit, or the type: "text", "true or false", "table"
  std::string_view meaning;
};

// The keys of one table of a file. Names of keys and tables in these texts stand in `backquotes`, as on the page.
struct KeyTable {
  std::string_view table;  // "`[bar]`"; empty: of the file itself
  std::span<const Key> keys;
};

std::vector<std::string_view> names_of(std::span<const Key> keys);

// By format, in the order of the file.
std::vector<KeyTable> session_keys();  // session.toml
std::vector<KeyTable> runs_keys();     // a list of runs
std::vector<KeyTable> log_keys();      // header of a ballbar log
std::vector<KeyTable> b5r_keys();      // elements of a .b5r that are read; others are no error
std::vector<KeyTable> series_keys();   // header of a series
std::vector<KeyTable> recipe_keys();   // how a kind of log is read
std::vector<KeyTable> model_keys();    // model .toml; the keys of an effect are its roles and parameters
std::vector<KeyTable> history_keys();  // [[history]] of a model

}  // namespace ballbar
