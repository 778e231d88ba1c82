/// Detail of read.hpp: the entry of the library (cases/cad/module.hpp), and the exceptions of OpenCASCADE as ours.

#include "cases/cad/module.hpp"

#include <Standard_Failure.hxx>
#include <Standard_OutOfMemory.hxx>
#include <new>

#include "cases/occt/read.hpp"
#include "cases/occt/write.hpp"
#include "core/error.hpp"

namespace gambeson {
namespace {

/// OpenCASCADE's exceptions are no std::exception.
template <class Work>
auto guarded(const Work& work) {
  try {
    return work();
  } catch (const Standard_OutOfMemory&) {
    throw std::bad_alloc();
  } catch (const Standard_Failure& e) {
    throw RunError(std::string("OpenCASCADE fails, as on damaged files (save it again): ") + e.DynamicType()->Name() +
                   (e.GetMessageString() && *e.GetMessageString() ? std::string(", ") + e.GetMessageString() : ""));
  }
}

CadShape read(const std::string& file, CadFormat format, double metres) {
  return guarded([&] { return readShape(file, format, metres); });
}

std::string write(const std::string& title, const CadShape& shape, CadFormat format, double tolerance_m) {
  return guarded([&] { return shapeText(title, shape, format, tolerance_m); });
}

}  // namespace
}  // namespace gambeson

const gambeson::CadModule* gambesonCadModule() {
  static const gambeson::CadModule module{gambeson::read, gambeson::write};
  return &module;
}
