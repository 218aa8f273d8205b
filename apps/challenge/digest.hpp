// SHA-256 digests and base64. In a build without OpenSSL (BALLBAR_BLIND=OFF) every function throws an Error that states
// what to install.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace ballbar {

// Call this before creating data to be sealed, and before reading sealed data.
void expect_seal();

// SHA-256 (FIPS 180-4, by OpenSSL) in 64 hexadecimal digits.
std::string sha256(std::string_view bytes);

// Base64 by RFC 4648 with padding, in one line. Hides the text from a casual look; it is not encryption.
std::string base64(std::string_view bytes);
std::optional<std::string> from_base64(std::string_view text);  // nullopt: not base64

}  // namespace ballbar
