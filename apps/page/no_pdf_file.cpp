#include <fmt/format.h>

#include "ballbar/error.hpp"
#include "page/pdf_file.hpp"

namespace ballbar {

void expect_pdf(std::string_view option) {
  throw Error(fmt::format(
      "{}: this ballbar was built without PDF: expected librsvg when it was built; on Debian install librsvg2-dev, "
      "then "
      "run cmake -S . -B build -DBALLBAR_PDF=ON && cmake --build build. The page of --out page.html prints the same "
      "sheet.",
      option));
}

std::string pdf_of(const std::string& /*svg*/, const std::string& /*title*/) {
  expect_pdf("--format pdf");
  return {};
}

}  // namespace ballbar
