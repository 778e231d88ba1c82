#include "cases/film/film.hpp"

#include <zlib.h>

#include <algorithm>
#include <cctype>

#include "core/error.hpp"
#include "core/io/beside.hpp"

namespace gambeson {
namespace {

const FilmModule& filmModule() {
  return *reinterpret_cast<const FilmModule* (*)()>(
      functionBeside("gambeson_film.so", "gambesonFilmModule", "libav"))();
}

std::string deflated(const std::vector<unsigned char>& bytes) {
  uLongf size = compressBound(bytes.size());
  std::string out(size, '\0');
  if (compress2(reinterpret_cast<Bytef*>(out.data()), &size, bytes.data(), bytes.size(), Z_BEST_SPEED) != Z_OK)
    throw RunError("a picture of a film cannot be kept: zlib fails");
  out.resize(size);
  return out;
}

void inflate(const std::string& bytes, std::vector<unsigned char>& out) {
  uLongf size = out.size();
  if (uncompress(out.data(), &size, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()) != Z_OK)
    throw RunError("a picture of a film cannot be kept: zlib fails");
}

}  // namespace

bool isFilmFile(const std::filesystem::path& file, FilmFormat& format) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  if (ending == ".mp4")
    format = FilmFormat::mp4;
  else if (ending == ".webm")
    format = FilmFormat::webm;
  else if (ending == ".gif")
    format = FilmFormat::gif;
  else
    return false;
  return true;
}

Film::Film(FilmFormat format, int width, int height, double fps) : shape_{format, width, height, fps, {}} {
  if (format != FilmFormat::gif) encoder_ = filmModule().open(shape_);
}

void Film::add(const Image& image) {
  if (image.width != shape_.width || image.height != shape_.height)
    throw std::logic_error("a picture of a film has another size than the film");
  if (encoder_) return encoder_->add(image.rgb.data());
  colors_.add(image);
  kept_.push_back(deflated(image.rgb));
}

std::string Film::finish() {
  if (encoder_) return encoder_->finish();
  const Palette palette = paletteOf(colors_);
  shape_.palette = palette.argb;
  const std::unique_ptr<FilmEncoder> encoder = filmModule().open(shape_);
  const std::size_t pixels = static_cast<std::size_t>(shape_.width) * static_cast<std::size_t>(shape_.height);
  std::vector<unsigned char> rgb(3 * pixels), places(pixels);
  for (const std::string& picture : kept_) {
    inflate(picture, rgb);
    for (std::size_t i = 0; i < pixels; ++i) places[i] = palette.of_cell[ColorCount::cellOf(&rgb[3 * i])];
    encoder->add(places.data());
  }
  return encoder->finish();
}

}  // namespace gambeson
