#include "analysis/render/text.hpp"

#include <ft2build.h>
#include FT_FREETYPE_H

#include <algorithm>
#include <cmath>
#include <sstream>

#include "analysis/render/canvas.hpp"
#include "core/error.hpp"

namespace gambeson {
namespace {

/// The code points of UTF-8 text; bytes that are not UTF-8 show as U+FFFD.
std::u32string decodeUtf8(const std::string& text) {
  std::u32string out;
  for (std::size_t i = 0; i < text.size();) {
    const unsigned char lead = static_cast<unsigned char>(text[i++]);
    const int more = lead < 0x80             ? 0
                     : (lead & 0xE0) == 0xC0 ? 1
                     : (lead & 0xF0) == 0xE0 ? 2
                     : (lead & 0xF8) == 0xF0 ? 3
                                             : -1;
    char32_t c = more == 0 ? lead : more == 1 ? lead & 0x1Fu : more == 2 ? lead & 0x0Fu : lead & 0x07u;
    bool good = more >= 0;
    for (int k = 0; good && k < more; ++k) {
      good = i < text.size() && (static_cast<unsigned char>(text[i]) & 0xC0) == 0x80;
      if (good) c = (c << 6) | (static_cast<unsigned char>(text[i++]) & 0x3Fu);
    }
    out.push_back(good ? c : U'\uFFFD');
  }
  return out;
}

}  // namespace

const std::vector<std::filesystem::path>& fontFolders() {
  static const std::vector<std::filesystem::path> folders{"/usr/share/fonts/truetype/dejavu",
                                                          "/usr/share/fonts/dejavu-sans-fonts", "/usr/share/fonts/TTF",
                                                          "/usr/share/fonts/dejavu", "/usr/local/share/fonts/dejavu"};
  return folders;
}

std::filesystem::path findFont(FontWeight weight, const std::vector<std::filesystem::path>& folders) {
  const std::string name = weight == FontWeight::bold ? "DejaVuSans-Bold.ttf" : "DejaVuSans.ttf";
  std::string looked;
  for (const auto& folder : folders) {
    std::error_code none;
    if (std::filesystem::is_regular_file(folder / name, none)) return folder / name;
    looked += (looked.empty() ? "" : ", ") + folder.string();
  }
  throw RunError("cannot draw text: the font " + name + " is in none of " + looked +
                 " (Debian package fonts-dejavu-core)");
}

struct Font::Impl {
  FT_Library library = nullptr;
  FT_Face face = nullptr;
  ~Impl() {
    if (face) FT_Done_Face(face);
    if (library) FT_Done_FreeType(library);
  }

  /// Calls visit(glyph slot, pen x in pixels) for each character with its bitmap, returns the end of the pen.
  template <class Visit>
  double walk(const std::string& text, bool bitmaps, Visit visit) const {
    double pen = 0;
    FT_UInt before = 0;
    for (const char32_t c : decodeUtf8(text)) {
      const FT_UInt glyph = FT_Get_Char_Index(face, c);
      FT_Vector kern{0, 0};
      if (before != 0 && FT_Get_Kerning(face, before, glyph, FT_KERNING_UNFITTED, &kern) == 0)
        pen += double(kern.x) / 64;
      before = glyph;
      // Light hinting moves outlines vertically only: crisp lines, true widths.
      if (FT_Load_Glyph(face, glyph, FT_LOAD_TARGET_LIGHT | (bitmaps ? FT_LOAD_RENDER : FT_LOAD_DEFAULT)) != 0)
        continue;
      visit(face->glyph, pen);
      pen += double(face->glyph->linearHoriAdvance) / 65536;
    }
    return pen;
  }
};

Font::Font(const std::filesystem::path& file, double size_px) : impl_(std::make_unique<Impl>()), size_px_(size_px) {
  if (FT_Init_FreeType(&impl_->library) != 0) throw RunError("cannot draw text: FreeType does not start");
  if (FT_New_Face(impl_->library, file.c_str(), 0, &impl_->face) != 0)
    throw RunError("cannot draw text: " + file.string() + " is not a font that FreeType reads");
  if (FT_Set_Char_Size(impl_->face, 0, static_cast<FT_F26Dot6>(std::lround(size_px * 64)), 72, 72) != 0)
    throw RunError("cannot draw text: the font " + file.string() + " has no size of " + std::to_string(size_px) +
                   " pixels");
}
Font::Font(Font&&) noexcept = default;
Font::~Font() = default;

double Font::width(const std::string& text) const {
  return impl_->walk(text, false, [](FT_GlyphSlot, double) {});
}

void Font::draw(Image& image, double x, double y, const std::string& text, Color color) const {
  const int base = static_cast<int>(std::lround(y));
  impl_->walk(text, true, [&](FT_GlyphSlot slot, double pen) {
    const FT_Bitmap& b = slot->bitmap;
    const int left = static_cast<int>(std::lround(x + pen)) + slot->bitmap_left, top = base - slot->bitmap_top;
    for (unsigned r = 0; r < b.rows; ++r)
      for (unsigned c = 0; c < b.width; ++c)
        blend(image, left + static_cast<int>(c), top + static_cast<int>(r), color,
              float(b.buffer[static_cast<std::ptrdiff_t>(r) * b.pitch + c]) / 255.0f);
  });
}

std::vector<std::string> Font::wrap(const std::string& text, double width_px) const {
  static const std::string separator = " \u00b7 ";
  std::vector<std::string> lines;
  const auto add = [&](const std::string& joint, const std::string& piece) {
    if (lines.empty() || width(lines.back() + joint + piece) > width_px) return false;
    lines.back() += joint + piece;
    return true;
  };
  for (std::size_t from = 0; from <= text.size();) {
    const std::size_t to = std::min(text.find(separator, from), text.size());
    const std::string phrase = text.substr(from, to - from);
    from = to + separator.size();
    if (phrase.empty() || add(separator, phrase)) continue;
    std::istringstream words(phrase);
    std::string word;
    for (bool first = true; words >> word; first = false)
      if (first || !add(" ", word)) lines.push_back(word);
  }
  return lines;
}

}  // namespace gambeson
