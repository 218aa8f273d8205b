#include "text/readers.hpp"

#include <algorithm>

#include "text/head.hpp"
#include "text/located_text.hpp"

namespace ballbar {
namespace {

constexpr Reader kBinary = {
    .found = "a binary file",
    .is_yours = has_nul,
};

constexpr Reader kEmpty = {
    .found = "an empty file",
    .is_yours = [](std::string_view head) { return text_of_head(head).empty(); },
};

}  // namespace

std::span<const Reader> known_readers() {
  static const Reader kReaders[] = {
      readers::kB5r,
      readers::kBallbarLog,
      readers::kSession,
      readers::kRuns,
      readers::kModel,
      readers::kSeries,
      readers::kSchedule,
      readers::kCircleTable,
      // Of these two it is only known what they are not.
      readers::kLogWithoutHeader,
      readers::kOtherXml,
      readers::kLog,  // any table; the others know their own better
      kBinary,
      kEmpty,
  };
  return kReaders;
}

const Reader* reader_of(std::string_view head, std::span<const Reader> readers) {
  head = head.substr(0, kHeadBytes);
  std::string utf8;
  if (is_utf16(head)) {
    utf8 = utf8_from_utf16(head);
    head = utf8;
  }
  const auto reader =
      std::find_if(readers.begin(), readers.end(), [&](const Reader& one) { return one.is_yours(head); });
  return reader == readers.end() ? nullptr : &*reader;
}

std::string_view found_in(const Reader* reader) {
  return reader == nullptr ? "text of no known format" : reader->found;
}

}  // namespace ballbar
