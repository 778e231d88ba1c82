#include "cases/pattern/mesh_import.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <ostream>

#include "cases/input/message.hpp"
#include "cases/pattern/seam_text.hpp"
#include "core/cloth/draft/obj_mesh.hpp"
#include "core/error.hpp"
#include "human/files/mesh.hpp"
#include "human/files/read_text.hpp"
#include "tryon/pattern/flat/panel_geometry.hpp"
#include "tryon/pattern/flat/uv_islands.hpp"
#include "tryon/pattern/weld_mesh.hpp"

namespace gambeson {
namespace {

constexpr double kWeld_m = 1e-5;
constexpr double kFarthest_m = 1000;                  ///< from the origin, as of all meshes
constexpr double kSmallest_m = 0.05, kLargest_m = 4;  ///< of garments, from end to end
constexpr double kUsual_m[] = {0.25, 2.5};            ///< of most
constexpr double kSmallHole_m = 0.05;                 ///< around: smaller than any opening of a garment
constexpr double kFlatWithin = 0.2;                   ///< rms of lengths in uv beside those of the mesh

std::string endingOf(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  return ending;
}

std::string counted(int n, const char* one, const char* many) { return fmt::format("{} {}", n, n == 1 ? one : many); }

/// Of all named edges, from vertex to vertex.
std::size_t segmentsOf(const ClothMesh& mesh) {
  std::size_t count = 0;
  for (const MeshLine& line : mesh.lines) count += line.vertices.empty() ? 0 : line.vertices.size() - 1;
  return count;
}

class Importer {
 public:
  Importer(const std::filesystem::path& file, const ImportChoices& choices) : file_(file), choices_(choices) {}

  ImportedMesh import(const std::string& name) {
    out_.file.name = name;
    out_.file.source.file = file_.filename().string();
    const std::string ending = endingOf(file_);
    if (ending == ".json")
      ours();
    else if (ending == ".obj")
      obj();
    else
      ply();
    if (mesh().triangles.size() > kMostClothTriangles)
      throw InputError({file_.string(), 0, ""},
                       fmt::format("has {} triangles; allowed: {}. Cloth of 10,000 to 50,000 is fine enough for folds; "
                                   "coarsen it where it is made",
                                   mesh().triangles.size(), kMostClothTriangles));
    if (ending != ".json") {
      place();
      weld();
      layFlat();
      nameBorders();
    }
    out_.borders = bordersOf(mesh());
    if (!mesh().uv.empty()) out_.flat = flatOfIslands(mesh(), name);
    out_.flat.name = name;
    out_.flat.source = out_.file.source;
    sayHoles();
    return std::move(out_);
  }

 private:
  ClothMesh& mesh() { return out_.file.mesh; }
  void note(std::string words) { out_.notes.push_back(std::move(words)); }
  void drop(int n, const char* one, const char* many) {
    if (n > 0) out_.dropped.push_back(counted(n, one, many));
  }

  void ours() {
    if (!choices_.unit.empty() || !choices_.up.empty() || choices_.piece > 0)
      throw InputError({"command line", 0,
                        !choices_.unit.empty() ? "--unit"
                        : !choices_.up.empty() ? "--up"
                                               : "--piece"},
                       "has no meaning for a mesh of ours: it is one piece, in m, with z up");
    const std::string name = out_.file.name;
    out_.file = loadClothMesh(file_);
    out_.file.name = name;
  }

  void obj() {
    out_.file.source.format = "OBJ";
    readText(file_, 256u << 20);  // that it is there, a file, and not too large
    ObjContent content = readObjContent(file_);
    mesh() = std::move(content.mesh);
    drop(content.bare_faces, "face has no vt where others have: uv is left out",
         "faces have no vt where others have: uv is left out");
    drop(content.normals, "normal (vn)", "normals (vn)");
    drop(content.looks, "file of materials' looks (mtllib)", "files of materials' looks (mtllib)");
    drop(content.other_lines, "line, point or curve that names no edge", "lines, points and curves that name no edge");
    if (content.cut_faces > 0)
      note(counted(content.cut_faces, "face of more than three corners was cut into triangles",
                   "faces of more than three corners were cut into triangles"));
  }

  void ply() {
    out_.file.source.format = "PLY";
    // The reader takes nothing beyond 1000 m, and these may be mm.
    constexpr double per_unit = 1.0 / 1024;
    TriangleMeshWithUv read = loadTrianglesWithUv(file_, per_unit);
    ClothMesh& m = mesh();
    for (const Vec3& x : read.mesh.vertices) m.vertices.push_back((1 / per_unit) * x);
    m.triangles = std::move(read.mesh.triangles);
    m.patch_names = {"cloth"};
    m.patch.assign(m.triangles.size(), 0);
    if (m.triangles.empty()) throw InputError({file_.string(), 0, ""}, "has no faces");
    if (read.uv.empty()) return;
    for (const auto& t : m.triangles)
      m.uv.push_back({read.uv[static_cast<std::size_t>(t[0])], read.uv[static_cast<std::size_t>(t[1])],
                      read.uv[static_cast<std::size_t>(t[2])]});
  }

  /// Metres, z up.
  void place() {
    const double unit = choices_.unit.empty() ? 1 : metresOf(choices_.unit);
    out_.file.source.unit = choices_.unit.empty() ? "m" : choices_.unit;
    Vec3 low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
    for (const auto& t : mesh().triangles)
      for (const int v : t) {
        const Vec3& x = mesh().vertices[static_cast<std::size_t>(v)];
        low = {std::min(low.x, x.x), std::min(low.y, x.y), std::min(low.z, x.z)};
        high = {std::max(high.x, x.x), std::max(high.y, x.y), std::max(high.z, x.z)};
      }
    const double farthest = std::max(
        {std::abs(low.x), std::abs(low.y), std::abs(low.z), std::abs(high.x), std::abs(high.y), std::abs(high.z)});
    if (!(unit * farthest <= kFarthest_m))
      throw InputError(
          {file_.string(), 0, "vertices"},
          fmt::format("lie up to {:.4g} m from the origin; allowed: {:g} m. Move the mesh to where its wearer "
                      "stands, or say its unit with --unit",
                      unit * farthest, kFarthest_m));
    const double size = std::max({high.x - low.x, high.y - low.y, high.z - low.z});
    if (!(unit * size >= kSmallest_m && unit * size <= kLargest_m)) {
      std::string likely;
      for (const char* word : {"mm", "cm", "in", "dm", "m"})
        if (const double length = metresOf(word) * size; length >= kUsual_m[0] && length <= kUsual_m[1])
          likely += fmt::format("{}--unit {} ({:.3g} cm)", likely.empty() ? "" : " or ", word, 100 * length);
      throw InputError(
          {file_.string(), 0, "unit"},
          fmt::format("its largest extent is {:.4g}, which is {:.4g} m in {}; garments have {:g} to {:g} m. {} "
                      "files say no unit: say it with {}",
                      size, unit * size, out_.file.source.unit, kSmallest_m, kLargest_m, out_.file.source.format,
                      likely.empty() ? "--unit" : likely));
    }
    if (choices_.unit.empty())
      note(fmt::format("{} files say no unit: read in m, {:.1f} cm from end to end; --unit says another",
                       out_.file.source.format, 100 * size));
    const bool turned = choices_.up == "y";
    for (Vec3& x : mesh().vertices) x = Vec3{} + unit * (turned ? Vec3{x.z, x.x, x.y} : x);  // no -0
    const Vec3 e = high - low;
    if (choices_.up.empty() && e.y > 1.5 * e.z)
      note(fmt::format(
          "it is {:.1f} cm high along z, which is taken for up, and {:.1f} cm along y; if y is up, say --up y",
          100 * unit * e.z, 100 * unit * e.y));
  }

  void weld() {
    WeldedMesh welded;
    try {
      welded = weldMesh(mesh(), kWeld_m, choices_.piece);
    } catch (const InputError& e) {
      throw InputError({file_.string(), 0, e.where().key}, e.reason());
    }
    mesh() = std::move(welded.mesh);
    drop(welded.left, "triangle of other pieces", "triangles of other pieces");
    if (welded.welded > 0)
      note(counted(welded.welded, "vertex lies within 0.01 mm of another and is one with it",
                   "vertices lie within 0.01 mm of others and are one with them"));
    if (welded.turned > 0)
      note(counted(welded.turned, "triangle faced the other side than its neighbours and was turned",
                   "triangles faced the other side than their neighbours and were turned"));
  }

  void layFlat() {
    if (mesh().uv.empty()) return;
    UvFit fit = fitUv(mesh());
    const std::string words =
        fmt::format("lengths of edges in uv are {:.3f} to {:.3f} of those of the mesh (rms {:.1f} % off)", fit.least,
                    fit.most, 100 * fit.rms);
    if (fit.fault.empty() && !(fit.rms <= kFlatWithin))
      fit.fault = fmt::format("{}, more than {:.0f} %: it is a picture's", words, 100 * kFlatWithin);
    if (!fit.fault.empty()) {
      out_.dropped.push_back(fmt::format("uv: it is no flat shape of this cloth: {}", fit.fault));
      mesh().uv.clear();
      return;
    }
    int mirrored = 0;
    const std::size_t named = segmentsOf(mesh());
    mesh() = islandsOf(mesh(), fit.scale_m, mirrored);
    drop(static_cast<int>(named - segmentsOf(mesh())), "piece of a named edge that lies on no panel",
         "pieces of named edges that lie on no panel");
    note(fmt::format("uv is a flat shape of the cloth: a 1 of it is {:.6g} m, by least squares; {}", fit.scale_m,
                     words));
    if (mirrored > 0)
      note(counted(mirrored, "panel is mirrored in uv, and turned over", "panels are mirrored in uv, and turned over"));
  }

  /// Borders as edges that supports may name, part by part where they cross from patch to patch.
  void nameBorders() {
    ClothMesh& m = mesh();
    std::erase_if(m.lines, [](const MeshLine& l) { return l.vertices.size() < 2; });
    std::map<std::pair<int, int>, int> patch_of;
    for (std::size_t t = 0; t < m.triangles.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k) patch_of[{m.triangles[t][k], m.triangles[t][(k + 1) % 3]}] = m.patch[t];
    int number = 0;
    for (const std::vector<int>& chain : bordersOf(m)) {
      const std::string name = fmt::format("border_{}", ++number);
      if (std::any_of(m.lines.begin(), m.lines.end(), [&](const MeshLine& l) { return l.name == name; })) continue;
      const std::size_t n = chain.size(), first_line = m.lines.size();
      const auto patch = [&](std::size_t k) { return patch_of.at({chain[k % n], chain[(k + 1) % n]}); };
      std::size_t start = 0;
      while (start < n && patch(start) == patch(start + n - 1)) ++start;
      for (std::size_t i = 0; i < n; ++i) {
        const std::size_t k = start % n + i;
        if (m.lines.size() == first_line || m.lines.back().patch != patch(k))
          m.lines.push_back({name, patch(k), {chain[k % n]}});
        m.lines.back().vertices.push_back(chain[(k + 1) % n]);
      }
    }
  }

  void sayHoles() {
    if (out_.borders.empty()) note("it is closed: there is no opening for a body");
    for (std::size_t k = 0; k < out_.borders.size(); ++k) {
      const double length = lengthAround(mesh(), out_.borders[k]);
      const Vec3 x = mesh().vertices[static_cast<std::size_t>(out_.borders[k][0])];
      if (length < kSmallHole_m)
        note(fmt::format(
            "border_{} is a hole of {:.2f} cm around at ({:.1f}, {:.1f}, {:.1f}) cm; if none is meant, close "
            "it where the mesh is made",
            k + 1, 100 * length, 100 * x.x, 100 * x.y, 100 * x.z));
    }
  }

  const std::filesystem::path& file_;
  const ImportChoices& choices_;
  ImportedMesh out_;
};

/// What a terminal shows of a name from a file.
std::string shown(const std::string& text) { return messageText(text); }

}  // namespace

bool isClothMesh(const std::filesystem::path& file) {
  const std::string ending = endingOf(file);
  return ending == ".obj" || ending == ".ply";
}

ImportedMesh importMesh(const std::filesystem::path& file, const ImportChoices& choices, const std::string& name) {
  if (!choices.size.empty())
    throw InputError({"command line", 0, "--size"}, "has no meaning for " + file.string() + "; only DXF has sizes");
  if (!choices.up.empty() && choices.up != "y" && choices.up != "z")
    throw InputError({"command line", 0, "--up"}, "\"" + choices.up + "\" is no axis that can be up; allowed: y, z");
  return Importer(file, choices).import(name);
}

void sayMesh(const ImportedMesh& in, std::ostream& out) {
  const ClothMesh& m = in.file.mesh;
  const FlatPattern& flat = in.flat;
  double area = 0;
  std::size_t widest = 5;
  for (int p = 0; p < static_cast<int>(m.patch_names.size()); ++p) {
    area += areaOf(m, p);
    widest = std::max(widest, std::min<std::size_t>(40, shown(m.patch_names[static_cast<std::size_t>(p)]).size()));
  }
  const PatternSource& source = in.file.source;
  out << fmt::format("{}: {}, {} triangles, {} vertices, {:.1f} cm^2, {}, {} seams{}\n\n", shown(in.file.name),
                     counted(static_cast<int>(m.patch_names.size()), "patch", "patches"), m.triangles.size(),
                     m.vertices.size(), 1e4 * area, counted(static_cast<int>(in.borders.size()), "border", "borders"),
                     flat.seams.size(),
                     source.format.empty() ? "" : fmt::format(" ({}, {})", shown(source.format), shown(source.unit)));
  out << fmt::format("{:{}}  {:>9}  {:>10}{}\n", "patch", widest, "triangles", "area cm^2",
                     flat.panels.empty() ? "" : "    flat cm^2  outline cm");
  for (std::size_t p = 0; p < m.patch_names.size(); ++p) {
    out << fmt::format("{:{}}  {:9}  {:10.3f}", shown(m.patch_names[p]), widest,
                       std::count(m.patch.begin(), m.patch.end(), static_cast<int>(p)),
                       1e4 * areaOf(m, static_cast<int>(p)));
    if (!flat.panels.empty())
      out << fmt::format("   {:10.3f}  {:10.3f}", 1e4 * areaOf(flat.panels[p]),
                         100 * perimeterOf(flat.panels[p].outline));
    out << "\n";
  }
  if (!in.borders.empty()) out << fmt::format("\n{:10}{:>9}\n", "border", "cm");
  for (std::size_t k = 0; k < in.borders.size(); ++k)
    out << fmt::format("{:10}{:9.3f}\n", fmt::format("border_{}", k + 1), 100 * lengthAround(m, in.borders[k]));
  if (!flat.seams.empty()) out << fmt::format("\n{:6}{:>8}  {:>8}   sides, flat\n", "seam", "a cm", "b cm");
  for (const PanelSeam& s : flat.seams)
    out << fmt::format("{:6}{:8.3f}  {:8.3f}   {}, {}{}\n", s.name, 100 * lengthOf(flat, s.a),
                       100 * lengthOf(flat, s.b), shown(partText(flat, s.a[0])), shown(partText(flat, s.b[0])),
                       s.use == SeamUse::dart ? ", dart" : "");
}

}  // namespace gambeson
