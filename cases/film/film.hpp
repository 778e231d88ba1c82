#pragma once
/// Films of pictures: MP4 (H.264), WebM (VP9) and GIF, through libav.

#include <filesystem>
#include <string>
#include <vector>

#include "analysis/render/render.hpp"
#include "cases/film/module.hpp"
#include "cases/film/palette.hpp"

namespace gambeson {

/// Endings of a format: .mp4, .webm, .gif. False for others.
bool isFilmFile(const std::filesystem::path& file, FilmFormat& format);

class Film {
 public:
  /// Throws RunError where libav cannot be loaded or lacks the format's encoder.
  Film(FilmFormat format, int width, int height, double fps);
  /// All pictures have the film's size. Throws RunError.
  void add(const Image& image);
  /// The bytes of the file; nothing can be added after it. Throws RunError.
  std::string finish();

 private:
  FilmShape shape_;
  std::unique_ptr<FilmEncoder> encoder_;
  // Of a GIF, whose palette is known at its end: its pictures, deflated.
  ColorCount colors_;
  std::vector<std::string> kept_;
};

}  // namespace gambeson
