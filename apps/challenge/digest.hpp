// A digest (SHA-256), which nobody can keep while changing what it was made of, and base64. In a build without OpenSSL
// (BALLBAR_BLIND=OFF) every function throws an Error that says what to install.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace ballbar {

// Before anything is made that will be sealed, or read that was.
void expect_seal();

// SHA-256 (FIPS 180-4, by OpenSSL) in 64 hexadecimal digits.
std::string sha256(std::string_view bytes);

// RFC 4648 with padding, one line: not read at a glance, and no secret.
std::string base64(std::string_view bytes);
std::optional<std::string> from_base64(std::string_view text);  // nothing: not base64

}  // namespace ballbar
