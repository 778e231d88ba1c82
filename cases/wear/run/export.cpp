#include "cases/wear/run/export.hpp"

#include <fmt/format.h>

#include "analysis/opensim.hpp"
#include "cases/wear/results/results.hpp"
#include "cases/wear/results/write.hpp"
#include "core/error.hpp"
#include "core/io/iges.hpp"

namespace gambeson {
namespace {

/// The garment's patches where a frame has their control points.
std::vector<IgesSurface> surfacesOf(const Scenario& s, const Frame& frame) {
  const Garment& garment = s.model->shell.garment();
  std::vector<IgesSurface> surfaces;
  const Field* position = nullptr;
  for (const Field& f : frame.control_fields)
    if (f.name == "position") position = &f;
  if (!position || position->data.size() != 3 * static_cast<std::size_t>(s.model->shell.controlCount()))
    throw RunError("the recording's frames have no control points of this garment");
  std::size_t at = 0;
  for (std::size_t p = 0; p < garment.patches.size(); ++p) {
    IgesSurface surface{s.patch_names[p], garment.patches[p], garment.trims.empty() ? Trim{} : garment.trims[p]};
    for (Vec3& x : surface.patch.points) {
      x = {position->data[at], position->data[at + 1], position->data[at + 2]};
      at += 3;
    }
    surfaces.push_back(std::move(surface));
  }
  return surfaces;
}

}  // namespace

int exportResults(const ExportOptions& o) {
  if (o.iges.empty() && o.opensim.empty())
    throw InputError({"command line", 0, ""}, "nothing to write: give --iges FILE or --opensim PREFIX");
  const auto scenario = scenarioOfResults(o.results);
  const RecordingReader recording(o.results);
  const Measured measured = measure(*scenario, recording);
  if (!o.iges.empty()) {
    const int frame = frameOf(recording, measured, {o.when, o.time_s});
    writeIges(o.iges, fmt::format("{}, {:.3f} s", scenario->definition.name, recording.time(frame)),
              surfacesOf(*scenario, recording.frame(frame)));
    fmt::print("{}: the garment at {:.3f} s, {} surfaces\n", o.iges.string(), recording.time(frame),
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
