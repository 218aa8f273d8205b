// The caller of a command: a person at a terminal, or a program that runs it in its own process and takes its output.
#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace ballbar {

// Functions that replace the output streams; an empty one leaves the stream.
struct Caller {
  std::function<void(const nlohmann::ordered_json& json)> result;  // of a command with --json
  std::function<void(const std::string& line)> remark;             // a line of the standard error
  std::function<void(const std::string& file)> wrote;              // a file that was written
  // The progress line, which the next one replaces: text, or JSON with the results so far; empty: end.
  std::function<void(std::string_view line)> progress;
};

// The program that called a command in this thread; nullptr: a person at a terminal.
const Caller* caller();

// While it exists, `program` is the caller of commands in this thread. `program` must outlive it.
class CalledBy {
 public:
  explicit CalledBy(const Caller& program);
  CalledBy(const CalledBy&) = delete;
  CalledBy& operator=(const CalledBy&) = delete;
  ~CalledBy();

 private:
  const Caller* before_;
};

// The result of a command, for a program: to the caller, or to the standard output, with that indentation (-1: one
// line).
void print_json(const nlohmann::ordered_json& json, int indent = 2);

// Text for people only: to the standard output, but not to a program that takes results.
void print_for_people(const std::string& text);

// As print_json, of a text that is JSON already, laid out for people.
void print_json_text(const std::string& text);

}  // namespace ballbar
