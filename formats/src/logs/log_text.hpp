// Reads the text of a log in any encoding, line by line and never as a whole.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

#include "ballbar/formats/text/source.hpp"

namespace ballbar {

// "UTF-8", "UTF-16LE", "UTF-16BE", "WINDOWS-1252", "WINDOWS-1251", "GB18030", "CP949", "SHIFT_JIS", as iconv knows
// them, by the first bytes: a byte order mark; NULs at every other place; what is UTF-8; pairs of bytes as Chinese,
// Korean and Japanese have them; words of Cyrillic letters; else Windows-1252. Empty: a binary file.
struct TextEncoding {
  std::string name;
  std::size_t mark = 0;  // bytes of the byte order mark
};
TextEncoding encoding_of(std::string_view head);

// Lines in UTF-8; one that is not, in a file that is, is in Windows-1252. A quoted cell may hold line ends: it is
// one line then. Views are valid until the next call.
class LogLines {
 public:
  LogLines(Source source, const TextEncoding& encoding);
  ~LogLines();
  LogLines(const LogLines&) = delete;
  LogLines& operator=(const LogLines&) = delete;

  // Returns false at the end. `quotes`: a line with an odd number of them continues. Throws Error for a line above 4
  // MiB.
  bool next(bool quotes);

  [[nodiscard]] std::string_view line() const { return line_; }  // without its end
  [[nodiscard]] std::size_t number() const { return number_; }   // of its first line, from 1

 private:
  bool refill();

  Source source_;
  std::size_t read_ = 0;  // bytes of the source
  struct Decoder;
  std::unique_ptr<Decoder> decoder_;
  std::string other_line_;  // that is not UTF-8
  std::string buffer_;
  std::size_t at_ = 0;
  std::string_view line_;
  std::size_t number_ = 0, lines_ = 0;
  bool ended_ = false;
  bool returns_ = false;  // lines end with a carriage return alone
};

}  // namespace ballbar
