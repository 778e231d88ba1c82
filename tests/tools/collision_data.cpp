#include "collision_data.hpp"

#include <gmpxx.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/error.hpp"

namespace gambeson::collision {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void reject(const fs::path& file, int line, const std::string& reason) {
  throw InputError({file.string(), line, ""}, reason);
}

std::ifstream openFile(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) reject(file, 0, "cannot be opened");
  return in;
}

/// Nearest double (GMP truncates) of a rational number.
double nearest(const mpq_class& q) {
  const double a = q.get_d();
  const double b = std::nextafter(a, q > a ? INFINITY : -INFINITY);
  return abs(q - mpq_class(a)) <= abs(q - mpq_class(b)) ? a : b;
}

nlohmann::json readJson(const fs::path& file) {
  std::ifstream in = openFile(file);
  try {
    return nlohmann::json::parse(in);
  } catch (const nlohmann::json::exception& e) {
    reject(file, 0, e.what());
  }
}

enum class Scalar { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat, kDouble };

struct Property {
  std::string name;
  Scalar type = Scalar::kFloat, count = Scalar::kUint8;
  bool list = false;
};
struct Element {
  std::string name;
  long count = 0;
  std::vector<Property> properties;
};

class PlyReader {
 public:
  explicit PlyReader(const fs::path& file) : file_(file), in_(openFile(file)) {}

  Frame read() {
    const std::vector<Element> elements = header();
    Frame frame;
    for (const Element& e : elements) {
      for (long k = 0; k < e.count; ++k) {
        Vec3 x{NAN, NAN, NAN};
        for (const Property& p : e.properties) {
          const long n = p.list ? static_cast<long>(value(p.count)) : 1;
          std::array<double, 3> v{NAN, NAN, NAN};
          for (long i = 0; i < n; ++i) {
            const double c = value(p.type);
            if (i < 3) v[i] = c;
          }
          if (e.name == "vertex" && !p.list && p.name.size() == 1 && p.name >= "x" && p.name <= "z")
            x[p.name[0] - 'x'] = v[0];
          if (e.name == "face" && (p.name == "vertex_indices" || p.name == "vertex_index")) {
            if (n != 3)
              reject(file_, 0, "face " + std::to_string(k) + " has " + std::to_string(n) + " corners: triangles only");
            frame.faces.push_back({static_cast<int>(v[0]), static_cast<int>(v[1]), static_cast<int>(v[2])});
          }
        }
        if (e.name != "vertex") continue;
        for (int i = 0; i < 3; ++i)
          if (!std::isfinite(x[i])) reject(file_, 0, "vertex " + std::to_string(k) + " has no finite position");
        frame.vertices.push_back(x);
      }
    }
    for (const auto& f : frame.faces)
      for (int i : f)
        if (i < 0 || i >= static_cast<int>(frame.vertices.size()))
          reject(file_, 0, "a face names a vertex that is not there");
    return frame;
  }

 private:
  std::vector<Element> header() {
    std::vector<Element> elements;
    std::string line;
    for (int n = 1; std::getline(in_, line); ++n) {
      std::istringstream words(line);
      std::string word, type, name;
      words >> word;
      if (n == 1) {
        if (word != "ply") reject(file_, n, "not a PLY file");
      } else if (word == "format") {
        words >> type;
        text_ = type == "ascii";
        if (!text_ && type != "binary_little_endian" && type != "binary_big_endian")
          reject(file_, n, "unknown format " + type);
        swap_ = (type == "binary_big_endian") == (std::endian::native == std::endian::little);
      } else if (word == "element") {
        elements.emplace_back();
        if (!(words >> elements.back().name >> elements.back().count) || elements.back().count < 0)
          reject(file_, n, "an element without a count");
      } else if (word == "property") {
        if (elements.empty()) reject(file_, n, "a property before any element");
        Property p;
        words >> type;
        if (type == "list") {
          p.list = true;
          std::string count;
          words >> count >> type;
          p.count = scalar(count, n);
        }
        p.type = scalar(type, n);
        words >> p.name;
        elements.back().properties.push_back(p);
      } else if (word == "end_header") {
        return elements;
      }
    }
    reject(file_, 0, "the header has no end");
  }

  Scalar scalar(const std::string& name, int line) const {
    static const char* const names[][2] = {{"char", "int8"},     {"uchar", "uint8"},   {"short", "int16"},
                                           {"ushort", "uint16"}, {"int", "int32"},     {"uint", "uint32"},
                                           {"float", "float32"}, {"double", "float64"}};
    for (int i = 0; i < 8; ++i)
      if (name == names[i][0] || name == names[i][1]) return static_cast<Scalar>(i);
    reject(file_, line, "unknown type " + name);
  }

  template <class T>
  double binary() {
    std::array<char, sizeof(T)> bytes;
    if (!in_.read(bytes.data(), bytes.size())) reject(file_, 0, "ends before its last element");
    if (swap_) std::reverse(bytes.begin(), bytes.end());
    T v;
    std::memcpy(&v, bytes.data(), sizeof v);
    return static_cast<double>(v);
  }

  double value(Scalar type) {
    if (text_) {
      std::string word;
      if (!(in_ >> word)) reject(file_, 0, "ends before its last element");
      char* end = nullptr;
      const double v = std::strtod(word.c_str(), &end);
      if (*end) reject(file_, 0, "not a number: " + word);
      return v;
    }
    switch (type) {
      case Scalar::kInt8:
        return binary<std::int8_t>();
      case Scalar::kUint8:
        return binary<std::uint8_t>();
      case Scalar::kInt16:
        return binary<std::int16_t>();
      case Scalar::kUint16:
        return binary<std::uint16_t>();
      case Scalar::kInt32:
        return binary<std::int32_t>();
      case Scalar::kUint32:
        return binary<std::uint32_t>();
      case Scalar::kFloat:
        return binary<float>();
      default:
        return binary<double>();
    }
  }

  fs::path file_;
  std::ifstream in_;
  bool text_ = false, swap_ = false;
};

}  // namespace

PairKind kindOfPath(const fs::path& file) {
  const std::string stem = file.stem().string(), folder = file.parent_path().filename().string();
  const auto names = [&](const char* longName, const char* shortName) {
    const std::string first = stem.substr(0, stem.find('_'));
    return folder == longName || stem.find(longName) != std::string::npos || first.ends_with(shortName);
  };
  const bool ee = names("edge-edge", "ee"), vf = names("vertex-face", "vf");
  if (ee == vf) reject(file, 0, "its path says neither edge-edge (ee) nor vertex-face (vf): name the kind");
  return ee ? PairKind::kEdgeEdge : PairKind::kPointTriangle;
}

std::vector<Query> readQueries(const fs::path& csv) {
  std::ifstream in = openFile(csv);
  std::vector<Query> out;
  std::string text;
  int row = 0, line = 0;
  while (std::getline(in, text)) {
    ++line;
    if (!text.empty() && text.back() == '\r') text.pop_back();
    if (text.empty()) continue;
    std::vector<std::string> cells;
    std::istringstream stream(text);
    for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
    if (cells.size() != 6 && cells.size() != 7)
      reject(csv, line, "6 or 7 columns expected, got " + std::to_string(cells.size()));
    if (row == 0) out.emplace_back();
    Query& q = out.back();
    Vec3& x = (row < 4 ? q.x0 : q.x1)[row % 4];
    for (int k = 0; k < 3; ++k) {
      mpz_class n, d;
      if (n.set_str(cells[2 * k], 10) != 0 || d.set_str(cells[2 * k + 1], 10) != 0 || d == 0)
        reject(csv, line, "not a rational number: " + cells[2 * k] + "," + cells[2 * k + 1]);
      mpq_class value(n, d);
      value.canonicalize();
      x[k] = nearest(value);
      if (!std::isfinite(x[k])) reject(csv, line, "a coordinate beyond the doubles");
      const mpq_class error = abs(value - mpq_class(x[k]));
      if (error > 0) q.rounding = std::max(q.rounding, std::nextafter(error.get_d(), INFINITY));
    }
    if (cells.size() == 7) {
      if (cells[6] != "0" && cells[6] != "1") reject(csv, line, "truth is 0 or 1, got " + cells[6]);
      const bool truth = cells[6] == "1";
      if (row > 0 && q.truth != truth) reject(csv, line, "the rows of a query disagree about its truth");
      q.truth = truth;
    }
    row = (row + 1) % 8;
  }
  if (row != 0) reject(csv, line, "the last query has " + std::to_string(row) + " of 8 rows");
  return out;
}

Frame readPly(const fs::path& ply) { return PlyReader(ply).read(); }

std::vector<std::array<int, 2>> edgesOf(const Frame& frame) {
  std::vector<std::array<int, 2>> edges;
  for (const auto& f : frame.faces)
    for (int k = 0; k < 3; ++k) edges.push_back({std::min(f[k], f[(k + 1) % 3]), std::max(f[k], f[(k + 1) % 3])});
  std::sort(edges.begin(), edges.end(),
            [](const auto& a, const auto& b) { return a[1] != b[1] ? a[1] < b[1] : a[0] < b[0]; });
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

std::vector<std::array<int, 2>> readPairs(const fs::path& json) {
  try {
    return readJson(json).get<std::vector<std::array<int, 2>>>();
  } catch (const nlohmann::json::exception& e) {
    reject(json, 0, std::string("pairs of ids expected: ") + e.what());
  }
}

std::vector<bool> readTruth(const fs::path& json) {
  try {
    return readJson(json).get<std::vector<bool>>();
  } catch (const nlohmann::json::exception& e) {
    reject(json, 0, std::string("a list of true and false expected: ") + e.what());
  }
}

std::vector<Query> queriesOf(const Frame& start, const Frame& end, const std::vector<std::array<int, 2>>& pairs,
                             PairKind kind) {
  if (start.faces != end.faces || start.vertices.size() != end.vertices.size())
    throw InputError({}, "the two frames are not of one mesh");
  const auto edges = edgesOf(start);
  const int nv = static_cast<int>(start.vertices.size()), ne = static_cast<int>(edges.size()),
            nf = static_cast<int>(start.faces.size());
  std::vector<Query> out;
  for (const auto& [i, j] : pairs) {
    std::array<int, 4> v;
    if (kind == PairKind::kEdgeEdge) {
      if (std::min(i, j) < nv || std::max(i, j) >= nv + ne)
        throw InputError({}, "a pair of edges names an id that is no edge");
      v = {edges[i - nv][0], edges[i - nv][1], edges[j - nv][0], edges[j - nv][1]};
    } else {
      const int p = std::min(i, j), f = std::max(i, j) - nv - ne;
      if (p < 0 || p >= nv || f < 0 || f >= nf) throw InputError({}, "a pair names an id that is no vertex or no face");
      v = {p, start.faces[f][0], start.faces[f][1], start.faces[f][2]};
    }
    Query& q = out.emplace_back();
    for (int k = 0; k < 4; ++k) q.x0[k] = start.vertices[v[k]], q.x1[k] = end.vertices[v[k]];
  }
  return out;
}

}  // namespace gambeson::collision
