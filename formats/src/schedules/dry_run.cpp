#include "ballbar/formats/schedules/dry_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <map>

#include "schedules/dry_machine.hpp"

namespace ballbar {
namespace {

// A word of a block: G04, X300.; for Fanuc whether it has a point matters.
struct Word {
  double value = 0.0;
  bool has_point = false;
};

// The words of one block, G and M apart.
struct Block {
  std::vector<double> g, m;
  std::map<char, Word> others;
};

constexpr double kLongestDwell_s = 99999.999;  // of Fanuc and Siemens
constexpr double kLongestOfLinuxcnc_s = 1e9;   // it sets no limit

// In these it does not matter: units, plane and modes that are never left.
bool is_mode(double g, Dialect dialect) {
  if (g == 17.0 || g == 90.0 || g == 94.0 || g == 40.0) return true;
  return dialect == Dialect::siemens ? g == 710.0 : g == 21.0 || (g == 91.1 && dialect == Dialect::linuxcnc);
}

// Blanks between words alone; `at`: offset of the block in the text, for messages.
Block words_of(DryMachine& machine, std::string_view code, std::size_t at) {
  Block block;
  for (std::size_t i = 0; i < code.size();) {
    machine.offset = at + i;
    if (code[i] == ' ') {
      ++i;
      continue;
    }
    const char letter = code[i];
    std::string_view rest = code.substr(i + 1);
    const std::size_t length = std::min(rest.find(' '), rest.size());
    rest = rest.substr(0, length);
    Word word;
    const auto [end, error] = std::from_chars(rest.data(), rest.data() + length, word.value, std::chars_format::fixed);
    if (letter < 'A' || letter > 'Z' || error != std::errc{} || end != rest.data() + length ||
        !(word.value == word.value)) {
      machine.fail(fmt::format("expected a word such as X100, found {}.", in_quotes(code.substr(i, length + 1))));
    }
    word.has_point = rest.find('.') != std::string_view::npos;
    if (letter == 'G' || letter == 'M') {
      (letter == 'G' ? block.g : block.m).push_back(word.value);
    } else if (!block.others.emplace(letter, word).second) {
      machine.fail(fmt::format("expected each word once in a block, found {} again.", letter));
    }
    i += 1 + length;
  }
  machine.offset = at;
  return block;
}

// One block of Fanuc, Siemens or LinuxCNC. True where it ends the program.
class Blocks {
 public:
  Blocks(DryMachine& machine, Dialect dialect) : machine_(machine), dialect_(dialect) {}

  bool is_end(Block block, std::string_view message) {
    int motion = 0;
    bool waits = false;
    for (const double g : block.g) {
      if (g == 1.0 || g == 2.0 || g == 3.0) {
        motion = static_cast<int>(g);
      } else if (g == 4.0) {
        waits = true;
      } else if (g == 54.0) {
        machine_.set_zero();
      } else if (!is_mode(g, dialect_)) {
        machine_.fail(fmt::format("expected a G function of such a program, found G{}.", g));
      }
    }
    if (waits) {
      wait(block);
    } else {
      if (const std::optional<Word> speed = taken(block, 'S')) machine_.set_speed(speed->value);
      if (motion != 0) move(block, motion);
    }
    bool end = false;
    for (const double m : block.m) {
      if (m == 3.0) {
        machine_.turn();
      } else if (m == 5.0) {
        machine_.rest();
      } else if (m == 19.0) {
        taken(block, 'R');
        machine_.orient();
      } else if (m == 0.0) {
        machine_.stop(message);
      } else if (m == 30.0 || m == 2.0) {
        end = true;
      } else if (m < 40.0 || m > 49.0) {
        machine_.fail(fmt::format("expected an M function of such a program, found M{}.", m));
      }
    }
    if (!block.others.empty()) {
      machine_.fail(fmt::format("expected words of such a program, found {}.", block.others.begin()->first));
    }
    return end;
  }

 private:
  static std::optional<Word> taken(Block& block, char letter) {
    const auto found = block.others.find(letter);
    if (found == block.others.end()) return std::nullopt;
    const Word word = found->second;
    block.others.erase(found);
    return word;
  }

  // Fanuc counts in its least step, 0.001 mm or 0.001 s, where there is no point.
  double fine(const Word& word) const {
    return dialect_ == Dialect::fanuc && !word.has_point ? word.value / 1e3 : word.value;
  }

  void wait(Block& block) {
    const bool has_p = block.others.contains('P');
    const char letter = dialect_ == Dialect::siemens ? 'F' : dialect_ == Dialect::linuxcnc || has_p ? 'P' : 'X';
    const std::optional<Word> time = taken(block, letter);
    if (!time) machine_.fail(fmt::format("expected {} with the time of G4, found none.", letter));
    const bool in_ms = dialect_ == Dialect::fanuc && letter == 'P';
    machine_.wait(in_ms ? time->value / 1e3 : fine(*time),
                  dialect_ == Dialect::linuxcnc ? kLongestOfLinuxcnc_s : kLongestDwell_s);
  }

  void move(Block& block, int motion) {
    if (const std::optional<Word> feed = taken(block, 'F')) machine_.set_feed(feed->value);
    const auto place = [&](char letter, double otherwise) {
      const std::optional<Word> word = taken(block, letter);
      return word ? fine(*word) : otherwise;
    };
    const double from_x_mm = machine_.x_mm(), from_y_mm = machine_.y_mm();
    const double x_mm = place('X', from_x_mm), y_mm = place('Y', from_y_mm);
    if (motion == 1) return machine_.move(x_mm, y_mm);
    machine_.circle(x_mm, y_mm, from_x_mm + place('I', 0.0), from_y_mm + place('J', 0.0), motion == 3);
  }

  DryMachine& machine_;
  Dialect dialect_;
};

// A block without its comment, and the comment.
struct Split {
  std::string code;
  std::string_view comment;
};

// ( ) is blanked, so that the words keep their columns.
Split split_of(DryMachine& machine, std::string_view line, Dialect dialect) {
  Split split{std::string(line), {}};
  if (dialect == Dialect::siemens) {
    const std::size_t comment = std::min(line.find(';'), line.size());
    split.code.resize(comment);
    split.comment = line.substr(comment);
    return split;
  }
  const std::size_t begin = line.find('(');
  if (begin == std::string_view::npos) return split;
  const std::size_t end = line.find(')', begin);
  if (end == std::string_view::npos) machine.fail("expected a comment to end on its line, found no ).");
  split.comment = line.substr(begin + 1, end - begin - 1);
  if (split.comment.find('(') != std::string_view::npos) machine.fail("expected no ( in a comment, found one.");
  std::fill(split.code.begin() + static_cast<std::ptrdiff_t>(begin),
            split.code.begin() + static_cast<std::ptrdiff_t>(end) + 1, ' ');
  return split;
}

DryRun dry_run_of_blocks(const SourceText& text, Dialect dialect) {
  DryMachine machine(text);
  Blocks blocks(machine, dialect);
  std::string message;  // what the display shows
  bool ended = false;
  for (std::size_t at = 0; at < text.bytes.size() && !ended;) {
    std::string_view line = text.bytes.substr(at, text.bytes.find('\n', at) - at);
    machine.offset = at;
    if (dialect == Dialect::siemens && line.starts_with("MSG(") && line.ends_with(")")) {
      message = line.substr(4, line.size() - 5);
      std::erase(message, '"');
    } else if (dialect == Dialect::siemens && line == "SPOS=0") {
      machine.orient();
    } else if (line != "%" || dialect == Dialect::siemens) {
      Split split = split_of(machine, line, dialect);
      const std::string_view shown = split.comment;
      if (dialect == Dialect::fanuc) message = shown;
      if (dialect == Dialect::linuxcnc && shown.starts_with("MSG,")) message = shown.substr(4);
      Block block = words_of(machine, split.code, at);
      if (dialect == Dialect::fanuc && machine.run().dwells.empty() && block.others.size() == 1)
        block.others.erase('O');
      ended = blocks.is_end(std::move(block), message);
    }
    at += line.size() + 1;
  }
  if (!ended) {
    machine.offset = text.bytes.size();
    machine.fail("expected M30 or M2, found the end of the text.");
  }
  return machine.run();
}

}  // namespace

DryRun dry_run_of(std::string_view program, Dialect dialect, std::string_view name) {
  const SourceText text = source_text(program, name);
  return dialect == Dialect::heidenhain ? dry_run_of_plain_language(text) : dry_run_of_blocks(text, dialect);
}

}  // namespace ballbar
