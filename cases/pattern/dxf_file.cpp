#include "cases/pattern/dxf_file.hpp"

#include <dime/Input.h>
#include <dime/Model.h>
#include <dime/entities/Arc.h>
#include <dime/entities/Block.h>
#include <dime/entities/Circle.h>
#include <dime/entities/Ellipse.h>
#include <dime/entities/Insert.h>
#include <dime/entities/LWPolyline.h>
#include <dime/entities/Line.h>
#include <dime/entities/Point.h>
#include <dime/entities/Polyline.h>
#include <dime/entities/Spline.h>
#include <dime/entities/Text.h>
#include <dime/entities/Vertex.h>
#include <dime/sections/BlocksSection.h>
#include <dime/sections/EntitiesSection.h>
#include <dime/sections/HeaderSection.h>

#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "core/nurbs/curve.hpp"
#include "human/files/read_text.hpp"

namespace gambeson {
namespace {

constexpr std::uintmax_t kMostBytes = 64u << 20;

Vec2 flat(const dimeVec3f& v) { return {v[0], v[1]}; }

/// What is no UTF-8 is taken for Latin-1, which files of the nineties have; control characters become blanks.
std::string textOf(const char* s) {
  const std::string in = s ? s : "";
  std::string out;
  for (std::size_t k = 0; k < in.size();) {
    const auto c = static_cast<unsigned char>(in[k]);
    const std::size_t more = c < 0x80                ? 0
                             : c >= 0xc2 && c < 0xe0 ? 1
                             : c >= 0xe0 && c < 0xf0 ? 2
                             : c >= 0xf0 && c < 0xf5 ? 3
                                                     : 9;
    bool good = more < 9 && k + more < in.size();
    for (std::size_t i = 1; good && i <= more; ++i) good = (static_cast<unsigned char>(in[k + i]) & 0xc0) == 0x80;
    if (c < 0x20 || c == 0x7f) {
      out += ' ';
      ++k;
    } else if (good) {
      out.append(in, k, more + 1);
      k += more + 1;
    } else {
      out += static_cast<char>(0xc0 | c >> 6);
      out += static_cast<char>(0x80 | (c & 0x3f));
      ++k;
    }
  }
  const std::size_t first = out.find_first_not_of(' '), last = out.find_last_not_of(' ');
  return first == std::string::npos ? "" : out.substr(first, last - first + 1);
}

double record(const dimeEntity& e, int code, double otherwise) {
  dimeParam p;
  return e.getRecord(code, p) ? static_cast<double>(p.double_data) : otherwise;
}

void readPolyline(dimePolyline& line, DxfEntity& out) {
  out.kind = DxfEntity::Kind::polyline;
  out.closed = (line.getFlags() & dimePolyline::CLOSED) != 0;
  // Of those that a spline was laid through, its control points stand between the others.
  const bool has_frame = (line.getFlags() & 4) != 0;
  for (int k = 0; k < line.getNumCoordVertices(); ++k) {
    const dimeVertex* v = line.getCoordVertex(k);
    if (has_frame && (v->getFlags() & 16) != 0) continue;
    out.points.push_back(flat(v->getCoords()));
    out.bulges.push_back(record(*v, 42, 0));
  }
}

void readLine(const dimeLWPolyline& line, DxfEntity& out) {
  out.kind = DxfEntity::Kind::polyline;
  out.closed = (line.getFlags() & 1) != 0;
  for (int k = 0; k < line.getNumVertices(); ++k) {
    out.points.push_back({line.getXCoords()[k], line.getYCoords()[k]});
    out.bulges.push_back(line.getBulges() ? line.getBulges()[k] : 0);
  }
}

void readArc(const dimeArc& arc, DxfEntity& out) {
  out.kind = DxfEntity::Kind::polyline;
  dimeVec3f center;
  arc.getCenter(center);
  const double radians = std::numbers::pi / 180, a = radians * arc.getStartAngle();
  double turn = radians * arc.getEndAngle() - a;
  while (turn <= 0 && std::isfinite(turn)) turn += 2 * std::numbers::pi;
  for (const double angle : {a, a + turn})
    out.points.push_back(
        {center[0] + arc.getRadius() * std::cos(angle), center[1] + arc.getRadius() * std::sin(angle)});
  out.bulges = {std::tan(0.25 * turn), 0};
}

/// Lines along a curve over t in 0 .. 1, at both ends and so many times between.
template <class At>
void alongCurve(const At& at, int pieces, DxfEntity& out) {
  out.kind = DxfEntity::Kind::polyline;
  for (int k = 0; k <= pieces; ++k) out.points.push_back(at(static_cast<double>(k) / pieces));
  out.bulges.assign(out.points.size(), 0);
}

/// 128 lines between two knots: areas beside their chords are off by 1/128^2 of themselves.
void readSpline(const dimeSpline& s, DxfEntity& out) {
  constexpr int most = 2000, pieces = 128;
  NurbsCurve c{{s.getDegree(), {}}, {}, {}};
  if (s.getNumControlPoints() < 2 || s.getNumControlPoints() > most || s.getNumKnots() > 2 * most) return;
  for (int k = 0; k < s.getNumKnots(); ++k) c.knots.knots.push_back(s.getKnotValue(k));
  for (int k = 0; k < s.getNumControlPoints(); ++k) {
    c.points.push_back(flat(s.getControlPoint(k)));
    c.weights.push_back(s.hasWeights() && k < s.getNumWeights() ? s.getWeight(k) : 1);
  }
  try {
    validate(c);
  } catch (const InputError&) {
    return;  // not clamped, say: of another kind, which whoever needs it says
  }
  const std::vector<BezierSegment> segments = bezierSegments(c);
  const auto last = static_cast<double>(segments.size());
  alongCurve(
      [&](double t) {
        const auto k = std::min(segments.size() - 1, static_cast<std::size_t>(t * last));
        return segments[k].at(t * last - static_cast<double>(k)).point;
      },
      pieces * static_cast<int>(segments.size()), out);
}

void readEllipse(const dimeEllipse& e, DxfEntity& out) {
  const Vec2 center = flat(e.getCenter()), major = flat(e.getMajorAxisEndpoint());
  const double ratio = e.getMinorMajorRatio(), start = e.getStartParam();
  double turn = e.getEndParam() - start;
  if (!(std::isfinite(turn) && std::abs(turn) < 100)) return;
  while (turn <= 0) turn += 2 * std::numbers::pi;
  alongCurve(
      [&](double t) {
        const double c = std::cos(start + t * turn), s = ratio * std::sin(start + t * turn);
        return Vec2{center.x + c * major.x - s * major.y, center.y + c * major.y + s * major.x};
      },
      256, out);
}

DxfEntity entityOf(dimeEntity& e) {
  DxfEntity out;
  out.type = textOf(e.getEntityName());
  out.layer = textOf(e.getLayerName());
  switch (e.typeId()) {
    case dimeBase::dimePolylineType:
      readPolyline(static_cast<dimePolyline&>(e), out);
      break;
    case dimeBase::dimeLWPolylineType:
      readLine(static_cast<dimeLWPolyline&>(e), out);
      break;
    case dimeBase::dimeArcType:
      readArc(static_cast<dimeArc&>(e), out);
      break;
    case dimeBase::dimeSplineType:
      readSpline(static_cast<dimeSpline&>(e), out);
      break;
    case dimeBase::dimeEllipseType:
      readEllipse(static_cast<dimeEllipse&>(e), out);
      break;
    case dimeBase::dimeLineType:
      out.kind = DxfEntity::Kind::polyline;
      for (int k = 0; k < 2; ++k) out.points.push_back(flat(static_cast<dimeLine&>(e).getCoords(k)));
      out.bulges = {0, 0};
      break;
    case dimeBase::dimePointType: {
      const dimeVec3f& p = static_cast<dimePoint&>(e).getCoords();
      out.kind = DxfEntity::Kind::point;
      out.points = {flat(p)};
      out.size = p[2];
      break;
    }
    case dimeBase::dimeCircleType:
      out.kind = DxfEntity::Kind::circle;
      out.points = {flat(static_cast<dimeCircle&>(e).getCenter())};
      out.size = static_cast<dimeCircle&>(e).getRadius();
      break;
    case dimeBase::dimeTextType: {
      dimeVec3f at;
      static_cast<dimeText&>(e).getOrigin(at);
      out.kind = DxfEntity::Kind::text;
      out.points = {flat(at)};
      out.text = textOf(static_cast<dimeText&>(e).getTextString());
      break;
    }
    case dimeBase::dimeInsertType: {
      const auto& insert = static_cast<dimeInsert&>(e);
      out.kind = DxfEntity::Kind::insert;
      out.points = {flat(insert.getInsertionPoint())};
      out.text = insert.getBlock() ? textOf(insert.getBlock()->getName()) : "";
      for (int k = 0; k < 3; ++k) out.scale[static_cast<std::size_t>(k)] = insert.getScale()[k];
      out.rotation_deg = insert.getRotAngle();
      break;
    }
    default:
      break;
  }
  return out;
}

int variable(const dimeModel& model, const char* name, int otherwise) {
  const auto* header = static_cast<const dimeHeaderSection*>(model.findSection("HEADER"));
  int code = 0;
  dimeParam p;
  return header && header->getVariable(name, &code, &p, 1) == 1 && code == 70 ? p.int16_data : otherwise;
}

template <class To>
void put(To& out, const DxfEntity& e) {
  out.put(static_cast<int>(e.kind));
  out.put(e.type), out.put(e.layer), out.put(e.points), out.put(e.bulges), out.put(e.closed), out.put(e.text);
  out.put(e.size), out.put(e.scale), out.put(e.rotation_deg);
}
DxfEntity get(BytesIn& in) {
  DxfEntity e;
  int kind = 0;
  in.get(kind);
  e.kind = static_cast<DxfEntity::Kind>(kind);
  in.get(e.type), in.get(e.layer), in.get(e.points), in.get(e.bulges), in.get(e.closed), in.get(e.text);
  in.get(e.size), in.get(e.scale), in.get(e.rotation_deg);
  return e;
}

void readApartInto(const std::filesystem::path& file, BytesOut& out) {
  const auto fail = [&](const std::string& why) { throw InputError({file.string(), 0, ""}, why); };
  dimeInput in;
  if (!in.setFile(file.c_str())) fail("cannot be opened");
  dimeModel model;
  if (!model.read(&in)) fail("is no DXF file, or is cut off or damaged; allowed: DXF as text, R12 to 2000");
  out.put(variable(model, "$INSUNITS", 0));
  out.put(variable(model, "$MEASUREMENT", -1));
  auto* blocks = static_cast<dimeBlocksSection*>(model.findSection("BLOCKS"));
  out.put(blocks ? blocks->getNumBlocks() : 0);
  for (int b = 0; blocks && b < blocks->getNumBlocks(); ++b) {
    dimeBlock* block = blocks->getBlock(b);
    out.put(textOf(block->getName()));
    out.put(block->getNumEntities());
    for (int k = 0; k < block->getNumEntities(); ++k) put(out, entityOf(*block->getEntity(k)));
  }
  auto* entities = static_cast<dimeEntitiesSection*>(model.findSection("ENTITIES"));
  out.put(entities ? entities->getNumEntities() : 0);
  for (int k = 0; entities && k < entities->getNumEntities(); ++k) put(out, entityOf(*entities->getEntity(k)));
}

}  // namespace

DxfFile readDxfFile(const std::filesystem::path& file) {
  readText(file, kMostBytes);  // that it is there, a file, and not too large
  BytesIn in = readApart(file, limitsFor(file), [&](BytesOut& out) { readApartInto(file, out); });
  DxfFile dxf;
  int blocks = 0, entities = 0;
  in.get(dxf.insert_units), in.get(dxf.measurement), in.get(blocks);
  for (int b = 0; b < blocks; ++b) {
    DxfBlock& block = dxf.blocks.emplace_back();
    in.get(block.name), in.get(entities);
    for (int k = 0; k < entities; ++k) block.entities.push_back(get(in));
  }
  in.get(entities);
  for (int k = 0; k < entities; ++k) dxf.entities.push_back(get(in));
  return dxf;
}

}  // namespace gambeson
