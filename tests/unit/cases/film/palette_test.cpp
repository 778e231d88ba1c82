#include "cases/film/palette.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "cases/film/film.hpp"

namespace gambeson {
namespace {

Image filled(int width, int height, unsigned char r, unsigned char g, unsigned char b) {
  Image image{width, height, {}};
  for (int i = 0; i < width * height; ++i) image.rgb.insert(image.rgb.end(), {r, g, b});
  return image;
}

/// How far the palette's colour is from (r, g, b) in the channel where it is farthest.
int off(const Palette& palette, const std::array<unsigned char, 3>& rgb) {
  const std::uint32_t argb = palette.argb[palette.of_cell[ColorCount::cellOf(rgb.data())]];
  int most = 0;
  for (int c = 0; c < 3; ++c)
    most = std::max(most, std::abs(static_cast<int>(argb >> (16 - 8 * c) & 255) - rgb[static_cast<std::size_t>(c)]));
  return most;
}

TEST(FilmPalette, FewColoursStayAsTheyAre) {
  ColorCount count;
  count.add(filled(40, 30, 250, 250, 248));
  count.add(filled(3, 1, 255, 0, 148));
  count.add(filled(1, 1, 10, 200, 30));
  const Palette palette = paletteOf(count);
  EXPECT_EQ(off(palette, {250, 250, 248}), 0);
  EXPECT_EQ(off(palette, {255, 0, 148}), 0);
  EXPECT_EQ(off(palette, {10, 200, 30}), 0);
  EXPECT_EQ(palette.argb[255] >> 24, 0u);  // says that a pixel stays
  for (std::size_t k = 0; k < 255; ++k) EXPECT_EQ(palette.argb[k] >> 24, 255u);
}

/// A ramp of 60 x 60 colours gets 255 that lie as close as their number allows: 14 steps of 4.3 in either direction
/// would leave 9 of 255 at most, were they laid out as a grid.
TEST(FilmPalette, ManyColoursAreNearOneOfThePalette) {
  ColorCount count;
  for (int r = 0; r < 60; ++r)
    for (int g = 0; g < 60; ++g)
      count.add(filled(1, 1, static_cast<unsigned char>(4 * r), static_cast<unsigned char>(4 * g), 100));
  const Palette palette = paletteOf(count);
  int most = 0;
  for (int r = 0; r < 60; ++r)
    for (int g = 0; g < 60; ++g)
      most = std::max(most, off(palette, {static_cast<unsigned char>(4 * r), static_cast<unsigned char>(4 * g), 100}));
  EXPECT_LE(most, 16);
}

/// What is there a thousand times as often leaves the rare colour its own.
TEST(FilmPalette, RareColoursAreNotLost) {
  ColorCount count;
  for (int k = 0; k < 64; ++k)
    for (int l = 0; l < 64; ++l)
      count.add(filled(30, 30, static_cast<unsigned char>(200 + k / 2), static_cast<unsigned char>(190 + l), 220));
  count.add(filled(4, 4, 200, 20, 25));
  EXPECT_LE(off(paletteOf(count), {200, 20, 25}), 2);
}

TEST(FilmPalette, NothingHasNoColours) { EXPECT_EQ(paletteOf(ColorCount()).of_cell.size(), ColorCount::kCells); }

TEST(FilmFile, EndingSaysTheFormat) {
  FilmFormat format{};
  EXPECT_TRUE(isFilmFile("a/walk.MP4", format));
  EXPECT_EQ(format, FilmFormat::mp4);
  EXPECT_TRUE(isFilmFile("walk.webm", format));
  EXPECT_EQ(format, FilmFormat::webm);
  EXPECT_TRUE(isFilmFile("walk.gif", format));
  EXPECT_EQ(format, FilmFormat::gif);
  EXPECT_FALSE(isFilmFile("walk.png", format));
  EXPECT_FALSE(isFilmFile("walk.avi", format));
}

TEST(Film, PicturesOfAnotherSizeAreOurMistake) {
  Film film(FilmFormat::gif, 8, 8, 25);
  EXPECT_THROW(film.add(filled(8, 9, 1, 2, 3)), std::logic_error);
}

/// The signature of GIF, and the loop of an animated one.
TEST(Film, GifIsOne) {
  Film film(FilmFormat::gif, 16, 12, 25);
  film.add(filled(16, 12, 250, 250, 250));
  film.add(filled(16, 12, 20, 30, 240));
  const std::string bytes = film.finish();
  EXPECT_EQ(bytes.substr(0, 6), "GIF89a");
  EXPECT_NE(bytes.find("NETSCAPE2.0"), std::string::npos);
}

}  // namespace
}  // namespace gambeson
