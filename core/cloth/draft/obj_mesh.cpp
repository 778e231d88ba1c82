#include "core/cloth/draft/obj_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <map>
#include <optional>
#include <string_view>
#include <tuple>
#include <utility>

#include "core/error.hpp"

namespace gambeson {
namespace {

constexpr std::size_t kMost = 500000;  ///< vertices or faces

std::vector<std::string_view> wordsOf(std::string_view line) {
  std::vector<std::string_view> words;
  for (std::size_t i = 0; i < line.size();) {
    const std::size_t from = line.find_first_not_of(" \t\r", i);
    if (from == std::string_view::npos) break;
    i = std::min(line.find_first_of(" \t\r", from), line.size());
    words.push_back(line.substr(from, i - from));
  }
  return words;
}

class ObjReader {
 public:
  explicit ObjReader(const std::filesystem::path& file) : file_(file) {}

  ObjContent read() {
    std::ifstream in(file_);
    if (!in) throw InputError({file_.string(), 0, ""}, "cannot be read");
    for (std::string line; std::getline(in, line);) {
      ++line_;
      const std::string_view text = std::string_view(line).substr(0, line.find('#'));
      const std::vector<std::string_view> words = wordsOf(text);
      if (!words.empty()) take(words);
    }
    if (in.bad()) throw InputError({file_.string(), line_, ""}, "cannot be read to its end");
    content_.mesh = finish();
    return std::move(content_);
  }

 private:
  struct Face {
    std::array<int, 3> v{}, vt{};
    std::string group, material, patch;
  };
  struct Line {
    std::string name, patch;
    std::vector<int> v;
    int line = 0;
  };

  [[noreturn]] void fail(const std::string& reason) const { throw InputError({file_.string(), line_, ""}, reason); }

  double number(std::string_view word) const {
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value))
      fail(fmt::format("\"{}\" is not a finite number", word));
    return value;
  }

  /// An index from 1, or from -1 backwards, among `count`; counted from 0.
  int index(std::string_view word, std::size_t count, const char* what) const {
    long value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    const long n = static_cast<long>(count), at = value > 0 ? value - 1 : n + value;
    if (error != std::errc() || end != word.data() + word.size() || value == 0 || at < 0 || at >= n)
      fail(fmt::format("\"{}\" is no {} of the {} before it", word, what, count));
    return static_cast<int>(at);
  }

  void take(const std::vector<std::string_view>& w) {
    if (w[0] == "v") {
      if (w.size() < 4) fail("a vertex needs three coordinates");
      if (vertices_.size() == kMost) fail("has more than 500,000 vertices");
      vertices_.push_back({number(w[1]), number(w[2]), number(w[3])});
    } else if (w[0] == "vt") {
      if (w.size() < 3) fail("a vt needs two coordinates");
      uv_.push_back({number(w[1]), number(w[2])});
    } else if (w[0] == "g") {
      edge_.reset();
      if (w.size() == 4 && w[1] == "edge")
        edge_ = {std::string(w[2]), std::string(w[3])};
      else
        group_ = w.size() > 1 ? std::string(w[1]) : "";
    } else if (w[0] == "usemtl") {
      material_ = w.size() > 1 ? std::string(w[1]) : "";
    } else if (w[0] == "f") {
      takeFace(w);
    } else if (w[0] == "vn") {
      ++content_.normals;
    } else if (w[0] == "mtllib") {
      ++content_.looks;
    } else if (w[0] == "l" && edge_) {
      Line line{edge_->first, edge_->second, {}, line_};
      for (std::size_t k = 1; k < w.size(); ++k)
        line.v.push_back(index(w[k].substr(0, w[k].find('/')), vertices_.size(), "vertex"));
      lines_.push_back(std::move(line));
    } else if (w[0] == "l" || w[0] == "p" || w[0] == "curv" || w[0] == "curv2" || w[0] == "surf") {
      ++content_.other_lines;
    }
  }

  void takeFace(const std::vector<std::string_view>& w) {
    if (w.size() < 4) fail("a face needs three corners or more");
    std::vector<int> v, vt;
    for (std::size_t k = 1; k < w.size(); ++k) {
      const std::size_t slash = w[k].find('/');
      v.push_back(index(w[k].substr(0, slash), vertices_.size(), "vertex"));
      const std::string_view rest = slash == std::string_view::npos ? "" : w[k].substr(slash + 1);
      const std::string_view second = rest.substr(0, rest.find('/'));
      vt.push_back(second.empty() ? -1 : index(second, uv_.size(), "vt"));
    }
    content_.cut_faces += v.size() > 3;
    for (std::size_t k = 2; k < v.size(); ++k) {
      if (faces_.size() == kMost) fail("has more than 500,000 triangles");
      faces_.push_back({{v[0], v[k - 1], v[k]}, {vt[0], vt[k - 1], vt[k]}, group_, material_, ""});
    }
  }

  /// Names the patches of faces.
  void sort() {
    const bool one_group =
        std::all_of(faces_.begin(), faces_.end(), [&](const Face& f) { return f.group == faces_[0].group; });
    const bool one_material =
        std::all_of(faces_.begin(), faces_.end(), [&](const Face& f) { return f.material == faces_[0].material; });
    const auto has_uv = [](const Face& f) { return f.vt[0] >= 0 && f.vt[1] >= 0 && f.vt[2] >= 0; };
    for (Face& f : faces_) {
      f.patch = f.group.empty() || (one_group && !one_material) ? f.material : f.group;
      content_.bare_faces += !has_uv(f);
    }
    if (content_.bare_faces == static_cast<int>(faces_.size())) content_.bare_faces = 0;
  }

  ClothMesh finish() {
    ClothMesh mesh;
    if (faces_.empty()) throw InputError({file_.string(), 0, ""}, "has no faces");
    sort();
    std::map<std::string, int> patches;
    for (const Face& f : faces_)
      if (patches.emplace(f.patch, static_cast<int>(patches.size())).second)
        mesh.patch_names.push_back(f.patch.empty() ? "patch_0" : f.patch);
    // Vertices that faces have, each place once, in the order of the file.
    std::vector<char> used(vertices_.size(), 0);
    for (const Face& f : faces_)
      for (int v : f.v) used[static_cast<std::size_t>(v)] = 1;
    std::map<std::tuple<double, double, double>, int> known;
    std::vector<int> vertex(vertices_.size(), -1);
    for (std::size_t i = 0; i < vertices_.size(); ++i) {
      if (!used[i]) continue;
      const Vec3& x = vertices_[i];
      const auto [at, is_new] = known.try_emplace({x.x, x.y, x.z}, static_cast<int>(mesh.vertices.size()));
      if (is_new) mesh.vertices.push_back(x);
      vertex[i] = at->second;
    }
    const bool with_uv = std::all_of(faces_.begin(), faces_.end(),
                                     [](const Face& f) { return f.vt[0] >= 0 && f.vt[1] >= 0 && f.vt[2] >= 0; });
    for (int p = 0; p < static_cast<int>(mesh.patch_names.size()); ++p)
      for (const Face& f : faces_) {
        if (patches.at(f.patch) != p) continue;
        std::array<int, 3> corner{};
        std::array<Vec2, 3> uv;
        for (std::size_t k = 0; k < 3; ++k) {
          corner[k] = vertex[static_cast<std::size_t>(f.v[k])];
          if (with_uv) uv[k] = uv_[static_cast<std::size_t>(f.vt[k])];
        }
        mesh.triangles.push_back(corner);
        mesh.patch.push_back(p);
        if (with_uv) mesh.uv.push_back(uv);
      }
    for (const Line& l : lines_) {
      const auto at = patches.find(l.patch);
      if (at == patches.end())
        throw InputError({file_.string(), l.line, ""},
                         fmt::format("edge {} is of patch \"{}\", which has no faces", l.name, l.patch));
      MeshLine line{l.name, at->second, {}};
      for (int v : l.v) line.vertices.push_back(vertex[static_cast<std::size_t>(v)]);
      mesh.lines.push_back(std::move(line));
    }
    return mesh;
  }

  std::filesystem::path file_;
  ObjContent content_;
  int line_ = 0;
  std::vector<Vec3> vertices_;
  std::vector<Vec2> uv_;
  std::vector<Face> faces_;
  std::vector<Line> lines_;
  std::string group_, material_;
  std::optional<std::pair<std::string, std::string>> edge_;
};

std::string oneWord(std::string name) {
  std::replace_if(
      name.begin(), name.end(), [](char c) { return c == ' ' || c == '\t' || c == '#'; }, '_');
  return name.empty() ? "unnamed" : name;
}

}  // namespace

ObjContent readObjContent(const std::filesystem::path& file) { return ObjReader(file).read(); }

ClothMesh readObj(const std::filesystem::path& file) {
  ClothMesh mesh = readObjContent(file).mesh;
  try {
    checkMesh(mesh);
  } catch (const InputError& e) {
    throw InputError({file.string(), 0, e.where().key}, e.reason());
  }
  return mesh;
}

std::string objText(const ClothMesh& m, const std::string& name) {
  std::string out =
      "# A garment of triangles, in metres. Groups are patches; vt: metres along weft and warp, triangle by triangle;\n"
      "# lines of a group \"edge NAME PATCH\" are edges that supports call by that name.\n";
  out += fmt::format("o {}\n", oneWord(name));
  for (const Vec3& x : m.vertices) out += fmt::format("v {:.17g} {:.17g} {:.17g}\n", x.x, x.y, x.z);
  for (const auto& corners : m.uv)
    for (const Vec2& at : corners) out += fmt::format("vt {:.17g} {:.17g}\n", at.x, at.y);
  for (std::size_t t = 0; t < m.triangles.size(); ++t) {
    if (t == 0 || m.patch[t] != m.patch[t - 1])
      out += fmt::format("g {}\n", oneWord(m.patch_names[static_cast<std::size_t>(m.patch[t])]));
    const auto& [a, b, c] = m.triangles[t];
    if (m.uv.empty())
      out += fmt::format("f {} {} {}\n", a + 1, b + 1, c + 1);
    else
      out += fmt::format("f {}/{} {}/{} {}/{}\n", a + 1, 3 * t + 1, b + 1, 3 * t + 2, c + 1, 3 * t + 3);
  }
  for (const MeshLine& line : m.lines) {
    out += fmt::format("g edge {} {}\nl", oneWord(line.name),
                       oneWord(m.patch_names[static_cast<std::size_t>(line.patch)]));
    for (int v : line.vertices) out += fmt::format(" {}", v + 1);
    out += "\n";
  }
  return out;
}

}  // namespace gambeson
