#include "cases/occt/write.hpp"

#include <APIHeaderSection_MakeHeader.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepBuilderAPI_Sewing.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepLib.hxx>
#include <Geom2d_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <IGESBasic_Name.hxx>
#include <IGESControl_Writer.hxx>
#include <IGESData_GlobalSection.hxx>
#include <IGESData_IGESEntity.hxx>
#include <IGESData_IGESModel.hxx>
#include <IGESData_IGESWriter.hxx>
#include <IGESSelect_WorkLibrary.hxx>
#include <Interface_FloatWriter.hxx>
#include <Interface_Static.hxx>
#include <STEPConstruct.hxx>
#include <STEPControl_Writer.hxx>
#include <StepData_Protocol.hxx>
#include <StepData_StepModel.hxx>
#include <StepData_StepWriter.hxx>
#include <StepRepr_RepresentationItem.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColStd_Array2OfReal.hxx>
#include <TColgp_Array1OfPnt2d.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Wire.hxx>
#include <TransferBRep.hxx>
#include <TransferBRep_ShapeMapper.hxx>
#include <Transfer_FinderProcess.hxx>
#include <XSControl_WorkSession.hxx>
#include <memory>
#include <sstream>
#include <vector>

#include "core/error.hpp"

namespace gambeson {
namespace {

constexpr double kMillimetres = 1e3;
constexpr const char* kTime = "2000-01-01T00:00:00";  ///< the same surfaces give the same bytes
constexpr const char* kIgesTime = "20000101.000000";

/// Distinct knots and how often each stands.
struct Knots {
  explicit Knots(const KnotVector& k) {
    std::vector<double> values;
    std::vector<int> times;
    for (const double t : k.knots)
      if (values.empty() || t != values.back())
        values.push_back(t), times.push_back(1);
      else
        ++times.back();
    const int n = static_cast<int>(values.size());
    knots = std::make_unique<TColStd_Array1OfReal>(1, n);
    multiplicities = std::make_unique<TColStd_Array1OfInteger>(1, n);
    for (int i = 0; i < n; ++i) {
      knots->SetValue(i + 1, values[static_cast<std::size_t>(i)]);
      multiplicities->SetValue(i + 1, times[static_cast<std::size_t>(i)]);
    }
  }
  std::unique_ptr<TColStd_Array1OfReal> knots;
  std::unique_ptr<TColStd_Array1OfInteger> multiplicities;
};

Handle(Geom_BSplineSurface) surfaceOf(const NurbsPatch& p) {
  const Knots u(p.u), v(p.v);
  TColgp_Array2OfPnt poles(1, p.u.count(), 1, p.v.count());
  TColStd_Array2OfReal weights(1, p.u.count(), 1, p.v.count());
  for (int j = 0; j < p.v.count(); ++j)
    for (int i = 0; i < p.u.count(); ++i) {
      const auto k = static_cast<std::size_t>(p.index(i, j));
      const Vec3 x = kMillimetres * p.points[k];
      poles.SetValue(i + 1, j + 1, gp_Pnt(x.x, x.y, x.z));
      weights.SetValue(i + 1, j + 1, p.weights[k]);
    }
  return new Geom_BSplineSurface(poles, weights, *u.knots, *v.knots, *u.multiplicities, *v.multiplicities, p.u.degree,
                                 p.v.degree);
}

Handle(Geom2d_BSplineCurve) curveOf(const NurbsCurve& c) {
  const Knots t(c.knots);
  const int n = c.knots.count();
  TColgp_Array1OfPnt2d poles(1, n);
  TColStd_Array1OfReal weights(1, n);
  for (int i = 0; i < n; ++i) {
    const auto k = static_cast<std::size_t>(i);
    poles.SetValue(i + 1, gp_Pnt2d(c.points[k].x, c.points[k].y));
    weights.SetValue(i + 1, c.weights[k]);
  }
  return new Geom2d_BSplineCurve(poles, weights, *t.knots, *t.multiplicities, c.knots.degree);
}

TopoDS_Wire wireOf(const TrimLoop& loop, const Handle(Geom_BSplineSurface) & surface, const std::string& name) {
  BRepBuilderAPI_MakeWire wire;
  for (const NurbsCurve& c : loop) {
    BRepBuilderAPI_MakeEdge edge(curveOf(c), surface);
    if (!edge.IsDone()) throw RunError(name + ": a curve of its border makes no edge");
    BRepLib::BuildCurve3d(edge.Edge());
    wire.Add(edge.Edge());
    if (!wire.IsDone()) throw RunError(name + ": the curves of its border do not follow each other");
  }
  return wire.Wire();
}

TopoDS_Face faceOf(const CadFace& f) {
  const Handle(Geom_BSplineSurface) surface = surfaceOf(f.patch);
  if (f.loops.empty()) return BRepBuilderAPI_MakeFace(surface, 1e-4).Face();
  BRepBuilderAPI_MakeFace face(surface, wireOf(f.loops[0], surface, f.name));
  for (std::size_t l = 1; l < f.loops.size(); ++l) face.Add(wireOf(f.loops[l], surface, f.name));
  if (!face.IsDone()) throw RunError(f.name + ": its border makes no face");
  return face.Face();
}

/// Faces sewn to shells, and where each of them went.
struct Sewn {
  TopoDS_Shape shape;
  std::vector<TopoDS_Shape> faces;
};

Sewn sewn(const CadShape& shape, double tolerance_m) {
  Sewn out;
  BRepBuilderAPI_Sewing sewing(kMillimetres * tolerance_m);
  for (const CadFace& f : shape.faces) {
    out.faces.push_back(faceOf(f));
    sewing.Add(out.faces.back());
  }
  sewing.Perform();
  for (TopoDS_Shape& f : out.faces)
    if (sewing.IsModified(f)) f = sewing.Modified(f);
  out.shape = sewing.SewedShape();
  if (!BRepCheck_Analyzer(out.shape).IsValid()) throw RunError("OpenCASCADE's checker finds the sewn faces not valid");
  return out;
}

Handle(TCollection_HAsciiString) hText(const std::string& s) { return new TCollection_HAsciiString(s.c_str()); }

std::string stepText(const std::string& title, const CadShape& given, double tolerance_m) {
  const Sewn s = sewn(given, tolerance_m);
  STEPControl_Writer writer;
  Interface_Static::SetCVal("write.step.product.name", title.c_str());
  if (writer.Transfer(s.shape, STEPControl_AsIs) != IFSelect_RetDone)
    throw RunError("OpenCASCADE has no STEP entities for these faces");
  const Handle(Transfer_FinderProcess) made = writer.WS()->TransferWriter()->FinderProcess();
  for (std::size_t k = 0; k < s.faces.size(); ++k)
    if (const Handle(StepRepr_RepresentationItem) item = STEPConstruct::FindEntity(made, s.faces[k]); !item.IsNull())
      item->SetName(hText(given.faces[k].name));
  const Handle(StepData_StepModel) model = writer.Model();
  APIHeaderSection_MakeHeader header(model);
  header.SetName(hText(title));
  header.SetTimeStamp(hText(kTime));
  header.SetOriginatingSystem(hText("Gambeson"));
  header.SetAuthorValue(1, hText("Gambeson"));
  header.SetOrganizationValue(1, hText("Gambeson"));
  header.SetPreprocessorVersion(hText("Open CASCADE"));
  StepData_StepWriter text(model);
  text.FloatWriter().SetFormat("%.16E");  // seventeen digits: every bit
  text.FloatWriter().SetZeroSuppress(false);
  text.SendModel(Handle(StepData_Protocol)::DownCast(writer.WS()->Protocol()));
  std::ostringstream out;
  if (!text.Print(out)) throw RunError("OpenCASCADE cannot write the STEP file");
  return out.str();
}

/// IGES knows ASCII alone.
Handle(TCollection_HAsciiString) asciiText(std::string s) {
  for (char& c : s)
    if (c < ' ' || c > '~') c = '_';
  return hText(s);
}

std::string igesText(const std::string& title, const CadShape& given, double tolerance_m) {
  const Sewn s = sewn(given, tolerance_m);
  IGESControl_Writer writer("MM", 1);  // B-rep entities: shells keep their sewing
  if (!writer.AddShape(s.shape)) throw RunError("OpenCASCADE has no IGES entities for these faces");
  writer.ComputeModel();
  const Handle(IGESData_IGESModel) model = writer.Model();
  const Handle(Transfer_FinderProcess) made = writer.TransferProcess();
  for (std::size_t k = 0; k < s.faces.size(); ++k) {
    const auto face =
        Handle(IGESData_IGESEntity)::DownCast(made->FindTransient(TransferBRep::ShapeMapper(made, s.faces[k])));
    if (face.IsNull() || given.faces[k].name.empty()) continue;
    const Handle(IGESBasic_Name) name = new IGESBasic_Name;
    name->Init(1, asciiText(given.faces[k].name));
    face->AddProperty(name);
    model->AddEntity(name);
  }
  IGESData_GlobalSection global = model->GlobalSection();
  global.SetSendName(asciiText(title));
  global.SetFileName(asciiText(title));
  global.SetReceiveName(asciiText(title));
  global.SetSystemId(hText("Gambeson"));
  global.SetAuthorName(hText("Gambeson"));
  global.SetCompanyName(hText("Gambeson"));
  global.SetDate(hText(kIgesTime));
  global.SetLastChangeDate(hText(kIgesTime));
  model->SetGlobalSection(global);
  IGESData_IGESWriter text(model);
  text.FloatWriter().SetFormat("%.16E");
  text.SendModel(IGESSelect_WorkLibrary::DefineProtocol());
  std::ostringstream out;
  if (!text.Print(out)) throw RunError("OpenCASCADE cannot write the IGES file");
  return out.str();
}

}  // namespace

std::string shapeText(const std::string& title, const CadShape& shape, CadFormat format, double tolerance_m) {
  if (format == CadFormat::step) return stepText(title, shape, tolerance_m);
  if (format == CadFormat::iges) return igesText(title, shape, tolerance_m);
  throw RunError("only STEP and IGES are written");
}

}  // namespace gambeson
