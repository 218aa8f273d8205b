// List of recorded batches of thermal tests, `runs.csv`: the series files and notes about each.
//
//   # comments, only here
//   run,chamber_degC,speed_plan
//   20200615,25,2000 rpm
//   20200617,20to30,"1000, then 2000 rpm"
//
// The first column is `run`, the name of a file next to the list (20200615 means 20200615.csv; names that end in .csv
// stay), or `file`, a path relative to the list. All other columns are free text. A cell with a comma is in quotes, and
// a quote in it is doubled. A row is one line. Blanks around a cell are ignored.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace ballbar {

struct ListedRun {
  std::string name;                // the first cell, unchanged
  std::filesystem::path file;      // relative to the folder of the list; from open_runs() ready to open
  std::vector<std::string> about;  // one for each of RunList::columns; may be empty texts
  std::size_t line = 0;            // in the list, from 1
};

struct RunList {
  std::vector<std::string> columns;  // of `about`: all but the first
  std::vector<ListedRun> runs;       // 1 to 100 000, in the order of the list, no file twice
};

// Opens no file. `name` is used in messages. Throws Error with name:line:column: no header, another name of the first
// column, a row with a wrong number of cells, an empty name, a file twice, an absolute path or one with "..".
RunList read_runs(std::string_view bytes, std::string_view name);

// The list at `path`, with each `file` below the folder of the list and ready to open. Throws Error as read_runs()
// does, and if a link leads out of the folder. Does not check that the files exist.
RunList open_runs(const std::filesystem::path& path);

}  // namespace ballbar
