// A drawing as a page of PDF. In a build without librsvg (BALLBAR_PDF=OFF) writing one throws.
#pragma once

#include <string>
#include <string_view>

namespace ballbar {

// Throws Error, beginning with `option`, where the program was built without; to be called before the work is done.
void expect_pdf(std::string_view option);

// One page of A4 with the SVG on all of it. The text stays text; the date in it is that of page_date(). Throws Error
// where the SVG cannot be drawn.
std::string pdf_of(const std::string& svg, const std::string& title);

}  // namespace ballbar
