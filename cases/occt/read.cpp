#include "cases/occt/read.hpp"

#include <BRepBuilderAPI_Transform.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <IGESControl_Reader.hxx>
#include <IGESData_GlobalSection.hxx>
#include <IGESData_IGESEntity.hxx>
#include <IGESData_IGESModel.hxx>
#include <STEPControl_Reader.hxx>
#include <StepData_StepModel.hxx>
#include <StepRepr_RepresentationItem.hxx>
#include <TColStd_SequenceOfAsciiString.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TopoDS_Shape.hxx>
#include <TopoDS_TShape.hxx>
#include <TransferBRep.hxx>
#include <Transfer_TransientProcess.hxx>
#include <XSControl_TransferReader.hxx>
#include <XSControl_WorkSession.hxx>
#include <fstream>
#include <map>

#include "cases/occt/faces.hpp"
#include "core/error.hpp"

namespace gambeson {
namespace {

std::string textOf(const Handle(TCollection_HAsciiString) & s) { return s.IsNull() ? "" : s->ToCString(); }

std::string withoutEnds(const std::string& s) {
  const std::size_t from = s.find_first_not_of(' ');
  return from == std::string::npos ? "" : s.substr(from, s.find_last_not_of(' ') - from + 1);
}

/// What STEP files say beside shapes: type of the entity, and what it is to a reader.
const std::map<std::string, std::string> kStepExtras{
    {"StepVisual_StyledItem", "colours and styles"},       {"StepVisual_PresentationLayerAssignment", "layers"},
    {"StepVisual_TessellatedFace", "tessellated faces"},   {"StepVisual_TriangulatedFace", "tessellated faces"},
    {"StepVisual_TessellatedShell", "tessellated shells"}, {"StepVisual_AnnotationOccurrence", "annotations"},
    {"StepRepr_MaterialDesignation", "materials"},
};

void countExtras(const Handle(Interface_InterfaceModel) & model, CadShape& out) {
  std::map<std::string, int> found;
  for (int i = 1; i <= model->NbEntities(); ++i)
    if (const auto at = kStepExtras.find(model->Value(i)->DynamicType()->Name()); at != kStepExtras.end())
      ++found[at->second];
  for (const auto& [what, n] : found) out.dropped.push_back(std::to_string(n) + " " + what);
}

/// Moves and grows a shape in millimetres that the file has in another unit.
TopoDS_Shape scaled(const TopoDS_Shape& shape, double metres) {
  if (metres == 1e-3) return shape;
  gp_Trsf grow;
  grow.SetScale(gp_Pnt(0, 0, 0), metres / 1e-3);
  return BRepBuilderAPI_Transform(shape, grow, true).Shape();
}

/// Names of the faces that entities were made into.
class Names {
 public:
  Names(const Handle(XSControl_WorkSession) & session, const Handle(Interface_InterfaceModel) & model) {
    const Handle(Transfer_TransientProcess) made = session->TransferReader()->TransientProcess();
    for (int i = 1; i <= model->NbEntities(); ++i) {
      const std::string name = nameOf(model->Value(i));
      if (name.empty()) continue;
      const TopoDS_Shape shape = TransferBRep::ShapeResult(made, model->Value(i));
      if (!shape.IsNull() && shape.ShapeType() == TopAbs_FACE) names_[shape.TShape().get()] = name;
    }
  }
  std::string operator()(const TopoDS_Shape& face) const {
    const auto at = names_.find(face.TShape().get());
    return at == names_.end() ? "" : at->second;
  }

 private:
  static std::string nameOf(const Handle(Standard_Transient) & entity) {
    if (const auto item = Handle(StepRepr_RepresentationItem)::DownCast(entity); !item.IsNull())
      return withoutEnds(textOf(item->Name()));
    if (const auto iges = Handle(IGESData_IGESEntity)::DownCast(entity); !iges.IsNull() && iges->HasName())
      return withoutEnds(textOf(iges->NameValue()));
    return "";
  }
  std::map<const TopoDS_TShape*, std::string> names_;
};

void requireRead(IFSelect_ReturnStatus status, const char* format) {
  if (status != IFSelect_RetDone)
    throw InputError({"", 0, ""}, std::string("is no ") + format + " file, or a damaged one");
}

CadShape readStep(const std::string& file, double metres) {
  STEPControl_Reader reader;
  requireRead(reader.ReadFile(file.c_str()), "STEP");
  CadShape out;
  TColStd_SequenceOfAsciiString lengths, angles, solid_angles;
  reader.FileUnits(lengths, angles, solid_angles);
  for (int i = 1; i <= lengths.Length(); ++i) {
    const std::string unit = lengths(i).ToCString();
    if (out.unit.find(unit) == std::string::npos) out.unit += (out.unit.empty() ? "" : ", ") + unit;
  }
  if (reader.NbRootsForTransfer() == 0) throw InputError({"", 0, ""}, "has no shapes");
  if (out.unit.empty() && metres == 0)
    throw InputError({"", 0, ""}, "does not say its unit of length; --unit mm (or in, m, ...) says it");
  if (!out.unit.empty() && metres != 0)
    throw InputError({"", 0, ""}, "says its unit of length (" + out.unit + "); leave out --unit");
  reader.TransferRoots();
  countExtras(reader.Model(), out);
  addFaces(scaled(reader.OneShape(), out.unit.empty() ? metres : 1e-3), Names(reader.WS(), reader.Model()), out);
  return out;
}

CadShape readIges(const std::string& file, double metres) {
  IGESControl_Reader reader;
  requireRead(reader.ReadFile(file.c_str()), "IGES");
  CadShape out;
  const Handle(IGESData_IGESModel) model = reader.IGESModel();
  if (model->NbEntities() == 0) requireRead(IFSelect_RetFail, "IGES");
  const IGESData_GlobalSection& global = model->GlobalSection();
  if (global.UnitFlag() < 1 || global.UnitFlag() > 11)
    throw InputError({"", 0, "unit flag of the global section"},
                     std::to_string(global.UnitFlag()) + ", must be 1 to 11; save the file in millimetres (2)");
  out.unit = withoutEnds(textOf(global.UnitName()));
  if (metres != 0) throw InputError({"", 0, ""}, "says its unit of length (" + out.unit + "); leave out --unit");
  reader.TransferRoots();
  const Handle(XSControl_TransferReader) transfer = reader.WS()->TransferReader();
  std::map<int, int> left;
  for (int i = 1; i <= reader.NbRootsForTransfer(); ++i)
    if (const auto root = Handle(IGESData_IGESEntity)::DownCast(reader.RootForTransfer(i));
        !root.IsNull() && transfer->ShapeResult(root).IsNull())
      ++left[root->TypeNumber()];
  for (const auto& [type, n] : left)
    out.dropped.push_back(std::to_string(n) + " entities of type " + std::to_string(type) + ", which are no shapes");
  addFaces(reader.OneShape(), Names(reader.WS(), model), out);
  return out;
}

CadShape readBrep(const std::string& file, double metres) {
  TopoDS_Shape shape;
  std::ifstream in(file);
  BRep_Builder builder;
  // Its reader goes on and on where a damaged file ends.
  in.exceptions(std::ios::failbit | std::ios::badbit);
  try {
    BRepTools::Read(shape, in, builder);
  } catch (const std::ios_base::failure&) {
    shape.Nullify();
  }
  if (shape.IsNull()) throw InputError({"", 0, ""}, "is no .brep file of OpenCASCADE, or a damaged one");
  CadShape out;
  if (metres == 0)
    out.notes.push_back("a .brep file says no unit: read as mm, as OpenCASCADE does; --unit says another");
  addFaces(
      scaled(shape, metres == 0 ? 1e-3 : metres), [](const TopoDS_Shape&) { return std::string(); }, out);
  return out;
}

}  // namespace

CadShape readShape(const std::string& file, CadFormat format, double metres) {
  switch (format) {
    case CadFormat::step:
      return readStep(file, metres);
    case CadFormat::iges:
      return readIges(file, metres);
    case CadFormat::brep:
      break;
  }
  return readBrep(file, metres);
}

}  // namespace gambeson
