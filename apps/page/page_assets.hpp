// The output of apps/page: the bytes for a page, with the hashes for its content security policy. Empty in a build
// without it (BALLBAR_PAGE=OFF).
#pragma once

#include <string_view>

namespace ballbar::page {

extern const std::string_view kScript, kScriptHash;  // of the page
extern const std::string_view kStyle, kStyleHash;
extern const std::string_view kPictures, kPicturesHash;  // draws the same pictures in node, without a page
extern const std::string_view kShell, kShellHash;        // page.html, with marks to fill in

}  // namespace ballbar::page
