#include "core/io/iges.hpp"
#include "core/io/own_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/nurbs/trim_arcs.hpp"
#include "core/nurbs/trim_faces.hpp"

namespace gambeson {
namespace {

constexpr double kMillimetres = 1e3;

/// Reals need a point, and "D" tells double precision.
std::string real(double v) {
  if (!std::isfinite(v)) throw std::logic_error("IGES has no number for what is not finite");
  std::string s = fmt::format("{}", v);
  const std::size_t e = s.find('e');
  std::string mantissa = s.substr(0, e);
  if (mantissa.find('.') == std::string::npos) mantissa += '.';
  return e == std::string::npos ? mantissa : mantissa + "D" + s.substr(e + 1);
}

std::string ascii(std::string s) {
  for (char& c : s)
    if (c < ' ' || c > '~') c = '_';
  return s;
}

/// A string counts its characters first (Hollerith).
std::string text(const std::string& s) { return fmt::format("{}H{}", s.size(), s); }

/// Directory entries and parameter records; an entity is known by the number of its first directory line.
class File {
 public:
  /// `status`: "00010500" for a curve in parameters that another entity owns, and the like. Returns the pointer to it.
  int add(int type, const char* status, const std::string& label, const std::vector<std::string>& parameters,
          int form = 0) {
    const int pointer = 2 * static_cast<int>(entities_.size()) + 1;
    const int first = static_cast<int>(records_.size()) + 1;
    std::string line;
    for (std::size_t k = 0; k <= parameters.size(); ++k) {
      std::string token = k == 0 ? std::to_string(type) : parameters[k - 1];
      token += k < parameters.size() ? ',' : ';';
      if (line.size() + token.size() > 64 && !line.empty()) {
        records_.push_back({line, pointer});
        line.clear();
      }
      for (; token.size() > 64; token.erase(0, 64)) records_.push_back({token.substr(0, 64), pointer});  // a long text
      line += token;
    }
    records_.push_back({line, pointer});
    entities_.push_back({type, form, first, static_cast<int>(records_.size()) - first + 1, status, label});
    return pointer;
  }

  std::string finish(const std::string& title) const {
    std::string out;
    int n = 0;
    const auto line = [&](const std::string& what, char section) {
      out += fmt::format("{:<72}{}{:>7}\n", what, section, ++n);
    };
    for (std::size_t i = 0; i < title.size() || i == 0; i += 72) line(title.substr(i, 72), 'S');
    const int start = n;

    std::string global;
    const auto put = [&](const std::string& s) { global += s + ','; };
    put("1H,");
    put("1H;");
    put(text(title));
    put(text("gambeson.igs"));
    put(text("Gambeson"));
    put(text("Gambeson"));
    for (const char* bits : {"32", "38", "6", "308", "15"}) put(bits);
    put(text(title));
    put("1.");
    put("2");  // millimetres
    put("2HMM");
    put("1");
    put("0.1");
    put(text("20000101.000000"));  // the same frame gives the same bytes
    put(real(1e-4));               // recordings keep single precision: 0.1 um of a metre
    put(real(1e4));
    put("");
    put("");
    put("11");  // 5.3
    put("0");
    global += text("20000101.000000") + ";";
    n = 0;
    // Texts may cross lines.
    for (std::size_t i = 0; i < global.size(); i += 72) line(global.substr(i, 72), 'G');
    const int globals = n;

    n = 0;
    for (const Entity& e : entities_) {
      line(fmt::format("{:>8}{:>8}{:>8}{:>8}{:>8}{:>8}{:>8}{:>8}{:>8}", e.type, e.first, 0, 0, 0, 0, 0, 0, e.status),
           'D');
      line(fmt::format("{:>8}{:>8}{:>8}{:>8}{:>8}{:>8}{:>8}{:>8}{:>8}", e.type, 0, 0, e.lines, e.form, "", "",
                       e.label.substr(0, 8), 0),
           'D');
    }
    const int directory = n;
    n = 0;
    for (const Record& r : records_) line(fmt::format("{:<64}{:>8}", r.data, r.pointer), 'P');
    const int parameters = n;
    n = 0;
    line(fmt::format("S{:>7}G{:>7}D{:>7}P{:>7}", start, globals, directory, parameters), 'T');
    return out;
  }

 private:
  struct Record {
    std::string data;
    int pointer;
  };
  struct Entity {
    int type, form, first, lines;
    std::string status, label;
  };
  std::vector<Record> records_;
  std::vector<Entity> entities_;
};

void append(std::vector<std::string>& to, const std::vector<double>& values) {
  for (const double v : values) to.push_back(real(v));
}

bool polynomial(const std::vector<double>& weights) {
  return std::all_of(weights.begin(), weights.end(), [&](double w) { return w == weights[0]; });
}

/// Whether the surface closes on itself: its first row of control points is its last, on clamped knots.
bool closes(const NurbsPatch& p, Direction direction) {
  const KnotVector& k = direction == Direction::u ? p.u : p.v;
  if (k.knots.front() != k.front() || k.knots.back() != k.back()) return false;
  const int nu = p.u.count(), nv = p.v.count();
  for (int i = 0; i < (direction == Direction::u ? nv : nu); ++i) {
    const int a = direction == Direction::u ? p.index(0, i) : p.index(i, 0),
              b = direction == Direction::u ? p.index(nu - 1, i) : p.index(i, nv - 1);
    if (p.points[static_cast<std::size_t>(a)] != p.points[static_cast<std::size_t>(b)] ||
        p.weights[static_cast<std::size_t>(a)] != p.weights[static_cast<std::size_t>(b)])
      return false;
  }
  return true;
}

std::vector<std::string> surface128(const NurbsPatch& p) {
  std::vector<std::string> out;
  for (const int n : {p.u.count() - 1, p.v.count() - 1, p.u.degree, p.v.degree, int(closes(p, Direction::u)),
                      int(closes(p, Direction::v)), int(polynomial(p.weights)), 0, 0})
    out.push_back(std::to_string(n));
  append(out, p.u.knots);
  append(out, p.v.knots);
  append(out, p.weights);
  for (const Vec3& x : p.points) append(out, {kMillimetres * x.x, kMillimetres * x.y, kMillimetres * x.z});
  append(out, {p.u.front(), p.u.back(), p.v.front(), p.v.back()});
  return out;
}

/// A rational B-spline curve; a plane one lies in the parameter plane, z = 0.
std::vector<std::string> curve126(const KnotVector& knots, const std::vector<double>& weights,
                                  const std::vector<Vec3>& points, bool plane) {
  std::vector<std::string> out;
  const bool closed = points.front() == points.back();
  for (const int n : {knots.count() - 1, knots.degree, int(plane), int(closed), int(polynomial(weights)), 0})
    out.push_back(std::to_string(n));
  append(out, knots.knots);
  append(out, weights);
  for (const Vec3& x : points) append(out, {x.x, x.y, x.z});
  append(out, {knots.front(), knots.back()});
  append(out, plane ? std::vector<double>{0, 0, 1} : std::vector<double>{0, 0, 0});
  return out;
}

Vec3 onSurface(const NurbsPatch& p, Vec2 uv) {
  return surfaceDerivatives(p, std::clamp(uv.x, p.u.front(), p.u.back()), std::clamp(uv.y, p.v.front(), p.v.back()))[0];
}

/// Points of the loop in space such that the chords stay within the tolerance of the middles of their arcs.
void refine(const NurbsPatch& p, const NurbsCurve& c, double t0, const Vec3& x0, double t1, const Vec3& x1,
            double tolerance_m, int depth, std::vector<Vec3>& points) {
  const double t = 0.5 * (t0 + t1);
  const Vec3 x = onSurface(p, curvePoint(c, t).point);
  if (depth < 3 || (depth < 12 && norm(x - 0.5 * (x0 + x1)) > tolerance_m)) {
    refine(p, c, t0, x0, t, x, tolerance_m, depth + 1, points);
    refine(p, c, t, x, t1, x1, tolerance_m, depth + 1, points);
  } else {
    points.push_back(x1);
  }
}

int loop142(File& file, const NurbsPatch& p, int surface, const TrimLoop& loop, double tolerance_m) {
  std::vector<int> flat;
  const Vec3 start = onSurface(p, curvePoint(loop[0], loop[0].knots.front()).point);
  std::vector<Vec3> points{start};
  for (const NurbsCurve& c : loop) {
    std::vector<Vec3> plane;
    for (const Vec2& uv : c.points) plane.push_back({uv.x, uv.y, 0});
    flat.push_back(file.add(126, "00010500", "", curve126(c.knots, c.weights, plane, true)));
    const std::vector<double> t = breakpoints(c.knots);
    for (std::size_t k = 0; k + 1 < t.size(); ++k)
      refine(p, c, t[k], points.back(), t[k + 1], onSurface(p, curvePoint(c, t[k + 1]).point), tolerance_m, 0, points);
  }
  points.back() = start;
  int parameters = flat[0];
  if (flat.size() > 1) {
    std::vector<std::string> parts{std::to_string(flat.size())};
    for (const int f : flat) parts.push_back(std::to_string(f));
    parameters = file.add(102, "00010500", "", parts);
  }
  KnotVector chain{1, {0}};
  for (std::size_t i = 0; i < points.size(); ++i) chain.knots.push_back(static_cast<double>(i));
  chain.knots.push_back(static_cast<double>(points.size() - 1));
  for (Vec3& x : points) x = kMillimetres * x;
  const int space =
      file.add(126, "00010000", "", curve126(chain, std::vector<double>(points.size(), 1), points, false));
  return file.add(142, "00010000", "",
                  {"0", std::to_string(surface), std::to_string(parameters), std::to_string(space), "1"});
}

void add(File& file, const IgesSurface& s, double tolerance_m) {
  const std::string name = ascii(s.name);
  const int property = file.add(406, "00010000", "", {"1", text(name)}, 15);
  const auto named = [&](std::vector<std::string> p) {
    p.insert(p.end(), {"0", "1", std::to_string(property)});  // no associations, one property
    return p;
  };
  if (s.trim.loops.empty()) {
    file.add(128, "00000000", name, named(surface128(s.patch)));
    return;
  }
  const int surface = file.add(128, "00010000", name, surface128(s.patch));
  for (const Trim& face : facesOf(s.patch, s.trim)) {
    std::vector<int> loops;
    bool outlined = false;
    for (const TrimLoop& loop : face.loops) {
      loops.push_back(loop142(file, s.patch, surface, loop, tolerance_m));
      outlined = outlined || trimBoundary(s.patch, {{loop}}).signed_area[0] > 0;
    }
    const std::size_t first_hole = outlined ? 1 : 0;
    std::vector<std::string> p{std::to_string(surface), outlined ? "1" : "0", std::to_string(loops.size() - first_hole),
                               std::to_string(outlined ? loops[0] : 0)};
    for (std::size_t k = first_hole; k < loops.size(); ++k) p.push_back(std::to_string(loops[k]));
    file.add(144, "00000000", name, named(p));
  }
}

}  // namespace

std::string igesText(const std::string& title, const std::vector<IgesSurface>& surfaces, double tolerance_m) {
  File file;
  for (const IgesSurface& s : surfaces) {
    validate(s.patch);
    add(file, s, tolerance_m);
  }
  return file.finish(ascii(title));
}

void writeIges(const std::filesystem::path& path, const std::string& title, const std::vector<IgesSurface>& surfaces) {
  writeOwnFile(path, igesText(title, surfaces));
}

}  // namespace gambeson
