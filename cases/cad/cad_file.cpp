#include "cases/cad/cad_file.hpp"

#include <algorithm>
#include <cctype>
#include <fstream>

#include "cases/cad/tidy.hpp"
#include "core/error.hpp"
#include "core/io/beside.hpp"
#include "core/io/own_file.hpp"

namespace gambeson {
namespace {

const CadModule& loaded() {
  return *reinterpret_cast<const CadModule* (*)()>(
      functionBeside("gambeson_cad.so", "gambesonCadModule", "OpenCASCADE"))();
}

/// OpenCASCADE needs some seconds for a megabyte.
ApartLimits limits(const std::filesystem::path& file) {
  ApartLimits out = limitsFor(file);
  std::error_code error;
  const auto size = std::filesystem::file_size(file, error);
  if (!error) out.cpu_s += static_cast<double>(size) / (256 << 10);
  return out;
}

}  // namespace

bool isCadFile(const std::filesystem::path& file, CadFormat& format) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  if (ending == ".step" || ending == ".stp")
    format = CadFormat::step;
  else if (ending == ".igs" || ending == ".iges")
    format = CadFormat::iges;
  else if (ending == ".brep")
    format = CadFormat::brep;
  else
    return false;
  return true;
}

CadShape readCad(const std::filesystem::path& file, double metres) {
  CadFormat format{};
  if (!isCadFile(file, format))
    throw InputError({file.string(), 0, ""}, "is no CAD file; allowed: .step, .stp, .igs, .iges and .brep");
  if (!std::ifstream(file)) throw InputError({file.string(), 0, ""}, "cannot be read");
  try {
    BytesIn in =
        readApart(file, limits(file), [&](BytesOut& out) { put(out, loaded().read(file.string(), format, metres)); });
    CadShape shape;
    get(in, shape);
    if (shape.faces.empty())
      throw InputError({"", 0, ""}, "has no faces; curves and points make no cloth: save surfaces or a shell");
    tidyFaces(shape);
    return shape;
  } catch (const InputError& e) {
    throw InputError({file.string(), e.where().line, e.where().key}, e.reason());
  }
}

void writeCad(const std::filesystem::path& file, const std::string& title, const CadShape& shape, double tolerance_m) {
  CadFormat format{};
  if (!isCadFile(file, format) || format == CadFormat::brep)
    throw InputError({file.string(), 0, ""}, "is neither STEP (.step, .stp) nor IGES (.igs, .iges)");
  ApartLimits most = limits(file);
  most.cpu_s = 120;
  std::string text;
  try {
    readApart(file, most, [&](BytesOut& out) { out.put(loaded().write(title, shape, format, tolerance_m)); }).get(text);
  } catch (const InputError& e) {
    throw RunError(file.string() + ": cannot be written: " + e.reason());
  }
  writeOwnFile(file, text);
}

}  // namespace gambeson
