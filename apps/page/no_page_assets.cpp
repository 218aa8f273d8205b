#include "page/page_assets.hpp"

namespace ballbar::page {

const std::string_view kScript, kScriptHash, kStyle, kStyleHash, kPictures, kPicturesHash, kShell, kShellHash;

}  // namespace ballbar::page
