#include "analysis/animation/glb.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>

#include "analysis/animation/glb_buffer.hpp"
#include "analysis/render/colormap.hpp"
#include "analysis/render/geometry.hpp"
#include "core/error.hpp"

namespace gambeson {
namespace {

using Json = GlbBuffer::Json;
using Form = GlbBuffer::Form;

constexpr Form kScalars{GlbBuffer::kFloat, "SCALAR", 1, 0, false, false};
constexpr Form kTimes{GlbBuffer::kFloat, "SCALAR", 1, 0, false, true};
constexpr Form kVectors{GlbBuffer::kFloat, "VEC3", 3, 0, false, false};
constexpr Form kPositions{GlbBuffer::kFloat, "VEC3", 3, 0, false, true};
constexpr Form kQuaternions{GlbBuffer::kFloat, "VEC4", 4, 0, false, false};
constexpr Form kMatrices{GlbBuffer::kFloat, "MAT4", 16, 0, false, false};
constexpr Form kIndices{GlbBuffer::kUnsignedInt, "SCALAR", 1, 0, false, false};
constexpr Form kJoints{GlbBuffer::kUnsignedShort, "VEC4", 4, 0, false, false};
constexpr Form kColors{GlbBuffer::kUnsignedShort, "VEC4", 4, 0, true, false};
/// Three numbers of 16 bits, padded to a whole number of words.
constexpr Form kQuanta{GlbBuffer::kShort, "VEC3", 3, 4, false, true};

using Quaternion = std::array<double, 4>;  ///< x, y, z, w

/// The larger of four ways to the same, so that nothing small is divided by (Shepperd 1978).
Quaternion quaternionOf(const Mat3& R) {
  const double xx = R.a.x, yy = R.b.y, zz = R.c.z;
  const std::array<double, 4> four{1 + xx - yy - zz, 1 - xx + yy - zz, 1 - xx - yy + zz, 1 + xx + yy + zz};
  const auto k = std::max_element(four.begin(), four.end()) - four.begin();
  const double h = 0.5 * std::sqrt(four[static_cast<std::size_t>(k)]), d = 0.25 / h;
  const double xy = R.a.y + R.b.x, yz = R.b.z + R.c.y, zx = R.c.x + R.a.z;
  const double wx = R.b.z - R.c.y, wy = R.c.x - R.a.z, wz = R.a.y - R.b.x;
  if (k == 0) return {h, d * xy, d * zx, d * wx};
  if (k == 1) return {d * xy, h, d * yz, d * wy};
  if (k == 2) return {d * zx, d * yz, h, d * wz};
  return {d * wx, d * wy, d * wz, h};
}

template <class T>
void append(std::vector<float>& out, const T& numbers) {
  for (const double v : numbers) out.push_back(static_cast<float>(v));
}
void append(std::vector<float>& out, const Vec3& v) { append(out, std::array{v.x, v.y, v.z}); }

std::uint16_t linear16(float srgb) {
  return static_cast<std::uint16_t>(std::lround(65535 * std::clamp(linearOfSrgb(srgb), 0.f, 1.f)));
}

class Encoder {
 public:
  explicit Encoder(const AnimatedScene& scene) : scene_(scene) {
    if (scene.time_s.empty()) throw std::logic_error("an animation needs a time");
    for (const double t : scene.time_s) times_.push_back(static_cast<float>(t - scene.time_s[0]));
  }

  Glb encode() {
    // Our x, y, z become z, x, y: a turn about (1, 1, 1).
    nodes_.push_back({{"name", "world"}, {"rotation", {-0.5, -0.5, -0.5, 0.5}}});
    for (const MovedNode& n : scene_.nodes) addNode(n);
    for (const FixedMesh& m : scene_.fixed) addFixed(m);
    for (const MovingMesh& m : scene_.moving) addMoving(m);
    for (const SkinnedMesh& m : scene_.skinned) addSkinned(m);
    return {file(), error_m_};
  }

 private:
  bool moves() const { return times_.size() > 1; }

  int addChild(int parent, Json node) {
    const int at = static_cast<int>(nodes_.size());
    nodes_.push_back(std::move(node));
    nodes_[static_cast<std::size_t>(parent)]["children"].push_back(at);
    return at;
  }

  void animate(int node, const char* path, const std::vector<float>& output, const Form& form) {
    if (times_accessor_ < 0) times_accessor_ = buffer_.put(times_, GlbBuffer::none, kTimes);
    channels_.push_back({{"sampler", samplers_.size()}, {"target", {{"node", node}, {"path", path}}}});
    samplers_.push_back({{"input", times_accessor_},
                         {"interpolation", "LINEAR"},
                         {"output", buffer_.put(output, GlbBuffer::none, form)}});
  }

  /// Node k of the scene is node k + 1 of the file.
  void addNode(const MovedNode& n) {
    const std::size_t count = n.at.size();
    if (count != 1 && count != times_.size()) throw std::logic_error("a node needs one place, or one for each time");
    std::vector<float> origin, turn, scale;
    Quaternion last{0, 0, 0, 0};
    for (const Placement& X : n.at) {
      Quaternion q = quaternionOf(X.rotation);
      double towards = 0, square = 0;
      for (std::size_t k = 0; k < 4; ++k) towards += q[k] * last[k], square += q[k] * q[k];
      for (double& v : q) v *= (towards < 0 ? -1 : 1) / std::sqrt(square);  // the shorter way from one to the next
      last = q;
      append(origin, X.origin);
      append(turn, q);
      append(scale, Vec3{X.scale, X.scale, X.scale});
    }
    const auto firstOf = [](const std::vector<float>& v, std::size_t numbers) {
      return std::vector<float>(v.begin(), v.begin() + static_cast<std::ptrdiff_t>(numbers));
    };
    const int at = addChild(n.parent + 1, {{"name", n.name},
                                           {"rotation", firstOf(turn, 4)},
                                           {"translation", firstOf(origin, 3)},
                                           {"scale", firstOf(scale, 3)}});
    const auto varies = [&](const std::vector<float>& v, std::size_t numbers) {
      for (std::size_t i = numbers; i < v.size(); ++i)
        if (v[i] != v[i % numbers]) return true;
      return false;
    };
    if (varies(turn, 4)) animate(at, "rotation", turn, kQuaternions);
    if (varies(origin, 3)) animate(at, "translation", origin, kVectors);
    if (varies(scale, 3)) animate(at, "scale", scale, kVectors);
  }

  int material(const Color& c, bool both_sides) {
    const auto of = [](float v) { return static_cast<double>(linearOfSrgb(v)); };
    const Json m{
        {"pbrMetallicRoughness",
         {{"baseColorFactor", {of(c.r), of(c.g), of(c.b), 1.0}}, {"metallicFactor", 0.0}, {"roughnessFactor", 0.85}}},
        {"doubleSided", both_sides}};
    std::size_t k = 0;
    while (k < materials_.size() && materials_[k] != m) ++k;
    if (k == materials_.size()) materials_.push_back(m);
    return static_cast<int>(k);
  }

  int indicesOf(const std::vector<std::array<int, 3>>& triangles) {
    std::vector<std::uint32_t> corners;
    for (const auto& t : triangles)
      for (const int v : t) corners.push_back(static_cast<std::uint32_t>(v));
    return buffer_.put(corners, GlbBuffer::indices, kIndices);
  }

  int vectorsOf(const std::vector<Vec3>& x, const Form& form) {
    std::vector<float> numbers;
    for (const Vec3& v : x) append(numbers, v);
    return buffer_.put(numbers, GlbBuffer::vertices, form);
  }

  int addMesh(const std::string& name, Json primitive, Json more = Json::object()) {
    Json mesh{{"name", name}, {"primitives", {std::move(primitive)}}};
    mesh.update(more);
    meshes_.push_back(std::move(mesh));
    return static_cast<int>(meshes_.size()) - 1;
  }

  void addFixed(const FixedMesh& m) {
    if (m.mesh.triangles.empty()) return;
    Json attributes{{"POSITION", vectorsOf(m.mesh.vertices, kPositions)}};
    if (!m.mesh.normals.empty()) attributes["NORMAL"] = vectorsOf(m.mesh.normals, kVectors);
    const int mesh = addMesh(m.name, {{"attributes", attributes},
                                      {"indices", indicesOf(m.mesh.triangles)},
                                      {"material", material(m.mesh.color, false)}});
    addChild(m.node + 1, {{"name", m.name}, {"mesh", mesh}});
  }

  void addSkinned(const SkinnedMesh& m) {
    std::vector<std::uint16_t> joints;
    std::vector<float> weights, matrices;
    for (const auto& of : m.weights)
      for (const auto& [node, weight] : of) {
        joints.push_back(static_cast<std::uint16_t>(weight > 0 ? node : 0));
        weights.push_back(weight);
      }
    for (const Pose& X : m.inverse_bind) {
      const Mat3& R = X.rotation;
      append(matrices, std::array{R.a.x, R.a.y, R.a.z, 0., R.b.x, R.b.y, R.b.z, 0., R.c.x, R.c.y, R.c.z, 0., X.origin.x,
                                  X.origin.y, X.origin.z, 1.});
    }
    std::vector<Vec3> normals = smoothNormals({m.rest, m.triangles, {}, {}, false, {}});
    for (Vec3& n : normals)
      if (!(norm2(n) > 0)) n = {0, 0, 1};  // of no triangle
    const Json attributes{{"POSITION", vectorsOf(m.rest, kPositions)},
                          {"NORMAL", vectorsOf(normals, kVectors)},
                          {"JOINTS_0", buffer_.put(joints, GlbBuffer::vertices, kJoints)},
                          {"WEIGHTS_0", buffer_.put(weights, GlbBuffer::vertices, kQuaternions)}};
    Json nodes = Json::array();
    for (const int n : m.nodes) nodes.push_back(n + 1);
    skins_.push_back({{"inverseBindMatrices", buffer_.put(matrices, GlbBuffer::none, kMatrices)},
                      {"skeleton", 0},
                      {"joints", nodes}});
    const int mesh = addMesh(
        m.name,
        {{"attributes", attributes}, {"indices", indicesOf(m.triangles)}, {"material", material(m.color, false)}});
    roots_.push_back(nodes_.size());  // where a skin's node is does not count; players want it on top
    nodes_.push_back({{"name", m.name}, {"mesh", mesh}, {"skin", skins_.size() - 1}});
  }

  /// The middle of the box around a mesh at each time, single precision as the file has it.
  static std::vector<float> originsOf(const MovingMesh& m) {
    std::vector<float> origins;
    for (const std::vector<float>& x : m.at)
      for (std::size_t c = 0; c < 3; ++c) {
        float low = x.at(c), high = low;
        for (std::size_t i = c; i < x.size(); i += 3) {
          if (!std::isfinite(x[i])) throw RunError(m.name + " has a position that is no finite number");
          low = std::min(low, x[i]), high = std::max(high, x[i]);
        }
        origins.push_back(0.5f * low + 0.5f * high);
      }
    return origins;
  }

  void addMoving(const MovingMesh& m) {
    if (m.at.size() != times_.size()) throw std::logic_error("a moving mesh needs its vertices at each time");
    const std::size_t numbers = m.at[0].size(), count = numbers / 3;
    if (count == 0 || m.triangles.empty()) return;
    for (const std::vector<float>& x : m.at)
      if (x.size() != numbers) throw std::logic_error("a moving mesh keeps its vertices");
    const std::vector<float> origins = originsOf(m);
    const auto about = [&](std::size_t f, std::size_t i) {
      return static_cast<double>(m.at[f].at(i)) - static_cast<double>(origins[3 * f + i % 3]);
    };
    double most = 0;
    for (std::size_t f = 0; f < m.at.size(); ++f)
      for (std::size_t i = 0; i < numbers; ++i)
        most = std::max({most, std::abs(about(f, i)), std::abs(about(f, i) - about(0, i))});
    // A change of two rounded numbers may be one more than the rounded change.
    const auto quantum = static_cast<float>(most > 0 ? most / 32766 : 1);
    const double q = static_cast<double>(quantum);
    std::vector<std::int16_t> quanta;  // of each time four numbers a vertex; after the first time, changes
    quanta.reserve(4 * count * m.at.size());
    for (std::size_t f = 0; f < m.at.size(); ++f)
      for (std::size_t v = 0; v < count; ++v) {
        double square = 0;
        for (std::size_t c = 0; c < 3; ++c) {
          const double x = about(f, 3 * v + c), whole = std::round(x / q);
          square += (x - q * whole) * (x - q * whole);
          quanta.push_back(static_cast<std::int16_t>(f == 0 ? whole : whole - quanta[4 * v + c]));
        }
        quanta.push_back(0);
        error_m_ = std::max(error_m_, std::sqrt(square));
      }
    const std::span<const std::int16_t> all(quanta);
    const int view = buffer_.view(all, GlbBuffer::vertices, 8);
    Json attributes, targets = Json::array();
    for (std::size_t f = 0; f < m.at.size(); ++f) {
      const int at = buffer_.accessor(view, all.subspan(4 * count * f, 4 * count), count, kQuanta, 8 * count * f);
      if (f == 0)
        attributes["POSITION"] = at;
      else
        targets.push_back({{"POSITION", at}});
    }
    if (!m.colors.empty()) {
      std::vector<std::uint16_t> colors;
      for (const Color& c : m.colors) {
        for (const float v : {c.r, c.g, c.b}) colors.push_back(linear16(v));
        colors.push_back(65535);
      }
      attributes["COLOR_0"] = buffer_.put(colors, GlbBuffer::vertices, kColors);
    }
    Json primitive{{"attributes", attributes},
                   {"indices", indicesOf(m.triangles)},
                   {"material", material(m.colors.empty() ? m.color : Color{1, 1, 1}, true)}};
    Json more = Json::object();
    if (!targets.empty()) {
      more["weights"] = std::vector<double>(targets.size(), 0.0);
      primitive["targets"] = targets;
    }
    const int mesh = addMesh(m.name, std::move(primitive), more);
    const int node = addChild(0, {{"name", m.name},
                                  {"mesh", mesh},
                                  {"translation", std::vector<float>(origins.begin(), origins.begin() + 3)},
                                  {"scale", {q, q, q}}});
    if (!moves()) return;
    animate(node, "translation", origins, kVectors);
    const std::size_t weights = times_.size() - 1;
    std::vector<float> one_at_a_time(times_.size() * weights, 0.f);
    for (std::size_t f = 1; f < times_.size(); ++f) one_at_a_time[f * weights + f - 1] = 1;
    animate(node, "weights", one_at_a_time, kScalars);
  }

  std::string file() {
    Json notes = Json::object();
    for (const auto& [word, text] : scene_.notes) notes[word] = text;
    roots_.insert(roots_.begin(), 0);
    std::string& bytes = buffer_.bytes();
    bytes.resize((bytes.size() + 3) / 4 * 4, '\0');
    Json j{{"asset", {{"version", "2.0"}, {"generator", "Gambeson"}, {"extras", notes}}},
           {"scene", 0},
           {"scenes", {{{"name", scene_.title}, {"nodes", roots_}}}},
           {"nodes", nodes_}};
    if (!scene_.moving.empty())
      j.update({{"extensionsUsed", {"KHR_mesh_quantization"}}, {"extensionsRequired", {"KHR_mesh_quantization"}}});
    for (const auto& [key, list] : {std::pair<const char*, const Json&>{"meshes", meshes_},
                                    {"materials", materials_},
                                    {"skins", skins_},
                                    {"accessors", buffer_.accessors()},
                                    {"bufferViews", buffer_.views()}})
      if (!list.empty()) j[key] = list;
    if (!bytes.empty()) j["buffers"] = {{{"byteLength", bytes.size()}}};
    if (!channels_.empty())
      j["animations"] = {{{"name", "recorded"}, {"samplers", samplers_}, {"channels", channels_}}};
    std::string text = j.dump(-1, ' ', false, Json::error_handler_t::replace);
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const std::uint64_t length = 12 + 8 + text.size() + 8 + bytes.size();
    if (length > std::numeric_limits<std::uint32_t>::max())
      throw RunError("the animation would be larger than 4 GiB, which .glb cannot be; --frames takes fewer");
    std::string out;
    out.reserve(length);
    const auto word = [&](std::uint64_t v) {
      for (int k = 0; k < 4; ++k) out += static_cast<char>(v >> (8 * k) & 0xff);
    };
    out += "glTF", word(2), word(length);
    word(text.size()), out += "JSON", out += text;
    word(bytes.size()), out += std::string("BIN\0", 4), out += bytes;
    return out;
  }

  const AnimatedScene& scene_;
  std::vector<float> times_;
  GlbBuffer buffer_;
  int times_accessor_ = -1;
  double error_m_ = 0;
  std::vector<std::size_t> roots_;
  std::vector<Json> nodes_;
  Json meshes_ = Json::array(), materials_ = Json::array(), skins_ = Json::array(), samplers_ = Json::array(),
       channels_ = Json::array();
};

}  // namespace

Glb encodeGlb(const AnimatedScene& scene) { return Encoder(scene).encode(); }

double GlbSize::bytes(std::size_t times) const {
  const auto F = static_cast<double>(times);
  return rest + of_time * F + of_pair * F * (F - 1);
}

std::size_t GlbSize::most(double largest) const {
  // of_pair F^2 + (of_time - of_pair) F + rest - largest = 0, in the form that has no difference of near numbers.
  const double room = largest - rest, b = of_time - of_pair;
  const double F = room > 0 ? 2 * room / (b + std::sqrt(b * b + 4 * of_pair * room)) : 0;
  return F >= 1 ? static_cast<std::size_t>(F) : 0;
}

GlbSize glbSize(const AnimatedScene& few) {
  constexpr double kNode = 28;   ///< turn and place
  constexpr double kSaid = 160;  ///< JSON of a morph target: its accessor with bounds, its name, its weight at rest
  GlbSize size;
  size.of_time = sizeof(float);
  for (const MovedNode& n : few.nodes) size.of_time += n.at.size() > 1 ? kNode : 0;
  for (const MovingMesh& m : few.moving) {
    size.of_time += 8 * static_cast<double>(m.at.at(0).size() / 3) + 3 * sizeof(float) + kSaid;
    size.of_pair += sizeof(float);
  }
  size.rest = static_cast<double>(encodeGlb(few).bytes.size()) - size.bytes(few.time_s.size());
  return size;
}

}  // namespace gambeson
