#pragma once
/// Text through FreeType in DejaVu Sans, which the distribution installs (package fonts-dejavu-core).

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "analysis/render/render.hpp"

namespace gambeson {

enum class FontWeight { regular, bold };

/// Where the distributions put the font; throws RunError that names the package where it is in none of `folders`.
std::filesystem::path findFont(FontWeight weight, const std::vector<std::filesystem::path>& folders);
const std::vector<std::filesystem::path>& fontFolders();

/// A font at one size in pixels. Text is UTF-8.
class Font {
 public:
  Font(const std::filesystem::path& file, double size_px);
  Font(Font&&) noexcept;
  ~Font();

  double size() const { return size_px_; }
  double width(const std::string& text) const;
  /// Draws with the left end of the baseline at (x, y), pixels from the top left.
  void draw(Image& image, double x, double y, const std::string& text, Color color) const;
  /// Breaks at " · " (dropped there) or else at spaces, so that each line is at most `width_px` wide; a longer word
  /// stands alone.
  std::vector<std::string> wrap(const std::string& text, double width_px) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
  double size_px_;
};

}  // namespace gambeson
