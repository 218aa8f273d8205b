#include "ballbar/advice.hpp"

#include <utility>

namespace ballbar {
namespace {

thread_local bool is_left_out = false;

}  // namespace

bool is_advised() { return !is_left_out; }

std::string advised(std::string_view advice) { return std::string(is_left_out ? "" : advice); }

WithoutAdvice::WithoutAdvice() : before_(std::exchange(is_left_out, true)) {}

WithoutAdvice::~WithoutAdvice() { is_left_out = before_; }

}  // namespace ballbar
