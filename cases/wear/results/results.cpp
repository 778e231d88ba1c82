#include "cases/wear/results/results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "analysis/tables.hpp"
#include "cases/input/json_at.hpp"
#include "cases/input/message.hpp"
#include "cases/runs/recorded_case.hpp"
#include "cases/runs/results_folder.hpp"
#include "cases/runs/temporary_folder.hpp"
#include "cases/wear/recording/recorded_scene.hpp"
#include "cases/wear/results/check_words.hpp"
#include "cases/wear/results/film.hpp"
#include "cases/wear/results/girths.hpp"
#include "cases/wear/results/viewer.hpp"
#include "cases/wear/results/write.hpp"
#include "core/error.hpp"
#include "core/io/own_file.hpp"

namespace gambeson {
namespace {

using Json = nlohmann::ordered_json;

std::string pictureName(std::size_t number, const PictureCase& p, double time_s) {
  const char* field = p.field == PictureField::stress          ? "stress"
                      : p.field == PictureField::pressure      ? "pressure"
                      : p.field == PictureField::strain        ? "strain"
                      : p.field == PictureField::thickness     ? "thickness"
                      : p.field == PictureField::body_pressure ? "body_pressure"
                      : p.field == PictureField::set           ? "set"
                      : p.field == PictureField::friction      ? "friction"
                                                               : "plain";
  const std::string when = p.when == PictureTime::peak  ? "peak"
                           : p.when == PictureTime::end ? "end"
                                                        : fmt::format("{:.0f}ms", 1e3 * time_s);
  return fmt::format("{:02d}_{}_{}_{}.png", number, field, when, viewNames()[static_cast<std::size_t>(p.view)]);
}

/// The case's pictures into `folder`. One that fails leaves its reason in `failures` and does not stop the others.
std::vector<Picture> takePictures(const Scenario& s, const RecordingReader& recording, const Measured& m,
                                  const std::filesystem::path& folder, std::vector<std::string>& failures) {
  std::vector<Picture> pictures;
  std::filesystem::create_directories(folder);
  // An arrow is as long as the picture is large, for one force in all of them; each field has one range of colours.
  std::map<PictureField, double> highest;
  std::map<PictureAround, PictureScale> scales;
  double most_N = 0;
  for (const bool draw : {false, true})
    for (const PictureCase& picture : picturesOf(s.definition)) {
      std::string name;
      try {
        const int frame = frameOf(recording, m, picture);
        if (!draw) {
          if (!highest.contains(picture.field)) highest[picture.field] = fieldRange(s, recording, picture.field);
          const PictureScale own = scaleOf(s, recording, frame, picture);
          highest[picture.field] = std::max(highest[picture.field], own.high);
          scales[picture.around].include(own);
          most_N = std::max(most_N, own.most_N);
          continue;
        }
        const double time = recording.time(frame);
        name = pictureName(pictures.size() + 1, picture, time);
        PictureScale scale = scales[picture.around];
        scale.high = highest[picture.field], scale.most_N = most_N;
        renderFrame(s, recording, frame, picture, scale, folder / name);
        pictures.push_back({folder / name, captionOf(picture, time, s.definition.comfort.sensor_m), ""});
      } catch (const RunError& e) {
        if (draw) failures.push_back(fmt::format("The picture {} could not be drawn: {}", name, e.what()));
      }
    }
  return pictures;
}

/// A film of what is worn, where the case names no pictures.
void takeFilm(const Scenario& s, const RecordingReader& recording, const std::filesystem::path& dir,
              std::vector<std::string>& failures, ReportInput& in) {
  const int count = recording.frameCount();
  if (s.definition.output.pictures || count < 2 || !(recording.time(count - 1) > 0)) return;
  FilmRequest film;
  film.results = {dir};
  film.output = dir / kFilmFile;
  film.picture = picturesOf(s.definition).front();
  const PictureSize size = sizeOf(s, film.picture);
  film.picture.width = size.width * 5 / 8, film.picture.height = size.height * 5 / 8;
  try {
    renderFilm(film);
    in.facts.push_back({"Film", std::string(kFilmFile) + ", beside this page"});
  } catch (const RunError& e) {
    failures.push_back(fmt::format("The film could not be drawn: {}", e.what()));
  }
}

std::vector<Picture> takeBodyPictures(const Scenario& s, const Measured& m, const std::filesystem::path& folder,
                                      std::vector<std::string>& failures) {
  try {
    return takeBodyPictures(s, m, folder);
  } catch (const RunError& e) {
    failures.push_back(fmt::format("The pictures of the body could not be drawn: {}", e.what()));
    return {};
  }
}

}  // namespace

std::vector<double> WindowTimes::row() const {
  std::vector<double> row{start_s, end_s};
  row.insert(row.end(), phases_s.begin(), phases_s.end());
  return row;
}

void writeRunFacts(const RunFacts& f, const std::filesystem::path& dir) {
  Json phases = Json::array();
  for (const auto& [name, seconds] : f.phases_s) phases.push_back({{"phase", name}, {"seconds", seconds}});
  Json windows = Json::array();
  for (const WindowTimes& w : f.windows) windows.push_back(w.row());
  const DeviceFacts& d = f.device;
  Json device{{"kind", wordOf(d.kind)}};
  if (d.kind == DeviceKind::cuda) device.update({{"gpu", d.gpu}, {"driver", d.driver}, {"runtime", d.runtime}});
  if (d.kind != DeviceKind::cpu)
    device.update({{"kernels", d.kernels},
                   {"steps", d.steps},
                   {"steps_by_cpu", d.by_cpu},
                   {"repeated_passes", d.repeated},
                   {"reasons", d.reasons}});
  const Json j{{"version", f.version.empty() ? GAMBESON_VERSION : f.version},
               {"threads", f.threads},
               {"kernels", f.kernels},
               {"wall_s", f.wall_s},
               {"resumed", f.resumed},
               {"searches", f.searches},
               {"searched_steps_s", f.searched_steps_s},
               {"phases", phases},
               {"windows", windows},
               {"recording", f.recording},
               {"device", device}};
  writeOwnFile(dir / "run.json", j.dump(2) + "\n");
}

namespace {

DeviceFacts deviceFacts(const JsonAt& j) {
  DeviceFacts d;
  const std::string kind = j.at("kind").text();
  const auto word = std::find(kDeviceWords.begin(), kDeviceWords.end(), kind);
  if (word == kDeviceWords.end()) throw JsonAt::Error(fmt::format("device.kind: there is no '{}'", kind));
  d.kind = static_cast<DeviceKind>(word - kDeviceWords.begin());
  const auto text = [&](const char* key) { return j.contains(key) ? j.at(key).text() : std::string(); };
  const auto count = [&](const char* key) { return j.contains(key) ? j.at(key).integer() : 0; };
  d.gpu = text("gpu"), d.driver = text("driver"), d.runtime = text("runtime"), d.kernels = text("kernels");
  d.steps = count("steps"), d.by_cpu = count("steps_by_cpu"), d.repeated = count("repeated_passes");
  if (j.contains("reasons"))
    for (const auto& [why, times] : j.at("reasons").items()) d.reasons[why] = times.integer();
  return d;
}

}  // namespace

RunFacts readRunFacts(const std::filesystem::path& dir) {
  RunFacts f;
  const std::filesystem::path file = dir / "run.json";
  std::ifstream stream(file);
  if (!stream) return f;
  try {
    const auto parsed = nlohmann::json::parse(stream);
    const JsonAt j(parsed);
    f.version = j.at("version").text();
    f.threads = j.at("threads").integer();
    f.kernels = j.at("kernels").text();
    f.wall_s = j.at("wall_s").number();
    f.resumed = j.at("resumed").flag();
    if (j.contains("searches")) f.searches = j.at("searches").integer();
    if (j.contains("searched_steps_s")) f.searched_steps_s = j.at("searched_steps_s").number();
    if (j.contains("device")) f.device = deviceFacts(j.at("device"));
    if (j.contains("recording")) f.recording = j.at("recording").text();
    for (const JsonAt& p : j.at("phases").list())
      f.phases_s.emplace_back(p.at("phase").text(), p.at("seconds").number());
    for (const JsonAt& window : j.at("windows").list()) {
      std::vector<double> row;
      for (const JsonAt& number : window.list()) row.push_back(number.number());
      if (row.size() != 2 + f.phases_s.size())
        throw JsonAt::Error(fmt::format("windows[{}]: must be {} numbers: from, to and the time of each phase",
                                        f.windows.size(), 2 + f.phases_s.size()));
      f.windows.push_back({row[0], row[1], {row.begin() + 2, row.end()}});
    }
  } catch (const JsonAt::Error& e) {
    throw InputError({file.string(), 0, ""}, e.what());
  } catch (const nlohmann::json::exception& e) {
    throw InputError({file.string(), 0, ""}, jsonReason(e.what()));
  }
  return f;
}

RecordedRun recordedRun(const std::filesystem::path& dir) {
  const std::filesystem::path file = caseFile(dir);
  RecordingReader recording(dir);
  const RecordingLayout& layout = recording.layout();
  requireRecordedCase(dir, layout);
  RunFacts facts = readRunFacts(dir);
  if (!facts.recording.empty() && facts.recording != layout.identity)
    throw InputError({(dir / "run.json").string(), 0, "recording"},
                     "is of another run than what was recorded in " + (dir / "frames").string());
  std::unique_ptr<Scenario> scenario = scenarioOf(readRecordedCase(file), layout.scene, (dir / "frames").string());
  return {std::move(recording), std::move(scenario), std::move(facts)};
}

void writeResults(const std::filesystem::path& dir) {
  const auto [recording, scenario, facts] = recordedRun(dir);
  const Scenario& s = *scenario;
  Measured m = measureAll(s, recording);
  measureCloth(s, recording, m);
  writeSummary(s, recording, m, facts, dir / "summary.json");
  if (s.human) {
    std::vector<TorqueVariant> variants{{"friction", &m.added_friction}};
    if (s.hasSkin())
      variants.insert(variants.end(),
                      {{"segments", &m.added_segments}, {"proximal", &m.added_proximal}, {"distal", &m.added_distal}});
    writeTorques(dir / "torques.csv", s.human->skeleton, m.added, variants);
  }
  writeContact(dir / "contact.csv", m.bodies, m.windows);
  writeZones(dir / "zones.csv", m.zones);
  if (!m.comfort.empty()) writePressures(dir / "pressures.csv", s, m);
  writeCloth(dir, s, m);
  writeCollisions(dir / "collisions.csv", m.steps.collisions);
  writeEnergy(dir / "energy.csv", m.energy.rows);
  if (!m.memory.rows.empty()) writeMemory(dir / "memory.csv", m.memory);
  if (!m.touch.empty()) writeLatitude(dir / "latitude.csv", m.touch);
  writeStress(dir / "stress.csv", m.regions, m.frames);
  std::vector<std::string> failures;
  const std::vector<Picture> pictures = takePictures(s, recording, m, dir / "snapshots", failures);
  ReportInput in = reportInput(s, m, facts, recording.layout().identity, pictures);
  in.comfort_pictures = takeBodyPictures(s, m, dir / "snapshots", failures);
  addViewer(s, recording, m, in);
  takeFilm(s, recording, dir, failures, in);
  in.warnings.insert(in.warnings.end(), failures.begin(), failures.end());
  writeReport(in, dir / "report.html");
  for (const ShortMeasure& t : m.too_short) sayNote(doesNotFit(t));
  for (const AuditCheck& c : in.audit)
    if (!c.holds()) fmt::print(notes(), "{}\n", messageText(notMet(c.name, c.value, c.limit, c.unit)));
  if (!failures.empty()) throw RunError(failures.front() + " (the numbers and the report are in " + dir.string() + ")");
}

int reportResults(const ReportOptions& o) {
  const auto [recording, scenario, facts] = recordedRun(o.results);
  const Measured m = measureAll(*scenario, recording);
  const TemporaryFolder folder;
  std::vector<std::string> failures;
  const std::vector<Picture> pictures = takePictures(*scenario, recording, m, folder.path(), failures);
  ReportInput in = reportInput(*scenario, m, facts, recording.layout().identity, pictures);
  in.comfort_pictures = takeBodyPictures(*scenario, m, folder.path(), failures);
  addViewer(*scenario, recording, m, in);
  in.warnings.insert(in.warnings.end(), failures.begin(), failures.end());
  writeReport(in, o.html);
  if (!failures.empty()) throw RunError(failures.front() + " (the report is " + o.html.string() + ")");
  return 0;
}

}  // namespace gambeson
