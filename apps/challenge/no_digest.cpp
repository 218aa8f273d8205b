// In place of digest.cpp where ballbar is built without OpenSSL.
#include "ballbar/error.hpp"
#include "challenge/digest.hpp"

namespace ballbar {
namespace {

[[noreturn]] void fail() {
  throw Error(
      "Expected a ballbar that can seal a blind test, found one built without OpenSSL. Install libssl-dev, configure "
      "with -D BALLBAR_BLIND=ON and build again.");
}

}  // namespace

void expect_seal() { fail(); }
std::string sha256(std::string_view) { fail(); }
std::string base64(std::string_view) { fail(); }
std::optional<std::string> from_base64(std::string_view) { fail(); }

}  // namespace ballbar
