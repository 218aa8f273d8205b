// A drawing as a page of PDF. In a build without librsvg (BALLBAR_PDF=OFF) writing one throws.
#pragma once

#include <string>
#include <string_view>

namespace ballbar {

// Throws Error, beginning with `option`, in a build without PDF. Call it before doing the work.
void expect_pdf(std::string_view option);

// One A4 page filled with the SVG. Text stays text; the date is that of page_date(). Throws Error if the SVG cannot be
// drawn.
std::string pdf_of(const std::string& svg, const std::string& title);

}  // namespace ballbar
