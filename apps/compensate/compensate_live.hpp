// `ballbar compensate --signals`: offsets row by row as rows arrive.
#pragma once

#include <string>
#include <string_view>

#include "compensate/compensation_options.hpp"

namespace ballbar {

enum class OffsetFormat { csv, jsonl, word };

struct LiveOptions {
  std::string signals;  // file, or "-": the standard input
  bool follow = false;  // wait for what is yet to be written to the file
  OffsetFormat format = OffsetFormat::csv;
};

// Offsets to the standard output, what is held and goes on to the standard error. Ends with the signals, or with
// SIGINT or SIGTERM after the row at hand; the state is kept. Throws Error: axes_of, the first line of the signals, a
// state of other axes, an output that nobody reads any more, a followed file that became shorter.
void compensate_live(const CompensationOptions& options, const LiveOptions& live);

}  // namespace ballbar
