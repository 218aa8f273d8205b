// A log that another program is still writing: its complete lines, as a file that does not change.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace ballbar {

// Copies the log, up to the end of the last complete line, to a file in memory that ends with the program.
class GrowingLog {
 public:
  // "-": the standard input. Throws Error if it cannot be opened, or is not a text with one row per line.
  explicit GrowingLog(const std::string& name);
  ~GrowingLog();
  GrowingLog(const GrowingLog&) = delete;
  GrowingLog& operator=(const GrowingLog&) = delete;

  // Reads new data without waiting; returns whether there were any. Throws Error if the file became shorter or was
  // replaced.
  bool take();

  bool has_ended() const { return has_ended_; }      // end of the standard input
  std::size_t lines() const { return lines_; }       // number of complete lines
  const std::string& copy() const { return copy_; }  // name of the copy

  // A message with the name of the copy replaced by that of the log.
  std::string with_its_name(std::string text) const;

 private:
  void expect_same_file() const;
  void keep(std::string_view bytes);

  std::string name_;
  int descriptor_ = 0, copy_descriptor_ = -1;
  std::string copy_;
  std::string rest_;  // of an incomplete line
  std::size_t lines_ = 0, taken_ = 0;
  bool has_ended_ = false;
};

}  // namespace ballbar
