#include "human/recorded/motion_file.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.hpp"
#include "human/recorded/captured_motion.hpp"
#include "human/recorded/retarget.hpp"

namespace gambeson {
namespace {

std::string endingOf(const std::filesystem::path& path) {
  std::string e = path.extension().string();
  std::transform(e.begin(), e.end(), e.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return e;
}

std::optional<WorldAxes> worldOf(const MotionFileOptions& o) {
  if (o.forward.empty() && o.up.empty()) return std::nullopt;
  const std::string file = o.path.string();
  if (o.forward.empty() || o.up.empty())
    throw InputError({file, 0, o.up.empty() ? "up" : "forward"}, "is missing: \"up\" and \"forward\" go together");
  const WorldAxes w{namedAxis(o.forward), namedAxis(o.up)};
  if (w.forward == Vec3{}) throw InputError({file, 0, "forward"}, "'" + o.forward + "' is not allowed: x, -x, y, ...");
  if (w.up == Vec3{}) throw InputError({file, 0, "up"}, "'" + o.up + "' is not allowed: x, -x, y, ...");
  if (dot(w.forward, w.up) != 0) throw InputError({file, 0, "up"}, "must be across \"forward\"");
  return w;
}

/// The maps that may go with a file: the one named, or those that its names point to.
std::vector<JointMap> mapsOf(const MotionFileOptions& o, const std::vector<MapKind>& kinds,
                             const std::vector<std::string>& names) {
  std::vector<JointMap> maps;
  if (!o.map.empty())
    maps.push_back(findJointMap(o.map));
  else
    maps = mapsFor(kinds, names);
  if (maps.empty())
    throw InputError({o.path.string(), 0, "map"},
                     "no map that ships goes with the names in this file: name one of your own as \"map\"");
  if (std::find(kinds.begin(), kinds.end(), maps.front().kind) == kinds.end())
    throw InputError({o.path.string(), 0, "map"}, "'" + o.map + "' reads another kind of file");
  return maps;
}

/// The first map whose joints stay within what they can do; where there are several they differ in signs.
CapturedMotion readAngles(const MotionFileOptions& o, const Human& human, const std::optional<WorldAxes>& world) {
  const StorageTable table = readStorage(o.path);
  const auto maps = mapsOf(o, {MapKind::coordinates}, table.names);
  for (std::size_t i = 0; i + 1 < maps.size(); ++i) try {
      return recordAngles(table, maps[i], human, world);
    } catch (const InputError&) {  // the next map says why, if it is the last
    }
  return recordAngles(table, maps.back(), human, world);
}

CapturedMotion readCapturedMotion(const MotionFileOptions& o, const Human& human) {
  const std::string ending = endingOf(o.path), file = o.path.string();
  const auto world = worldOf(o);
  if (ending != ".trc" && !o.model.empty()) throw InputError({file, 0, "model"}, "goes with markers (.trc) only");
  if (ending == ".mot" || ending == ".sto") return readAngles(o, human, world);
  if (ending == ".bvh") {
    const BvhClip clip = readBvh(o.path);
    std::vector<std::string> names;
    for (const BvhJoint& j : clip.joints) names.push_back(j.name);
    return recordBones(clip, mapsOf(o, {MapKind::bones}, names).front(), human, world);
  }
  if (ending == ".trc") {
    const MarkerTable table = readTrc(o.path);
    const JointMap map = mapsOf(o, {MapKind::markers, MapKind::points}, table.names).front();
    if (o.model.empty()) return recordMarkers(table, map, nullptr, human, world);
    const OsimModel model = readOsim(o.model);
    return recordMarkers(table, map, &model, human, world);
  }
  if (ending == ".c3d")
    throw InputError(
        {file, 0, ""},
        "is a C3D file, which is not read: write its markers as .trc (OpenSim: C3DFileAdapter and "
        "TRCFileAdapter; Mokka: File, Export to, TRC) and hand that in, or run OpenSim's inverse kinematics "
        "and hand in the .mot file");
  if (ending == ".csv") throw InputError({file, 0, ""}, "is a table of our own joints: it goes with \"trajectory\"");
  throw InputError({file, 0, ""}, "'" + ending + "' is not read: .mot, .sto, .bvh or .trc");
}

}  // namespace

std::unique_ptr<Motion> loadMotionFile(const MotionFileOptions& o, const Human& human, MotionFileNotes* notes) {
  MotionFileNotes mine;
  MotionFileNotes& n = notes ? *notes : mine;
  const CapturedMotion r = readCapturedMotion(o, human);
  n.map = r.map;
  n.lines = r.notes;
  return retarget(r, human, o, n);
}

}  // namespace gambeson
