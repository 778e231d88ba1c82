#include "cases/occt/faces.hpp"

#include <BRepBuilderAPI_NurbsConvert.hxx>
#include <BRepBuilderAPI_Sewing.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepGProp.hxx>
#include <BRepTools.hxx>
#include <BRepTools_WireExplorer.hxx>
#include <BRep_Tool.hxx>
#include <GProp_GProps.hxx>
#include <Geom2dConvert.hxx>
#include <Geom2d_BSplineCurve.hxx>
#include <Geom2d_TrimmedCurve.hxx>
#include <GeomConvert.hxx>
#include <GeomLib_IsPlanarSurface.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_OffsetSurface.hxx>
#include <Geom_Plane.hxx>
#include <Geom_RectangularTrimmedSurface.hxx>
#include <ShapeBuild_ReShape.hxx>
#include <ShapeFix_Shape.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/error.hpp"

namespace gambeson {
namespace {

constexpr double kSewing_mm = 0.01;
constexpr double kMetres = 1e-3;
constexpr std::size_t kMostFaces = 5000;
constexpr long kMostPoints = 500000;  ///< control points of all surfaces

[[noreturn]] void reject(std::size_t face, const std::string& name, const std::string& reason) {
  std::string key = "face " + std::to_string(face + 1);
  if (!name.empty()) key += " (" + name + ")";
  throw InputError({"", 0, key}, reason);
}

template <class Array>
std::vector<double> listOf(const Array& a) {
  std::vector<double> out;
  for (int i = a.Lower(); i <= a.Upper(); ++i) out.push_back(a.Value(i));
  return out;
}

NurbsPatch patchOf(const Handle(Geom_BSplineSurface) & s) {
  NurbsPatch p;
  p.u = {s->UDegree(), listOf(s->UKnotSequence())};
  p.v = {s->VDegree(), listOf(s->VKnotSequence())};
  const bool rational = s->IsURational() || s->IsVRational();  // else its weights may be anything
  for (int j = 1; j <= s->NbVPoles(); ++j)
    for (int i = 1; i <= s->NbUPoles(); ++i) {
      const gp_Pnt x = s->Pole(i, j);
      p.points.push_back({kMetres * x.X(), kMetres * x.Y(), kMetres * x.Z()});
      p.weights.push_back(rational ? s->Weight(i, j) : 1);
    }
  return p;
}

NurbsCurve curveOf(const Handle(Geom2d_BSplineCurve) & c) {
  NurbsCurve out{{c->Degree(), listOf(c->KnotSequence())}, {}, {}};
  for (int i = 1; i <= c->NbPoles(); ++i) {
    const gp_Pnt2d x = c->Pole(i);
    out.points.push_back({x.X(), x.Y()});
    out.weights.push_back(c->IsRational() ? c->Weight(i) : 1);
  }
  return out;
}

/// Puts what is wanted of a direction in place of from .. to: all of the surface, which is said, or a period.
bool withinPeriod(bool periodic, double low, double high, double& from, double& to) {
  const double period = high - low;
  if (!periodic || (from >= low - 1e-6 * period && to <= high + 1e-6 * period)) {
    from = low, to = high;
    return true;
  }
  to = std::min(to, from + period);
  return false;
}

/// The surface as a spline with clamped knots over no more than a period, of a face that NurbsConvert left.
Handle(Geom_BSplineSurface) splineOf(const TopoDS_Face& face) {
  Handle(Geom_Surface) s = BRep_Tool::Surface(face);
  Handle(Geom_BSplineSurface) spline = Handle(Geom_BSplineSurface)::DownCast(s);
  if (!spline.IsNull() && !spline->IsUPeriodic() && !spline->IsVPeriodic()) return spline;
  double u0, u1, v0, v1;
  BRepTools::UVBounds(face, u0, u1, v0, v1);
  bool whole = false;
  if (!spline.IsNull()) {
    double a0, a1, b0, b1;
    spline->Bounds(a0, a1, b0, b1);
    // Only of what crosses the period's end another period is taken.
    const bool u = withinPeriod(spline->IsUPeriodic(), a0, a1, u0, u1),
               v = withinPeriod(spline->IsVPeriodic(), b0, b1, v0, v1);
    whole = u && v;
  }
  if (whole)
    spline = Handle(Geom_BSplineSurface)::DownCast(spline->Copy());
  else
    spline = GeomConvert::SurfaceToBSplineSurface(new Geom_RectangularTrimmedSurface(s, u0, u1, v0, v1));
  if (spline->IsUPeriodic()) spline->SetUNotPeriodic();
  if (spline->IsVPeriodic()) spline->SetVNotPeriodic();
  return spline;
}

bool isPlane(const TopoDS_Face& face) {
  Handle(Geom_Surface) s = BRep_Tool::Surface(face);
  if (const auto part = Handle(Geom_RectangularTrimmedSurface)::DownCast(s); !part.IsNull()) s = part->BasisSurface();
  return s->IsKind(STANDARD_TYPE(Geom_Plane));
}

double areaOf(const TopoDS_Face& face) {
  GProp_GProps props;
  BRepGProp::SurfaceProperties(face, props, 1e-7);
  return kMetres * kMetres * std::abs(props.Mass());
}

double lengthOf(const TopoDS_Edge& edge) {
  GProp_GProps props;
  BRepGProp::LinearProperties(edge, props);
  return kMetres * props.Mass();
}

int count(const TopoDS_Shape& shape, TopAbs_ShapeEnum kind, TopAbs_ShapeEnum outside_of = TopAbs_SHAPE) {
  int n = 0;
  for (TopExp_Explorer e(shape, kind, outside_of); e.More(); e.Next()) ++n;
  return n;
}

std::vector<TopoDS_Shape> facesIn(const TopoDS_Shape& shape) {
  std::vector<TopoDS_Shape> out;
  for (TopExp_Explorer e(shape, TopAbs_FACE); e.More(); e.Next()) {
    if (out.size() == kMostFaces) throw InputError({"", 0, ""}, "has more than 5,000 faces");
    out.push_back(e.Current());
  }
  return out;
}

/// Whether faces have borders that no other face has.
bool hasFreeEdges(const TopoDS_Shape& shape) {
  TopTools_IndexedDataMapOfShapeListOfShape faces;
  TopExp::MapShapesAndAncestors(shape, TopAbs_EDGE, TopAbs_FACE, faces);
  for (int i = 1; i <= faces.Extent(); ++i)
    if (faces(i).Extent() == 1 && !BRep_Tool::Degenerated(TopoDS::Edge(faces.FindKey(i)))) return true;
  return false;
}

/// An edge as loops meet it: on which side, and in which sense.
struct Met {
  CadSide side;
  bool forward = true;
};

class Reader {
 public:
  Reader(CadShape& out) : out_(out) {}

  void add(const TopoDS_Face& face, const std::string& name, bool plane) {
    const std::size_t index = out_.faces.size();
    CadFace f;
    f.name = name;
    f.plane = plane;
    f.inside_out = face.Orientation() == TopAbs_REVERSED;
    // Orientations of wires and edges are those on the surface, whatever the face says of its outside.
    const TopoDS_Face on_surface = TopoDS::Face(face.Oriented(TopAbs_FORWARD));
    const Handle(Geom_BSplineSurface) s = splineOf(on_surface);
    points_ += static_cast<long>(s->NbUPoles()) * s->NbVPoles();
    if (points_ > kMostPoints) reject(index, name, "brings more than 500,000 control points together");
    f.patch = patchOf(s);
    f.tolerance_m = kMetres * BRep_Tool::Tolerance(face);
    for (TopExp_Explorer w(on_surface, TopAbs_WIRE); w.More(); w.Next())
      loop(on_surface, TopoDS::Wire(w.Current()), index, f);
    f.area_m2 = areaOf(face);
    out_.faces.push_back(std::move(f));
  }

  /// Edges that two loops share, in the order in which they are first met.
  void seams() {
    int many = 0;
    for (int i = 1; i <= edges_.Extent(); ++i) {
      const std::vector<Met>& met = met_[static_cast<std::size_t>(i) - 1];
      if (met.size() > 2) ++many;
      if (met.size() != 2) continue;
      out_.seams.push_back(
          {met[0].side, met[1].side, met[0].forward != met[1].forward, lengthOf(TopoDS::Edge(edges_(i)))});
    }
    if (many > 0) out_.dropped.push_back(std::to_string(many) + " edges that more than two faces share: no seams");
  }

 private:
  void loop(const TopoDS_Face& face, const TopoDS_Wire& wire, std::size_t index, CadFace& f) {
    const int number = static_cast<int>(f.loops.size());
    TrimLoop chain;
    for (BRepTools_WireExplorer e(wire, face); e.More(); e.Next()) {
      const TopoDS_Edge edge = e.Current();
      double t0 = 0, t1 = 0;
      const Handle(Geom2d_Curve) c = BRep_Tool::CurveOnSurface(edge, face, t0, t1);
      if (c.IsNull()) reject(index, f.name, "has an edge that does not lie on its surface");
      Handle(Geom2d_BSplineCurve) spline =
          Geom2dConvert::CurveToBSplineCurve(new Geom2d_TrimmedCurve(c, t0, t1), Convert_QuasiAngular);
      if (spline->IsPeriodic()) spline->SetNotPeriodic();
      const bool forward = edge.Orientation() != TopAbs_REVERSED;
      if (!forward) spline = Handle(Geom2d_BSplineCurve)::DownCast(spline->Reversed());
      f.tolerance_m = std::max(f.tolerance_m, kMetres * BRep_Tool::Tolerance(edge));
      if (!BRep_Tool::Degenerated(edge)) {
        const int i = edges_.Add(edge.Oriented(TopAbs_FORWARD));
        met_.resize(static_cast<std::size_t>(edges_.Extent()));
        met_[static_cast<std::size_t>(i) - 1].push_back(
            {{static_cast<int>(index), number, static_cast<int>(chain.size())}, forward != f.inside_out});
      }
      chain.push_back(curveOf(spline));
    }
    int all = 0;
    for (TopExp_Explorer e(wire, TopAbs_EDGE); e.More(); e.Next()) ++all;
    if (chain.empty() || static_cast<int>(chain.size()) != all) {
      reject(index, f.name,
             "has a border whose edges do not follow each other; mend it in the program that it comes from");
    }
    f.loops.push_back(std::move(chain));
  }

  CadShape& out_;
  TopTools_IndexedMapOfShape edges_;
  std::vector<std::vector<Met>> met_;  ///< of each edge
  long points_ = 0;
};

}  // namespace

void addFaces(const TopoDS_Shape& given, const std::function<std::string(const TopoDS_Shape&)>& nameOf, CadShape& out) {
  TopoDS_Shape shape = given;
  std::vector<TopoDS_Shape> faces = facesIn(shape);
  if (const int edges = count(shape, TopAbs_EDGE, TopAbs_FACE); edges > 0)
    out.dropped.push_back(std::to_string(edges) + " curves that bound no face");
  if (const int points = count(shape, TopAbs_VERTEX, TopAbs_EDGE); points > 0)
    out.dropped.push_back(std::to_string(points) + " points that end no curve");
  if (faces.empty()) return;
  std::vector<std::string> names;
  for (const TopoDS_Shape& f : faces) names.push_back(nameOf(f));

  if (!BRepCheck_Analyzer(shape).IsValid()) {
    ShapeFix_Shape fix(shape);
    fix.Perform();
    std::vector<TopoDS_Shape> fixed;
    std::vector<std::string> fixed_names;
    for (std::size_t k = 0; k < faces.size(); ++k)
      for (TopExp_Explorer e(fix.Context()->Apply(faces[k]), TopAbs_FACE); e.More(); e.Next()) {
        fixed.push_back(e.Current());
        fixed_names.push_back(names[k]);
      }
    shape = fix.Shape();
    faces = std::move(fixed);
    names = std::move(fixed_names);
    out.notes.push_back(BRepCheck_Analyzer(shape).IsValid()
                            ? "the faces were not valid to OpenCASCADE's checker; it mended them"
                            : "the faces are not valid to OpenCASCADE's checker, and it could not mend all of them");
  }
  if (hasFreeEdges(shape)) {
    BRepBuilderAPI_Sewing sewing(kSewing_mm);
    for (const TopoDS_Shape& f : faces) sewing.Add(f);
    sewing.Perform();
    for (TopoDS_Shape& f : faces) f = sewing.IsModified(f) ? sewing.Modified(f) : f;
    shape = sewing.SewedShape();
  }
  // Sewing turns faces so that neighbours have one outside; what the shape is made of keeps its order in a conversion.
  const std::vector<TopoDS_Shape> now = facesIn(shape);
  const std::vector<TopoDS_Shape> converted = facesIn(BRepBuilderAPI_NurbsConvert(shape).Shape());
  Reader reader(out);
  for (std::size_t k = 0; k < faces.size(); ++k) {
    const auto at = std::find_if(now.begin(), now.end(), [&](const TopoDS_Shape& f) { return f.IsSame(faces[k]); });
    if (at == now.end() || converted.size() != now.size())
      reject(k, names[k], "falls apart, or has no area, where it is sewn to its neighbours");
    reader.add(TopoDS::Face(converted[static_cast<std::size_t>(at - now.begin())]), names[k],
               isPlane(TopoDS::Face(*at)));
  }
  reader.seams();
}

}  // namespace gambeson
