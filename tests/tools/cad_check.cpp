/// CAD files by OpenCASCADE itself, apart from what the program makes of it.
///
///   cad_check make FOLDER     files of shapes whose areas and edges have closed forms
///   cad_check read FILE       what is in a STEP, IGES or .brep file: faces and their areas as they stand in the file
///                             (a quadrature of this tool's own over a mesh of the face), whether its checker finds
///                             them valid, edges that one and two faces have, and the lengths of the latter; IGES is
///                             sewn first. JSON.

#include <BRepAdaptor_Curve.hxx>
#include <BRepAdaptor_Surface.hxx>
#include <BRepAlgoAPI_Cut.hxx>
#include <BRepBndLib.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepBuilderAPI_Sewing.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepMesh_IncrementalMesh.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCone.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <BRepPrimAPI_MakeRevol.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepPrimAPI_MakeTorus.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <GCPnts_AbscissaPoint.hxx>
#include <GeomAPI_PointsToBSpline.hxx>
#include <Geom_BSplineCurve.hxx>
#include <IGESControl_Reader.hxx>
#include <IGESControl_Writer.hxx>
#include <Interface_Static.hxx>
#include <Poly_Triangulation.hxx>
#include <STEPControl_Reader.hxx>
#include <STEPControl_Writer.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <gp_Circ.hxx>
#include <iostream>
#include <string>
#include <vector>

namespace {

/// The area of a face on a mesh of its parameters: the middle rule of |x,u x x,v| on triangles halved three times.
double areaOf(const TopoDS_Face& face) {
  TopLoc_Location where;
  const Handle(Poly_Triangulation) mesh = BRep_Tool::Triangulation(face, where);
  if (mesh.IsNull()) return 0;
  const BRepAdaptor_Surface surface(face);
  const auto density = [&](double u, double v) {
    gp_Pnt x;
    gp_Vec du, dv;
    surface.D1(u, v, x, du, dv);
    return du.Crossed(dv).Magnitude();
  };
  double area = 0;
  for (int t = 1; t <= mesh->NbTriangles(); ++t) {
    int a, b, c;
    mesh->Triangle(t).Get(a, b, c);
    const gp_Pnt2d p = mesh->UVNode(a), q = mesh->UVNode(b), r = mesh->UVNode(c);
    const double whole = 0.5 * std::abs((q.X() - p.X()) * (r.Y() - p.Y()) - (r.X() - p.X()) * (q.Y() - p.Y()));
    constexpr int n = 8;
    for (int i = 0; i < n; ++i)
      for (int j = 0; i + j < n; ++j)
        for (const bool up : {true, false}) {
          if (!up && i + j == n - 1) continue;
          const double s = (i + (up ? 1 : 2) / 3.0) / n, w = (j + (up ? 1 : 2) / 3.0) / n;
          area += whole / (n * n) *
                  density(p.X() + s * (q.X() - p.X()) + w * (r.X() - p.X()),
                          p.Y() + s * (q.Y() - p.Y()) + w * (r.Y() - p.Y()));
        }
  }
  return area;
}

bool endsIn(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

TopoDS_Shape read(const std::string& file) {
  if (endsIn(file, ".brep")) {
    TopoDS_Shape shape;
    BRep_Builder builder;
    BRepTools::Read(shape, file.c_str(), builder);
    return shape;
  }
  if (endsIn(file, ".igs") || endsIn(file, ".iges")) {
    IGESControl_Reader reader;
    reader.ReadFile(file.c_str());
    reader.TransferRoots();
    BRepBuilderAPI_Sewing sewing(1e-2);
    for (TopExp_Explorer f(reader.OneShape(), TopAbs_FACE); f.More(); f.Next()) sewing.Add(f.Current());
    sewing.Perform();
    return sewing.SewedShape();
  }
  STEPControl_Reader reader;
  reader.ReadFile(file.c_str());
  reader.TransferRoots();
  return reader.OneShape();
}

int report(const std::string& file) {
  const TopoDS_Shape shape = read(file);
  Bnd_Box box;
  BRepBndLib::Add(shape, box);
  const double size = box.IsVoid() ? 1 : std::sqrt(box.SquareExtent());
  BRepMesh_IncrementalMesh(shape, 1e-4 * size, false, 0.1);
  std::cout.precision(17);
  std::cout << "{\"valid\": " << (BRepCheck_Analyzer(shape).IsValid() ? "true" : "false") << ", \"areas_mm2\": [";
  bool first = true;
  for (TopExp_Explorer f(shape, TopAbs_FACE); f.More(); f.Next(), first = false)
    std::cout << (first ? "" : ", ") << areaOf(TopoDS::Face(f.Current()));
  TopTools_IndexedDataMapOfShapeListOfShape faces;
  TopExp::MapShapesAndAncestors(shape, TopAbs_EDGE, TopAbs_FACE, faces);
  int free = 0;
  std::vector<double> shared;
  for (int i = 1; i <= faces.Extent(); ++i) {
    const TopoDS_Edge edge = TopoDS::Edge(faces.FindKey(i));
    if (BRep_Tool::Degenerated(edge)) continue;
    if (faces(i).Extent() == 2)  // a face that has an edge twice is in the list twice
      shared.push_back(GCPnts_AbscissaPoint::Length(BRepAdaptor_Curve(edge), 1e-9));
    else
      ++free;
  }
  std::cout << "], \"free\": " << free << ", \"seams_mm\": [";
  for (std::size_t k = 0; k < shared.size(); ++k) std::cout << (k ? ", " : "") << shared[k];
  std::cout << "]}\n";
  return 0;
}

void write(const TopoDS_Shape& shape, const std::string& name, const char* unit = "MM") {
  Interface_Static::SetCVal("write.step.unit", unit);
  STEPControl_Writer step;
  step.Transfer(shape, STEPControl_AsIs);
  step.Write((name + ".step").c_str());
  IGESControl_Writer iges(unit, 0);
  iges.AddShape(shape);
  iges.ComputeModel();
  iges.Write((name + ".igs").c_str());
  BRepTools::Write(shape, (name + ".brep").c_str());
}

TopoDS_Wire circle(const gp_Pnt& centre, double radius, bool reversed) {
  const gp_Circ c(gp_Ax2(centre, gp_Dir(0, 0, reversed ? -1 : 1)), radius);
  return BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(c));
}

TopoDS_Edge spline(const std::vector<gp_Pnt>& points) {
  TColgp_Array1OfPnt all(1, static_cast<int>(points.size()));
  for (std::size_t k = 0; k < points.size(); ++k) all.SetValue(static_cast<int>(k) + 1, points[k]);
  const Handle(Geom_BSplineCurve) curve = GeomAPI_PointsToBSpline(all).Curve();
  return BRepBuilderAPI_MakeEdge(curve);
}

/// Shapes of the sorts that CAD programs have beside these, each as STEP in several schemas and units and as IGES of
/// trimmed surfaces (144) or B-rep entities (186) in several units.
void makeMore(const std::string& folder) {
  const auto in = [&](const char* name) { return folder + "/" + name; };
  write(BRepPrimAPI_MakeCone(50, 20, 100).Shape(), in("cone"));
  write(BRepPrimAPI_MakeCone(50, 0, 100).Shape(), in("tip"));
  write(BRepPrimAPI_MakeSphere(50).Shape(), in("sphere"));
  write(BRepPrimAPI_MakeSphere(50, 0.3).Shape(), in("dome"));
  // A plane cut by a spline, with a hole.
  const gp_Pnt a(0, 0, 0), b(200, 0, 0);
  BRepBuilderAPI_MakeWire border(spline({b, gp_Pnt(230, 80, 0), gp_Pnt(150, 160, 0), gp_Pnt(60, 150, 0), a}),
                                 BRepBuilderAPI_MakeEdge(a, b));
  BRepBuilderAPI_MakeFace leaf(border.Wire(), true);
  leaf.Add(circle(gp_Pnt(120, 60, 0), 20, true));
  write(leaf.Face(), in("leaf"));
  // A spline drawn along a line, and one turned about an axis, half way and all the way.
  const TopoDS_Edge wave = spline({gp_Pnt(80, 0, 0), gp_Pnt(100, 0, 60), gp_Pnt(70, 0, 120), gp_Pnt(90, 0, 200)});
  write(BRepPrimAPI_MakePrism(wave, gp_Vec(0, 150, 0)).Shape(), in("drawn"));
  const gp_Ax1 axis(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1));
  write(BRepPrimAPI_MakeRevol(wave, axis, 3.0).Shape(), in("turned"));
  write(BRepPrimAPI_MakeRevol(wave, axis).Shape(), in("vase"));
  // Two of one part, moved and turned, in an assembly.
  const TopoDS_Shape part = BRepPrimAPI_MakeBox(100, 60, 30).Shape();
  gp_Trsf there;
  there.SetRotation(gp_Ax1(gp_Pnt(0, 0, 0), gp_Dir(1, 2, 3)), 0.7);
  gp_Trsf away;
  away.SetTranslation(gp_Vec(300, 50, -20));
  TopoDS_Compound both;
  BRep_Builder builder;
  builder.MakeCompound(both);
  builder.Add(both, part.Moved(TopLoc_Location(there)));
  builder.Add(both, part.Moved(TopLoc_Location(away * there)));
  Interface_Static::SetIVal("write.step.assembly", 1);
  write(both, in("assembly"));
  write(both, in("assembly_inch"), "INCH");
  Interface_Static::SetIVal("write.step.assembly", 0);
  const TopoDS_Shape cylinder = BRepPrimAPI_MakeCylinder(50, 200).Shape();
  for (const auto& [name, schema] : {std::pair("ap203", "AP203"), {"ap214", "AP214IS"}, {"ap242", "AP242DIS"}})
    for (const char* unit : {"MM", "INCH", "M"}) {
      Interface_Static::SetCVal("write.step.schema", schema);
      Interface_Static::SetCVal("write.step.unit", unit);
      STEPControl_Writer step;
      step.Transfer(cylinder, STEPControl_AsIs);
      step.Write((folder + "/" + name + "_" + unit + ".step").c_str());
    }
  for (const int mode : {0, 1})
    for (const char* unit : {"MM", "INCH", "M"}) {
      IGESControl_Writer iges(unit, mode);
      iges.AddShape(cylinder);
      iges.ComputeModel();
      iges.Write((folder + "/iges" + (mode == 0 ? "144_" : "186_") + unit + ".igs").c_str());
    }
}

int make(const std::string& folder) {
  const auto in = [&](const char* name) { return folder + "/" + name; };
  write(BRepPrimAPI_MakeBox(100, 60, 30).Shape(), in("box"));
  write(BRepPrimAPI_MakeBox(100, 60, 30).Shape(), in("box_inch"), "INCH");
  write(BRepPrimAPI_MakeCylinder(50, 200).Shape(), in("cylinder"));
  // A tube through a tube: two cylinders trimmed by the curve where they meet.
  write(BRepAlgoAPI_Cut(BRepPrimAPI_MakeCylinder(50, 200).Shape(),
                        BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(-100, 0, 100), gp_Dir(1, 0, 0)), 20, 200).Shape())
            .Shape(),
        in("pierced"));
  write(BRepPrimAPI_MakeTorus(100, 30, 1.5).Shape(), in("torus"));
  // A panel with a hole, and its neighbour.
  BRepBuilderAPI_MakePolygon left(gp_Pnt(0, 0, 0), gp_Pnt(200, 0, 0), gp_Pnt(180, 300, 0), gp_Pnt(0, 300, 0), true);
  BRepBuilderAPI_MakeFace front(left.Wire(), true);
  front.Add(circle(gp_Pnt(80, 100, 0), 25, true));
  BRepBuilderAPI_MakePolygon right(gp_Pnt(200, 0, 0), gp_Pnt(400, 0, 50), gp_Pnt(380, 300, 50), gp_Pnt(180, 300, 0),
                                   true);
  BRepBuilderAPI_Sewing sewing(1e-4);
  sewing.Add(front.Face());
  sewing.Add(BRepBuilderAPI_MakeFace(right.Wire(), true).Face());
  sewing.Perform();
  write(sewing.SewedShape(), in("panels"));
  // Nothing but a curve.
  write(circle(gp_Pnt(0, 0, 0), 25, false), in("curve"));
  makeMore(folder);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  // What OpenCASCADE says of its work belongs to no answer.
  return std::string(argv[1]) == "make" ? make(argv[2]) : report(argv[2]);
}
