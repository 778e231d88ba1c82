#pragma once
/// What stands between us and libav: a library of its own (`gambeson_film.so`, from cases/libav), which only the first
/// film loads. libav brings some ninety libraries, which would make every start of the program slower.

#include <array>
#include <cstdint>
#include <memory>
#include <string>

namespace gambeson {

enum class FilmFormat : int { mp4, webm, gif };

struct FilmShape {
  FilmFormat format = FilmFormat::mp4;
  int width = 0, height = 0;  ///< even, but for gif: H.264 and VP9 have a colour for each 2 x 2 pixels
  double fps = 25;
  std::array<std::uint32_t, 256> palette{};  ///< of gif: alpha, red, green, blue from the highest byte
};

class FilmEncoder {
 public:
  virtual ~FilmEncoder() = default;
  /// Rows from the top: red, green and blue of each pixel; of gif its place in the palette. Throws RunError.
  virtual void add(const unsigned char* pixels) = 0;
  /// The bytes of the file. Nothing can be added after it. Throws RunError.
  virtual std::string finish() = 0;
};

struct FilmModule {
  /// Throws RunError.
  std::unique_ptr<FilmEncoder> (*open)(const FilmShape& shape);
};

}  // namespace gambeson

extern "C" const gambeson::FilmModule* gambesonFilmModule();
