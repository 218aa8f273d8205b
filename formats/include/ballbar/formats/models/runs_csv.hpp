// List of recorded batches of thermal tests, `runs.csv`: which series files there are and what is known about each.
//
//   # comments, only here
//   run,chamber_degC,speed_plan
//   20200615,25,2000 rpm
//   20200617,20to30,"1000, then 2000 rpm"
//
// The first column is `run`, the stem of a file beside the list (20200615 means 20200615.csv; what ends in .csv is
// taken as it is), or `file`, a path relative to the list. All other columns are free text. A cell with a comma stands
// in quotes, a quote in it is doubled; a row is one line. Blanks around a cell are not part of it.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace ballbar {

struct ListedRun {
  std::string name;                // the first cell as it stands
  std::filesystem::path file;      // relative to the list's folder, or as open_runs
  std::vector<std::string> about;  // one for each of RunList::columns; may be empty texts
  std::size_t line = 0;            // in the list, from 1
};

struct RunList {
  std::vector<std::string> columns;  // of `about`: all but the first
  std::vector<ListedRun> runs;       // 1 to 100 000, in the order of the list, no file twice
};

// Pure: opens nothing. `name` stands in messages. Throws Error with name:line:column: no header, a first column of
// another name, a short or long row, an empty name, a file twice, a path that is absolute or leaves the folder by "..".
RunList read_runs(std::string_view bytes, std::string_view name);

// The list at `path`, each `file` below the list's folder and ready to be opened. Throws Error as read_runs, and where
// a link leads out of the folder. Whether the files exist is for who opens them.
RunList open_runs(const std::filesystem::path& path);

}  // namespace ballbar
