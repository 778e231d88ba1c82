#include "cases/wear/run/export.hpp"

#include <fmt/format.h>

#include "analysis/opensim.hpp"
#include "cases/cad/cad_file.hpp"
#include "cases/cad/tidy.hpp"
#include "cases/wear/results/results.hpp"
#include "cases/wear/results/write.hpp"
#include "core/error.hpp"
#include "core/io/iges.hpp"

namespace gambeson {
namespace {

NurbsPatch patchOf(const PatchLayout& layout) {
  return {{layout.degree_u, layout.knots_u}, {layout.degree_v, layout.knots_v}, {}, layout.weights};
}

Trim trimOf(const PatchLayout& layout) {
  Trim trim;
  for (const PatchLayout::Curve& c : layout.trims) {
    trim.loops.resize(static_cast<std::size_t>(c.loop) + 1);
    NurbsCurve curve{{c.degree, c.knots}, {}, c.weights};
    for (std::size_t k = 0; k + 1 < c.points.size(); k += 2) curve.points.push_back({c.points[k], c.points[k + 1]});
    trim.loops.back().push_back(std::move(curve));
  }
  return trim;
}

/// The recorded patches where a frame has their control points.
std::vector<IgesSurface> surfacesOf(const RecordingLayout& layout, const Frame& frame, const char* option) {
  if (layout.patches.empty())
    throw InputError({"command line", 0, option}, "needs cloth of NURBS patches; this run has none");
  const Field* position = nullptr;
  for (const Field& f : frame.control_fields)
    if (f.name == "position") position = &f;
  std::vector<IgesSurface> surfaces;
  std::size_t at = 0;
  for (const PatchLayout& p : layout.patches) {
    surfaces.push_back({p.name, patchOf(p), trimOf(p)});
    NurbsPatch& patch = surfaces.back().patch;
    patch.points.resize(static_cast<std::size_t>(patch.size()));
    if (!position || position->data.size() < at + 3 * patch.points.size())
      throw RunError("the recording's frames have no control points of its patches");
    for (Vec3& x : patch.points) {
      x = {position->data[at], position->data[at + 1], position->data[at + 2]};
      at += 3;
    }
  }
  return surfaces;
}

void writeStep(const std::filesystem::path& file, const std::string& title, const std::vector<IgesSurface>& surfaces) {
  CadShape shape;
  for (const IgesSurface& s : surfaces)
    for (CadFace& f : cadFaces(s.name, s.patch, s.trim)) shape.faces.push_back(std::move(f));
  writeCad(file, title, shape);
}

}  // namespace

int exportResults(const ExportOptions& o) {
  if (o.step.empty() && o.iges.empty() && o.opensim.empty())
    throw InputError({"command line", 0, ""}, "nothing to write: give --step FILE, --iges FILE or --opensim PREFIX");
  const auto [recording, scenario, facts] = recordedRun(o.results);
  const Measured measured = measure(*scenario, recording);
  if (!o.step.empty() || !o.iges.empty()) {
    const int frame = frameOf(recording, measured, {o.when, o.time_s});
    const std::string title = fmt::format("{}, {:.3f} s", scenario->definition.name, recording.time(frame));
    const std::vector<IgesSurface> surfaces =
        surfacesOf(recording.layout(), recording.frame(frame), o.step.empty() ? "--iges" : "--step");
    if (!o.iges.empty()) writeIges(o.iges, title, surfaces);
    if (!o.step.empty()) writeStep(o.step, title, surfaces);
    for (const std::filesystem::path& file : {o.step, o.iges})
      if (!file.empty())
        fmt::print("{}: the garment at {:.3f} s, {} surfaces\n", file.string(), recording.time(frame),
                   scenario->patch_names.size());
  }
  if (!o.opensim.empty()) {
    if (!scenario->human)
      throw InputError({"command line", 0, "--opensim"}, "needs results of a human; this run has none");
    writeOpenSim(*scenario, measured, o.opensim);
    fmt::print("{0}.xml and {0}.mot: forces of the cloth on the body, {1} windows\n", o.opensim.string(),
               measured.windows.size());
  }
  return 0;
}

void writeOpenSim(const Scenario& s, const Measured& m, const std::filesystem::path& prefix) {
  std::vector<ContactWindow> windows = m.windows;
  std::vector<double> time_s;
  for (ContactWindow& w : windows) {
    w.links.resize(s.human->skeleton.links.size());
    time_s.push_back(w.middle());
  }
  writeExternalLoads(prefix, s.definition.name, time_s, externalLoads(*s.human, *s.motion, 0, windows));
}

}  // namespace gambeson
