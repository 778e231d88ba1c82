#include "cases/pattern/flat_draft.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <ostream>

#include "cases/pattern/dxf_write.hpp"
#include "cases/pattern/pattern_file.hpp"
#include "cases/pattern/seam_text.hpp"
#include "cases/pattern/svg.hpp"
#include "core/error.hpp"
#include "core/io/own_file.hpp"
#include "tryon/pattern/flat/flatten_draft.hpp"
#include "tryon/pattern/flat/panel_geometry.hpp"

namespace gambeson {
namespace {

/// Sides of seams that differ by more than this are said.
constexpr double ease_share = 1e-3;

void say(const FlattenedDraft& flat, double limit, std::ostream& out) {
  const FlatPattern& p = flat.pattern;
  double area = 0;
  std::size_t widest = 5;
  for (const Panel& panel : p.panels) area += areaOf(panel), widest = std::max(widest, panel.name.size());
  out << fmt::format("{}: {} panels, {:.1f} cm^2, {} seams, without seam allowance\n\n", p.name, p.panels.size(),
                     1e4 * area, p.seams.size());
  out << fmt::format("{:{}}  {:>10}  {:>13}  {:>12}  {:>12}\n", "panel", widest, "area cm^2", "area strain",
                     "strain rms", "at most");
  for (std::size_t k = 0; k < p.panels.size(); ++k) {
    const Flattening& f = flat.flattening[k];
    out << fmt::format("{:{}}  {:10.2f}  {:11.3f} %  {:10.3f} %  {:10.3f} %\n", p.panels[k].name, widest,
                       1e4 * areaOf(p.panels[k]), 100 * f.area_change, 100 * f.rms_strain, 100 * f.largest_strain);
  }
  bool eased = false;
  for (const PanelSeam& s : p.seams) {
    const double a = lengthOf(p, s.a), b = lengthOf(p, s.b);
    if (std::abs(a - b) <= ease_share * std::max(a, b)) continue;
    if (!eased) out << "\nSeams whose sides came out unequal, to be eased:\n";
    eased = true;
    out << fmt::format("  {:4} {:7.2f} cm of {}, {:7.2f} cm of {}\n", s.name, 100 * a, partText(p, s.a.front()),
                       100 * b, partText(p, s.b.front()));
  }
  if (const std::string beyond = beyondText(flat, limit); !beyond.empty())
    out << fmt::format(
        "\nNot to be cut of this fabric, which stands {:.3g} %: {}. Darts or more panels are needed there.\n",
        100 * limit, beyond);
  out << "\n";
}

}  // namespace

void flatToFile(const Garment& garment, const std::filesystem::path& file, double limit, std::ostream& out) {
  const FlattenedDraft flat = flattenDraft(garment);
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  writeOwnFile(file, ending == ".dxf"   ? patternDxf(flat.pattern)
                     : ending == ".svg" ? patternSvg(flat.pattern)
                                        : patternText(flat.pattern));
  say(flat, limit, out);
  out << "Pattern: " << file.string() << "\n";
}

}  // namespace gambeson
