#include "analysis/viewer/viewer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>

#include "analysis/render/colormap.hpp"
#include "analysis/report/html.hpp"
#include "analysis/report/parts.hpp"
#include "analysis/viewer/packed.hpp"
#include "analysis/viewer/sources.hpp"
#include "core/error.hpp"

namespace gambeson {
namespace {

using html::element;
using Json = nlohmann::ordered_json;
static_assert(std::endian::native == std::endian::little, "blocks have the lowest byte first");

template <class T>
std::string bytesOf(const std::vector<T>& data) {
  return {reinterpret_cast<const char*>(data.data()), data.size() * sizeof(T)};
}

Json vec(const Vec3& v) { return Json{v.x, v.y, v.z}; }

/// Numbers of a length in metres to a hundredth of the quantum, so that they stay short.
double brief(double x) { return std::round(1e6 * x) / 1e6; }

/// `</` would end a script.
std::string inScript(std::string json) {
  for (std::size_t at = 0; (at = json.find("</", at)) != std::string::npos; at += 3) json.replace(at, 2, "<\\/");
  return json;
}

const char* wordOf(ViewerRun::Kind kind) {
  return kind == ViewerRun::Kind::cloth ? "cloth" : kind == ViewerRun::Kind::body ? "body" : "thing";
}

}  // namespace

ViewerRun::ViewerRun(std::string title, std::string label, std::vector<double> times_s, std::vector<Vec3> origin_m,
                     Vec3 up)
    : title_(std::move(title)),
      label_(std::move(label)),
      times_s_(std::move(times_s)),
      origin_m_(std::move(origin_m)),
      up_(up) {
  if (times_s_.empty() || origin_m_.size() != times_s_.size())
    throw std::logic_error("a run to be viewed needs an origin for each of its times");
  // What is rounded for the page is what positions are about.
  for (Vec3& o : origin_m_) o = {brief(o.x), brief(o.y), brief(o.z)};
}

int ViewerRun::block(const std::string& deflated_bytes) {
  blocks_.push_back(html::base64(deflated_bytes));
  return static_cast<int>(blocks_.size()) - 1;
}

ViewerRun::Piece ViewerRun::firstPiece(const std::string& bytes) {
  first_ += bytes;
  return {first_.size() - bytes.size(), bytes.size()};
}

void ViewerRun::addMesh(Kind kind, const std::string& name, std::size_t vertices,
                        const std::vector<std::array<int, 3>>& triangles, const Color& color,
                        const std::vector<std::string>& parts, const std::vector<int>& part_of_vertex,
                        std::string more) {
  std::vector<std::int32_t> changes;
  std::int32_t before = 0;
  for (const std::array<int, 3>& t : triangles)
    for (const int v : t) changes.push_back(v - before), before = v;
  Json mesh = Json::parse(more);
  mesh["name"] = name;
  mesh["kind"] = wordOf(kind);
  mesh["color"] = Json{color.r, color.g, color.b};
  mesh["vertices"] = vertices;
  mesh["triangles"] = firstPiece(bytesOf(changes));
  if (!parts.empty()) {
    std::vector<std::uint16_t> part;
    for (const int p : part_of_vertex) part.push_back(static_cast<std::uint16_t>(p));
    if (part.size() != vertices) throw std::logic_error("a mesh has not one part for each vertex");
    mesh["parts"] = parts;
    mesh["part"] = block(deflated(bytesOf(part)));
  }
  meshes_.push_back({kind, mesh.dump(), vertices, parentsOf(vertices, triangles)});
}

void ViewerRun::addMoving(Kind kind, const MovingMesh& mesh, const std::vector<std::string>& parts,
                          const std::vector<int>& part_of_vertex) {
  if (mesh.at.size() != times_s_.size()) throw std::logic_error("a mesh that moves has not one place for each time");
  const PackedPositions p = packedPositions(mesh.at, origin_m_);
  error_m_ = std::max(error_m_, p.error_m);
  const std::vector<int> parents = parentsOf(p.codes.vertices, mesh.triangles);
  const Json more{{"start", firstPiece(coded(p.codes.frame(start_frame_), parents))},
                  {"moving", block(packed(p.codes, parents))},
                  {"quantum_m", p.quantum_m}};
  addMesh(kind, mesh.name, p.codes.vertices, mesh.triangles, mesh.color, parts, part_of_vertex, more.dump());
}

void ViewerRun::addFixed(Kind kind, const FixedMesh& mesh, const std::vector<Placement>& at,
                         const std::vector<std::string>& parts, const std::vector<int>& part_of_vertex) {
  std::vector<float> x, placed;
  for (const Vec3& v : mesh.mesh.vertices)
    for (int c = 0; c < 3; ++c) x.push_back(static_cast<float>(v[c]));
  for (std::size_t t = 0; t < at.size(); ++t) {
    const Vec3 rows[]{at[t].scale * at[t].rotation.a, at[t].scale * at[t].rotation.b, at[t].scale * at[t].rotation.c};
    const Vec3 origin = at[t].origin - origin_m_[t];
    for (int r = 0; r < 3; ++r) {
      // Mat3 has columns a, b, c.
      for (const Vec3& column : rows) placed.push_back(static_cast<float>(column[r]));
      placed.push_back(static_cast<float>(origin[r]));
    }
  }
  if (at.size() != times_s_.size()) throw std::logic_error("a mesh has not one place for each time");
  const Json more{{"fixed", firstPiece(bytesOf(x))}, {"placed", firstPiece(bytesOf(placed))}};
  addMesh(kind, mesh.name, mesh.mesh.vertices.size(), mesh.mesh.triangles, mesh.mesh.color, parts, part_of_vertex,
          more.dump());
}

void ViewerRun::addField(const ViewerField& field, std::span<const std::vector<float>> values) {
  const Kind kind = field.on_body ? Kind::body : Kind::cloth;
  std::vector<int> parents;
  for (const Mesh& m : meshes_)
    if (m.kind == kind) {
      const int first = static_cast<int>(parents.size());
      for (const int p : m.parents) parents.push_back(p < 0 ? -1 : first + p);
    }
  double least = 0, most = 0;
  bool any = false;
  for (const auto& frame : values) {
    if (frame.size() != parents.size()) throw std::logic_error("a field has not one value for each vertex");
    for (const float v : frame)
      if (std::isfinite(v)) {
        const auto value = static_cast<double>(v);
        least = any ? std::min(least, value) : value;
        most = any ? std::max(most, value) : value;
        any = true;
      }
  }
  if (!any || (least == 0 && most == 0)) return;
  if (values.size() != times_s_.size() && values.size() != 1)
    throw std::logic_error("a field has neither one set of values nor one for each time");
  const PackedValues p = packedValues(values);
  Json limits = Json::array();
  for (const ViewerLimit& l : field.limits)
    limits.push_back({{"mesh", l.mesh}, {"part", l.part}, {"value", l.value}, {"text", l.text}});
  Json json{{"name", field.name},
            {"title", field.title},
            {"unit", field.unit},
            {"on", wordOf(kind)},
            {"block", block(packed(p.codes, parents))},
            {"frames", values.size()},
            {"scale", p.scale},
            {"step", PackedValues::kStep},
            {"least", least},
            {"most", most},
            {"high", field.high > 0 ? field.high : most},
            {"bare", field.bare},
            {"limits", limits}};
  if (field.name == start_field_)
    json["start"] = firstPiece(coded(p.codes.frame(values.size() > 1 ? start_frame_ : 0), parents));
  fields_.push_back(json.dump());
}

void ViewerRun::addArrows(std::span<const std::vector<ViewerArrow>> of_frames, double most_N, double longest_m,
                          const std::string& legend) {
  if (of_frames.size() != times_s_.size()) throw std::logic_error("there are not arrows for each time");
  std::vector<float> data;
  std::vector<std::size_t> counts;
  for (std::size_t t = 0; t < of_frames.size(); ++t) {
    counts.push_back(of_frames[t].size());
    for (const ViewerArrow& a : of_frames[t])
      for (const Vec3& v : {a.tip - origin_m_[t], a.force_N})
        for (int c = 0; c < 3; ++c) data.push_back(static_cast<float>(v[c]));
  }
  if (data.empty()) return;
  const Json json{{"block", block(deflated(bytesOf(data)))},
                  {"counts", counts},
                  {"most_N", most_N},
                  {"longest_m", longest_m},
                  {"legend", legend}};
  arrows_ = json.dump();
}

void ViewerRun::startAt(double time_s, const std::string& field, const std::string& view) {
  if (!meshes_.empty()) throw std::logic_error("a run to be viewed starts before it has meshes");
  start_field_ = field, start_view_ = view;
  for (std::size_t t = 0; t < times_s_.size(); ++t)
    if (std::abs(times_s_[t] - time_s) < std::abs(times_s_[start_frame_] - time_s)) start_frame_ = t;
}

std::string ViewerRun::restHtml(std::size_t number) const {
  std::string out;
  for (std::size_t k = 0; k < blocks_.size(); ++k)
    out += element(
        "script", blocks_[k],
        fmt::format(" type=\"text/plain\" class=\"viewer-block\" data-run=\"{}\" data-block=\"{}\"", number, k));
  return out;
}

std::string ViewerRun::firstHtml(std::size_t number) const {
  Json origin = Json::array();
  for (const Vec3& o : origin_m_) origin.push_back(vec(o));
  Json times = Json::array();
  for (const double t : times_s_) times.push_back(brief(t));
  Json meshes = Json::array(), fields = Json::array();
  for (const Mesh& m : meshes_) meshes.push_back(Json::parse(m.json));
  for (const std::string& f : fields_) fields.push_back(Json::parse(f));
  const Json run{{"title", title_},
                 {"label", label_},
                 {"times_s", times},
                 {"origin_m", origin},
                 {"up", vec(up_)},
                 {"error_mm", 1e3 * error_m_},
                 {"start",
                  {{"time_s", brief(times_s_[start_frame_])},
                   {"frame", start_frame_},
                   {"field", start_field_},
                   {"view", start_view_}}},
                 {"meshes", meshes},
                 {"fields", fields},
                 {"arrows", arrows_.empty() ? Json() : Json::parse(arrows_)}};
  return element("script", inScript(run.dump()), " type=\"application/json\" class=\"viewer-run\"") +
         element("script", html::base64(deflated(first_)),
                 fmt::format(" type=\"text/plain\" class=\"viewer-first\" data-run=\"{}\"", number));
}

namespace {

std::string scripts() {
  const viewer::Sources s = viewer::sources();
  const std::string library = std::string(s.three) + "\n" + std::string(s.orbit);
  return "<!-- " + std::string(s.notice) + " -->\n" +
         element("script", html::base64(deflated(library)), " type=\"text/plain\" id=\"viewer-library\"") +
         element("script", s.script);
}

}  // namespace

std::string viewerSection(std::span<const ViewerRun> runs) {
  if (runs.empty()) return "";
  double error_m = 0;
  std::string first, rest;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    error_m = std::max(error_m, runs[k].error_m());
    first += runs[k].firstHtml(k);
    rest += runs[k].restHtml(k);
  }
  Json colors = Json::array();
  for (const Color& c : makeColorTable())
    for (const float part : {c.r, c.g, c.b}) colors.push_back(static_cast<int>(std::lround(255 * part)));
  const std::string note = element(
      "p",
      fmt::format(
          "Every recorded frame of the motion. Positions are those of the recording within {:.3f} mm, values within "
          "0.2 %. Drag turns, right button or two fingers move, the wheel zooms once the picture was clicked; click "
          "the cloth for its value, and a plot for its moment.",
          1e3 * error_m),
      " class=\"caption\"");
  return element("section",
                 element("h2", runs.size() > 1 ? "Look around, side by side" : "Look around", " id=\"look\"") +
                     element("div", "", " class=\"viewer\" id=\"viewer\"") + note +
                     element("script", colors.dump(), " type=\"application/json\" id=\"viewer-colors\"") + scripts() +
                     first + element("script", "gambesonFirst();") + rest,
                 " class=\"look\" id=\"look-around\" aria-labelledby=\"look\" hidden");
}

std::string viewerStyle() { return std::string(viewer::sources().style); }

}  // namespace gambeson
