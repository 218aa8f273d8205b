// A seal: a digest that nobody can keep while changing what it was made of.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace ballbar {

// SHA-256 (FIPS 180-4, by OpenSSL) in 64 hexadecimal digits.
std::string sha256(std::string_view bytes);

// RFC 4648 with padding, one line: not read at a glance, and no secret.
std::string base64(std::string_view bytes);
std::optional<std::string> from_base64(std::string_view text);  // nothing: not base64

}  // namespace ballbar
