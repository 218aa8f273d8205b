#include "page/pdf_file.hpp"

#include <cairo/cairo-pdf.h>
#include <fmt/format.h>
#include <librsvg/rsvg.h>

#include <memory>

#include "ballbar/error.hpp"
#include "page/report_page.hpp"

namespace ballbar {
namespace {

constexpr double kA4_pt[] = {210.0 / 25.4 * 72.0, 297.0 / 25.4 * 72.0};

cairo_status_t append(void* to, const unsigned char* bytes, unsigned int count) {
  static_cast<std::string*>(to)->append(reinterpret_cast<const char*>(bytes), count);
  return CAIRO_STATUS_SUCCESS;
}

[[noreturn]] void fail(GError* error) {
  const std::string why = error == nullptr ? "no reason" : error->message;
  g_clear_error(&error);
  throw Error(fmt::format("--format pdf: expected a drawing that can be written, found: {}.", why));
}

}  // namespace

void expect_pdf(std::string_view /*option*/) {}

std::string pdf_of(const std::string& svg, const std::string& title) {
  GError* error = nullptr;
  const std::unique_ptr<RsvgHandle, decltype(&g_object_unref)> drawing(
      rsvg_handle_new_from_data(reinterpret_cast<const guint8*>(svg.data()), svg.size(), &error), &g_object_unref);
  if (!drawing) fail(error);
  std::string bytes;
  const std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> surface(
      cairo_pdf_surface_create_for_stream(append, &bytes, kA4_pt[0], kA4_pt[1]), &cairo_surface_destroy);
  cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_TITLE, title.c_str());
  cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATE_DATE, page_date().c_str());
  {
    const std::unique_ptr<cairo_t, decltype(&cairo_destroy)> page(cairo_create(surface.get()), &cairo_destroy);
    const RsvgRectangle all{0.0, 0.0, kA4_pt[0], kA4_pt[1]};
    if (rsvg_handle_render_document(drawing.get(), page.get(), &all, &error) == FALSE) fail(error);
    cairo_show_page(page.get());
  }
  cairo_surface_finish(surface.get());
  const cairo_status_t status = cairo_surface_status(surface.get());
  if (status != CAIRO_STATUS_SUCCESS) {
    throw Error(
        fmt::format("--format pdf: expected a page that can be written, found: {}.", cairo_status_to_string(status)));
  }
  return bytes;
}

}  // namespace ballbar
