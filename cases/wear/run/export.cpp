#include "cases/wear/run/export.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "analysis/animation/glb.hpp"
#include "analysis/animation/obj.hpp"
#include "analysis/opensim.hpp"
#include "analysis/opensim_model.hpp"
#include "cases/cad/cad_file.hpp"
#include "cases/cad/tidy.hpp"
#include "cases/input/message.hpp"
#include "cases/wear/results/animation.hpp"
#include "cases/wear/results/results.hpp"
#include "cases/wear/results/write.hpp"
#include "core/error.hpp"
#include "core/io/own_file.hpp"

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

/// The recorded patches where a frame has their control points, as faces.
CadShape facesOf(const RecordingLayout& layout, const Frame& frame, const char* option) {
  if (layout.patches.empty())
    throw InputError({"command line", 0, option}, "needs cloth of NURBS patches; this run has none");
  const Field* position = nullptr;
  for (const Field& f : frame.control_fields)
    if (f.name == "position") position = &f;
  CadShape shape;
  std::size_t at = 0;
  for (const PatchLayout& p : layout.patches) {
    NurbsPatch patch = patchOf(p);
    patch.points.resize(static_cast<std::size_t>(patch.size()));
    if (!position || position->data.size() < at + 3 * patch.points.size())
      throw RunError("the recording's frames have no control points of its patches");
    for (Vec3& x : patch.points) {
      x = {position->data[at], position->data[at + 1], position->data[at + 2]};
      at += 3;
    }
    for (CadFace& f : cadFaces(p.name, patch, trimOf(p))) shape.faces.push_back(std::move(f));
  }
  return shape;
}

/// Where all the frames that are asked for would make too large a file, as many as do not, and says so.
void fewerFrames(const Scenario& s, const RecordingReader& recording, AnimationOptions& how, const ExportOptions& o) {
  std::size_t asked = animatedFrames(recording);
  if (how.frames > 0) asked = std::min(asked, static_cast<std::size_t>(how.frames));
  AnimationOptions two = how;
  two.frames = 2;
  const GlbSize size = glbSize(animationOf(s, recording, two).scene);
  const auto MB = [](double bytes) { return 1e-6 * bytes; };
  constexpr double kSure = 0.99;  // sizes are known within 1 %
  if (size.bytes(asked) <= kSure * o.largest_glb) return;
  const std::size_t most = size.most(kSure * o.largest_glb);
  if (most < 2)
    throw RunError(fmt::format("{} would have {:.0f} MB with two frames alone; at most {:.0f} MB are written",
                               o.glb.string(), MB(size.bytes(2)), MB(o.largest_glb)));
  how.frames = static_cast<int>(most);
  sayNote(fmt::format("{} would have {:.0f} MB with {} frames; at most {:.0f} MB are written, with {} frames, evenly",
                      o.glb.string(), MB(size.bytes(asked)), asked, MB(o.largest_glb), most));
}

/// "walk.glb: 42 frames, 8.1 MB".
void writeGlb(const Scenario& s, const RecordingReader& recording, AnimationOptions how, const ExportOptions& o) {
  const std::filesystem::path& file = o.glb;
  constexpr double kSkin_m = 1e-3;  // single precision and rounding of weights stay far below
  fewerFrames(s, recording, how, o);
  const Animation animation = animationOf(s, recording, how);
  if (!(animation.skin_error_m <= kSkin_m))
    throw RunError(
        fmt::format("the body of the animation would be {:.2g} mm off that of the run", 1e3 * animation.skin_error_m));
  const Glb glb = encodeGlb(animation.scene);
  writeOwnFile(file, glb.bytes);
  fmt::print("{}: {} frames, {:.1f} MB, cloth within {:.2g} mm of the recording", file.string(),
             animation.scene.time_s.size(), 1e-6 * static_cast<double>(glb.bytes.size()), 1e3 * glb.error_m);
  if (!animation.scene.skinned.empty()) fmt::print(", the body within {:.2g} mm", 1e3 * animation.skin_error_m);
  fmt::print("\n");
  for (const auto& [word, text] : animation.scene.notes)
    if (word == "colors") fmt::print("Colours: {}\n", text);
}

void writeObjs(const Scenario& s, const RecordingReader& recording, AnimationOptions how,
               const std::filesystem::path& file) {
  how.skins = false;
  how.field = PictureField::plain;
  const AnimatedScene scene = animationOf(s, recording, how).scene;
  const std::size_t count = scene.time_s.size();
  for (std::size_t k = 0; k < count; ++k) writeOwnFile(numbered(file.string(), k), encodeObj(scene, k));
  // Of an earlier sequence that was longer.
  for (std::size_t k = count; isOwnFile(numbered(file.string(), k)); ++k) removeOwnFile(numbered(file.string(), k));
  fmt::print("{} to {}: a frame each, {:.3f} to {:.3f} s\n", numbered(file.string(), 0),
             numbered(file.string(), count - 1), scene.time_s.front(), scene.time_s.back());
}

}  // namespace

const std::vector<ExportFormat>& exportFormats() {
  using O = ExportOptions;
  static const std::vector<ExportFormat> formats{
      {{".glb"}, "an animation (binary glTF 2.0): body, garments, colours of one time", &O::glb},
      {{".obj"}, "a file of each frame, walk_0001.obj ..., with body and garments as groups", &O::obj},
      {{".igs", ".iges"}, "the garment at one time as NURBS surfaces in sewn shells, for CAD (IGES 5.3)", &O::iges},
      {{".step", ".stp"}, "the same as STEP (AP214)", &O::step}};
  return formats;
}

int exportResults(const ExportOptions& o) {
  if (o.step.empty() && o.iges.empty() && o.opensim.empty() && o.glb.empty() && o.obj.empty())
    throw InputError({"command line", 0, ""}, "nothing to write: give -o FILE or --opensim PREFIX");
  if (o.field == PictureField::body_pressure)
    throw InputError({"command line", 0, "--field"}, "\"body_pressure\" is no field of garments");
  const auto [recording, scenario, facts] = recordedRun(o.results);
  const Measured measured = measure(*scenario, recording);
  const int frame = frameOf(recording, measured, {o.when, o.time_s});
  const AnimationOptions how{o.frames, frame, o.field};
  if (!o.glb.empty()) writeGlb(*scenario, recording, how, o);
  if (!o.obj.empty()) writeObjs(*scenario, recording, how, o.obj);
  if (!o.step.empty() || !o.iges.empty()) {
    const std::string title = fmt::format("{}, {:.3f} s", scenario->definition.name, recording.time(frame));
    const CadShape shape = facesOf(recording.layout(), recording.frame(frame), o.step.empty() ? "--iges" : "--step");
    for (const std::filesystem::path& file : {o.step, o.iges})
      if (!file.empty()) {
        writeCad(file, title, shape);
        fmt::print("{}: the garment at {:.3f} s, {} surfaces\n", file.string(), recording.time(frame),
                   scenario->patch_names.size());
      }
  }
  if (!o.opensim.empty()) {
    if (!scenario->human)
      throw InputError({"command line", 0, "--opensim"}, "needs results of a human; this run has none");
    writeOpenSim(*scenario, measured, o.opensim);
    fmt::print(
        "{0}.xml and {0}.mot: forces of the cloth on the body, {1} windows\n"
        "{0}.osim and {0}_motion.mot: the body, and its motion at the same times\n",
        o.opensim.string(), measured.windows.size());
  }
  return 0;
}

void writeOpenSim(const Scenario& s, const Measured& m, const std::filesystem::path& prefix) {
  std::vector<ContactWindow> windows = m.windows;
  std::vector<double> time_s;
  std::vector<Posture> postures;
  for (ContactWindow& w : windows) {
    w.links.resize(s.human->skeleton.links.size());
    time_s.push_back(w.middle());
    postures.push_back(s.motion->at(w.middle()));
  }
  const Skeleton& skeleton = s.human->skeleton;
  const std::filesystem::path motion = prefix.string() + "_motion.mot";
  writeOwnFile(prefix.string() + ".osim", openSimModel(skeleton, s.definition.name));
  writeOwnFile(motion, openSimMotion(motion.filename().string(), skeleton, time_s, postures));
  writeExternalLoads(prefix, s.definition.name, time_s, externalLoads(*s.human, *s.motion, 0, windows));
}

}  // namespace gambeson
