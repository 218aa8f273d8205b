#include "terminal/caller.hpp"

#include <fmt/core.h>

#include <nlohmann/json.hpp>
#include <utility>

namespace ballbar {
namespace {

thread_local const Caller* the_caller = nullptr;

}  // namespace

const Caller* caller() { return the_caller; }

CalledBy::CalledBy(const Caller& program) : before_(std::exchange(the_caller, &program)) {}

CalledBy::~CalledBy() { the_caller = before_; }

void print_json(const nlohmann::ordered_json& json, int indent) {
  if (the_caller != nullptr && the_caller->result) return the_caller->result(json);
  fmt::print("{}\n", json.dump(indent, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

void print_json_text(const std::string& text) {
  if (the_caller != nullptr && the_caller->result) return the_caller->result(nlohmann::ordered_json::parse(text));
  fmt::print("{}", text);
}

void print_for_people(const std::string& text) {
  if (the_caller == nullptr || !the_caller->result) fmt::print("{}", text);
}

}  // namespace ballbar
