// What apps/page is built to: bytes for a page, with the hashes that its content security policy names. Empty where
// the program was built without it (BALLBAR_PAGE=OFF).
#pragma once

#include <string_view>

namespace ballbar::page {

extern const std::string_view kScript, kScriptHash;  // of the page
extern const std::string_view kStyle, kStyleHash;
extern const std::string_view kPictures, kPicturesHash;  // draws the same pictures in node, without a page
extern const std::string_view kShell, kShellHash;        // page.html, with marks to fill in

}  // namespace ballbar::page
