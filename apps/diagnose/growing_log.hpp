// A log that another program still writes: its whole lines, as a file that stands still.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace ballbar {

// Copies what has come, up to the end of the last whole line, to a file in memory, which goes with the program.
class GrowingLog {
 public:
  // "-": the standard input. Throws Error where it cannot be opened, or is no text of a row a line.
  explicit GrowingLog(const std::string& name);
  ~GrowingLog();
  GrowingLog(const GrowingLog&) = delete;
  GrowingLog& operator=(const GrowingLog&) = delete;

  // Takes what has come without waiting; whether anything had. Throws Error where the file became shorter, or another
  // one has its name.
  bool take();

  bool has_ended() const { return has_ended_; }      // the standard input: no more will come
  std::size_t lines() const { return lines_; }       // whole ones
  const std::string& copy() const { return copy_; }  // name of that file

  // The text with the name of the log where it has that of the copy: of a message.
  std::string with_its_name(std::string text) const;

 private:
  void expect_same_file() const;
  void keep(std::string_view bytes);

  std::string name_;
  int descriptor_ = 0, copy_descriptor_ = -1;
  std::string copy_;
  std::string rest_;  // of a line that is not whole
  std::size_t lines_ = 0, taken_ = 0;
  bool has_ended_ = false;
};

}  // namespace ballbar
