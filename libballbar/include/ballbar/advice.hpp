// What a sentence tells a person at a terminal to type. Where a page calls, it has fields instead, and such advice is
// left out of its sentences.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ballbar/error.hpp"

namespace ballbar {

// Whether a sentence may name options and commands.
bool is_advised();

// The advice, where a sentence may have it; else "".
std::string advised(std::string_view advice);

// An Error that options put right, "time-unit": a page goes to their fields.
class OptionError : public Error {
 public:
  OptionError(const std::string& what, std::vector<std::string> options) : Error(what), options_(std::move(options)) {}
  const std::vector<std::string>& options() const { return options_; }

 private:
  std::vector<std::string> options_;
};

// While it exists, sentences of this thread name no option and no command.
class WithoutAdvice {
 public:
  WithoutAdvice();
  WithoutAdvice(const WithoutAdvice&) = delete;
  WithoutAdvice& operator=(const WithoutAdvice&) = delete;
  ~WithoutAdvice();

 private:
  bool before_;
};

}  // namespace ballbar
