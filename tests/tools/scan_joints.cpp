/// Where joints of scans are found against where they are: a table by body and joint, of own skins and of characters
/// with rigs, as they are and as scanners and poses change them.
///
///     scan_joints [DATA] [--all | --girths]
///
/// DATA: the folder of public files (body/ in it); without it own skins only. Prints the largest error of the sides of
/// each joint in cm and its parts (forward, outward, up) as they are; --all: of every change too, the largest alone;
/// --girths: girths against those in planes through the known joints. Exit 1 where a joint of our own skins is off by
/// more than 2 cm (but of those that are 1.1 times as large), or a body without its head is taken.

#include <fmt/format.h>

#include <filesystem>
#include <optional>

#include "core/error.hpp"
#include "human/manikin/manikin.hpp"
#include "human/scan/joints.hpp"
#include "human/scan/landmarks.hpp"
#include "human/scan/repair.hpp"
#include "human/scan/scan.hpp"
#include "human/scan/upright.hpp"
#include "tools/scan_bodies.hpp"

using namespace gambeson;

namespace {

constexpr std::array<const char*, 8> kLinks{"thigh", "shank", "foot", "upper_arm", "forearm", "hand", "torso", "head"};

/// Least squares: y = A x + b.
struct Affine {
  Mat3 A;
  Vec3 x0, y0;
  Vec3 operator()(const Vec3& x) const { return A * (x - x0) + y0; }
};

Affine affineBetween(const std::vector<Vec3>& x, const std::vector<Vec3>& y) {
  Affine f;
  f.x0 = f.y0 = {};
  const double n = static_cast<double>(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) f.x0 += x[i] / n, f.y0 += y[i] / n;
  Mat3 C{{}, {}, {}}, D{{}, {}, {}};  // columns
  for (std::size_t i = 0; i < x.size(); ++i) {
    const Vec3 d = x[i] - f.x0, e = y[i] - f.y0;
    C.a += d.x * d, C.b += d.y * d, C.c += d.z * d;
    D.a += d.x * e, D.b += d.y * e, D.c += d.z * e;
  }
  const double det = dot(C.a, cross(C.b, C.c));
  const Mat3 inv = transpose(Mat3{cross(C.b, C.c) / det, cross(C.c, C.a) / det, cross(C.a, C.b) / det});
  f.A = D * inv;
  return f;
}

std::map<std::string, Vec3> errorsOf(const test::KnownScan& s) {
  RepairReport report;
  const TriangleMesh raw = repaired(s.mesh, ScanOptions{}.close_holes, "scan", report);
  std::vector<std::string> notes;
  const TriangleMesh body = upright(raw, {}, "scan", notes);
  const Affine to = affineBetween(raw.vertices, body.vertices);
  const Landmarks marks = landmarksOf(body, "scan");
  const std::map<std::string, Vec3> joints = jointsOf(body, marks);
  checkLengths(joints, marks, "scan");
  std::map<std::string, Vec3> errors;
  for (const auto& [link, at] : s.joints) {
    if (!joints.contains(link)) continue;
    Vec3 e = joints.at(link) - to(at);
    if (link.ends_with("_right")) e.y = -e.y;
    errors[link] = e;
  }
  return errors;
}

Vec3 worse(const std::map<std::string, Vec3>& errors, const std::string& link) {
  if (errors.contains(link)) return errors.at(link);
  const Vec3 &l = errors.at(link + "_left"), &r = errors.at(link + "_right");
  return norm(l) > norm(r) ? l : r;
}

}  // namespace

int main(int argc, char** argv) {
  bool all = false, girths = false;
  std::filesystem::path data;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    (word == "--all" ? void(all = true) : word == "--girths" ? void(girths = true) : void(data = word));
  }
  std::vector<std::pair<std::string, test::KnownScan>> bodies;
  for (const std::string& m : manikinNames())
    for (const double arms : {25.0, 45.0, 85.0}) {
      if (!all && arms != 45) continue;
      bodies.emplace_back(fmt::format("{} {:.0f}", m, arms), test::knownScan(m, arms));
    }
  if (!data.empty()) {
    CharacterOptions mh, q;
    mh.file = data / "body/makehuman_base.obj";
    mh.skeleton = data / "body/makehuman_default.mhskel", mh.weights = data / "body/makehuman_default_weights.mhw";
    bodies.emplace_back("makehuman", test::knownScan(mh));
    mh.targets = {{data / "body/makehuman_caucasian_male_young.target", 1}};
    bodies.emplace_back("makehuman male", test::knownScan(mh));
    mh.targets.push_back({data / "body/makehuman_male_maxmuscle_averageweight.target", 1});
    bodies.emplace_back("mh muscular", test::knownScan(mh));
    q.file = data / "body/quaternius_Superhero_Male_FullBody.gltf";
    bodies.emplace_back("quaternius", test::knownScan(q));
  }
  if (girths) {
    for (const auto& [name, s] : bodies) {
      fmt::print("{:<18}", name);
      try {
        ScanReport report;
        scanOf(s.mesh, {}, &report);
        for (const ScanGirth& g : report.girths)
          if (s.girths.contains(g.name))
            fmt::print(" {} {:+.2f} %", g.name, 100 * (g.scan_m / s.girths.at(g.name) - 1));
        fmt::print("\n");
      } catch (const InputError& e) {
        fmt::print(" {}\n", e.what());
      }
    }
    return 0;
  }
  fmt::print("{:<18}", "body, cm");
  for (const char* link : kLinks) fmt::print("{:>20}", link);
  fmt::print("\n");
  // Returns the largest error [m], nothing where the scan is refused.
  const auto row = [&](const std::string& name, const test::KnownScan& s, bool parts) -> std::optional<double> {
    fmt::print("{:<18}", name);
    try {
      const auto errors = errorsOf(s);
      double most = 0;
      for (const char* link : kLinks) {
        const Vec3 e = worse(errors, link);
        most = std::max(most, norm(e));
        fmt::print("{:>20}",
                   parts ? fmt::format("{:.1f} ({:.1f} {:.1f} {:.1f})", 100 * norm(e), 100 * e.x, 100 * e.y, 100 * e.z)
                         : fmt::format("{:.1f}", 100 * norm(e)));
      }
      fmt::print("\n");
      return most;
    } catch (const InputError& e) {
      fmt::print(" {}\n", e.what());
      return std::nullopt;
    }
  };
  // What holds of our own skins: each joint within 2 cm.
  double most = 0;
  bool sound = true;
  const auto own = [&](const std::string& body, std::optional<double> error) {
    if (!body.starts_with("male") && !body.starts_with("female")) return;
    sound = sound && error;
    most = std::max(most, error.value_or(0));
  };
  for (auto& [name, s] : bodies) {
    double low = 1e9, high = -1e9;
    for (const Vec3& x : s.mesh.vertices) low = std::min(low, x.z), high = std::max(high, x.z);
    const double H = high - low;
    own(name, row(name, s, true));
    if (!all) continue;
    own(name, row("  2 mm noise", test::noisy(s, 0.002), false));
    own(name, row("  5 % fewer", test::decimated(s, 0.05), false));
    const auto turned = [](const Vec3& x) {
      const double c = std::cos(0.5), d = std::sin(0.5);
      return Vec3{c * x.x - d * x.y, -x.z, d * x.x + c * x.y} / 0.0254;
    };
    own(name, row("  turned, inches", test::moved(s, turned), false));
    row("  1.1 times", test::moved(s, [](const Vec3& x) { return 1.1 * x; }), false);
    const auto wider = [](const Vec3& x) { return Vec3{x.x, x.y > 0 ? 1.02 * x.y : x.y, x.z}; };
    own(name, row("  left 2 % wider", test::moved(s, wider), false));
    own(name, row("  holes at feet", test::without(s, [&](const Vec3& x) { return x.z < low + 0.006 * H; }), false));
    if (row("  head cut", test::without(s, [&](const Vec3& x) { return x.z > low + 0.90 * H; }), false)) sound = false;
  }
  if (all)
    for (const std::string m : {"male_p50", "female_p50"})
      for (const double legs : {4.0, 8.0, 12.0}) {
        const std::string name = fmt::format("{} legs {:.0f}", m, legs);
        own(name, row(name, test::knownScan(m, 45, legs), true));
      }
  fmt::print("own skins: at most {:.2f} cm\n", 100 * most);
  return sound && most < 0.02 ? 0 : 1;
}
