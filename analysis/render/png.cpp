/// Detail of render.hpp: pictures as PNG files.

#include <png.h>

#include <cassert>
#include <csetjmp>

#include "analysis/render/render.hpp"
#include "core/error.hpp"
#include "core/io/own_file.hpp"

namespace gambeson {
namespace {

void append(png_structp png, png_bytep data, png_size_t size) {
  static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<const char*>(data), size);
}
void flush(png_structp) {}

}  // namespace

std::string encodePng(const Image& image) {
  assert(image.rgb.size() == 3 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
  std::string bytes;
  std::vector<png_const_bytep> rows;
  for (int y = 0; y < image.height; ++y)
    rows.push_back(image.rgb.data() + 3 * static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width));
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png ? png_create_info_struct(png) : nullptr;
  if (!info) {
    png_destroy_write_struct(&png, nullptr);
    throw RunError("cannot write a picture: libpng does not start");
  }
  if (setjmp(png_jmpbuf(png))) {  // NOLINT: libpng reports errors so; no object with a destructor starts below
    png_destroy_write_struct(&png, &info);
    throw RunError("cannot write a picture: libpng fails");
  }
  png_set_write_fn(png, &bytes, append, flush);
  png_set_IHDR(png, info, static_cast<png_uint_32>(image.width), static_cast<png_uint_32>(image.height), 8,
               PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
  png_write_info(png, info);
  for (png_const_bytep row : rows) png_write_row(png, row);
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  return bytes;
}

void writePng(const Image& image, const std::filesystem::path& file) { writeOwnFile(file, encodePng(image)); }

}  // namespace gambeson
