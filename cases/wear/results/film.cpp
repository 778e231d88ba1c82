#include "cases/wear/results/film.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "cases/film/film.hpp"
#include "cases/input/message.hpp"
#include "cases/input/table.hpp"
#include "cases/wear/results/frame_scenes.hpp"
#include "cases/wear/results/write.hpp"
#include "core/error.hpp"
#include "core/io/own_file.hpp"

namespace gambeson {
namespace {

[[noreturn]] void refuse(const char* option, const std::string& why) {
  throw InputError({"command line", 0, option}, why);
}

/// The times that a film shows.
struct FilmTimes {
  double fps = 25, from_s = 0;
  int count = 1;
  double at(int k) const { return from_s + k / fps; }
};

/// A run that is shown, with its place in the picture.
struct Take {
  explicit Take(const std::filesystem::path& dir) : run(recordedRun(dir)), scenes(*run.scenario, run.recording) {}

  int nearest(double time_s) const {
    int best = 0;
    for (int k = 1; k < run.recording.frameCount(); ++k)
      if (std::abs(run.recording.time(k) - time_s) < std::abs(run.recording.time(best) - time_s)) best = k;
    return best;
  }
  /// Of the pelvis, where the camera goes along with it.
  Vec3 followed(double time_s) const {
    const Skeleton& skeleton = run.scenario->human->skeleton;
    const auto root = std::find_if(skeleton.links.begin(), skeleton.links.end(),
                                   [](const auto& link) { return link.parent_joint < 0; });
    return run.scenario->bodyPoses(time_s)[static_cast<std::size_t>(root - skeleton.links.begin())].origin;
  }

  RecordedRun run;
  FrameScenes scenes;
  std::vector<int> frames;  ///< of the recording, one for each of the film
  std::array<Vec3, 2> box{Vec3{1e30, 1e30, 1e30}, Vec3{-1e30, -1e30, -1e30}};  ///< of what all of them show
  double least = std::numeric_limits<double>::infinity(), most = -least;  ///< of what the colours show in all of them
  bool below = false, above = false;                                      ///< whether that lies beyond the colours
  std::optional<ColorNote> note;                                          ///< of any of them
  Camera camera;                                                          ///< of the first
  int left = 0, top = 0, width = 0, height = 0;                           ///< in the picture
};

class Filming {
 public:
  explicit Filming(const FilmRequest& request)
      : o_(request), from_(request.picture.view), size_(sizeOf(request.picture, {})) {
    if (o_.azimuth_deg) from_.azimuth_deg = *o_.azimuth_deg;
    if (o_.elevation_deg) from_.elevation_deg = *o_.elevation_deg;
    film_ = isFilmFile(o_.output, format_);
    checkRequest();
    for (const auto& dir : o_.results) takes_.push_back(std::make_unique<Take>(dir));
    for (const auto& take : takes_) {
      if (take->run.recording.frameCount() == 0) throw RunError("the recording has no frames");
      if (o_.follow && !take->run.scenario->human) refuse("--follow", "there is no human whose pelvis it could follow");
    }
    film_ ? findTimes() : findTime();
    place();
    findScale();
  }

  void write() {
    std::optional<Film> film;
    if (film_) film.emplace(format_, size_.width, size_.height, times_.fps);
    Image image;
    for (int k = 0; k < times_.count; ++k) {
      if (k == 0 || differs(k)) image = draw(static_cast<std::size_t>(k));
      if (film) film->add(image);
    }
    if (!film) return writePng(image, o_.output);
    writeOwnFile(o_.output, film->finish());
    sayNote(fmt::format("{}: {} frames, {:.4g} a second, {:.4g} s", o_.output.string(), times_.count, times_.fps,
                        times_.count / times_.fps));
  }

 private:
  void checkRequest() const {
    if (o_.results.size() > 4)
      refuse("RESULTS",
             fmt::format("{} runs beside each other cannot be told apart; allowed: 1 to 4", o_.results.size()));
    if (o_.range && !((*o_.range)[0] < (*o_.range)[1]))
      refuse("--range", fmt::format("{:g} {:g} is no range; allowed: two numbers, the lower first", (*o_.range)[0],
                                    (*o_.range)[1]));
    if (o_.range && o_.picture.field == PictureField::plain) refuse("--range", "a plain picture has no colours");
    if (!film_) {
      const std::pair<bool, const char*> of_films[]{{o_.from_s.has_value(), "--from"},
                                                    {o_.to_s.has_value(), "--to"},
                                                    {o_.fps.has_value(), "--fps"},
                                                    {o_.follow, "--follow"}};
      for (const auto& [given, option] : of_films)
        if (given) refuse(option, "is for films (.mp4, .webm, .gif); a picture has --time");
      return;
    }
    const auto& [width, height] = size_;
    if (format_ != FilmFormat::gif && (width % 2 != 0 || height % 2 != 0))
      refuse("--size", fmt::format("{}x{} is odd; allowed in .mp4 and .webm: even numbers", width, height));
    if (format_ == FilmFormat::gif && o_.fps && *o_.fps > 50)
      refuse("--fps", fmt::format("{:g} is out of range; allowed in .gif: <= 50", *o_.fps));
  }

  /// Of a picture: its time in the first run is that of all.
  void findTime() {
    const Take& first = *takes_[0];
    const RecordingReader& recording = first.run.recording;
    const bool peak = o_.picture.when == PictureTime::peak;
    const int frame = frameOf(recording, peak ? measure(*first.run.scenario, recording) : Measured{}, o_.picture);
    for (const auto& take : takes_) take->frames = {take->nearest(recording.time(frame))};
    if (o_.picture.when != PictureTime::at) return;
    const double apart = std::abs(recording.time(frame) - o_.picture.time_s);
    const int beside = std::clamp(frame == 0 ? 1 : frame - 1, 0, recording.frameCount() - 1);
    if (apart > 0.51 * std::abs(recording.time(frame) - recording.time(beside)) + 1e-9)
      sayNote(fmt::format("{:g} s is not recorded: the frame at {:.4g} s is nearest, of {}", o_.picture.time_s,
                          recording.time(frame), framesText(recording)));
  }

  void findTimes() {
    double first = std::numeric_limits<double>::infinity(), last = -first, start = first, step = first;
    for (const auto& take : takes_) {
      const RecordingReader& r = take->run.recording;
      first = std::min(first, r.time(0)), last = std::max(last, r.time(r.frameCount() - 1));
      const int begin = take->nearest(0), count = r.frameCount();
      start = std::min(start, r.time(begin));
      if (count > 1) {
        const int k = std::min(begin, count - 2);
        step = std::min(step, r.time(k + 1) - r.time(k));
      }
    }
    if (!std::isfinite(step)) refuse("--output", "one frame is recorded, which is no film; allowed: .png");
    const double from = o_.from_s.value_or(start), to = o_.to_s.value_or(last);
    // Time 0 is not always recorded itself: an interval before the first frame still shows it.
    const auto outside = [&](double t) { return t < first - 1.001 * step || t > last + 1e-9; };
    const std::string allowed = "allowed: what is recorded, " + framesText(takes_[0]->run.recording);
    if (outside(from)) refuse("--from", fmt::format("{:g} s is not recorded; {}", from, allowed));
    if (outside(to)) refuse("--to", fmt::format("{:g} s is not recorded; {}", to, allowed));
    if (!(from < to)) refuse("--to", fmt::format("{:g} s does not come after --from, {:g} s; {}", to, from, allowed));
    times_.from_s = from;
    times_.fps = o_.fps.value_or(1 / (step * std::max(1.0, std::ceil(1 / (kUsualFps * step) - 1e-6))));
    times_.count = std::max(1, static_cast<int>(std::lround((to - from) * times_.fps)));
    for (const auto& take : takes_)
      for (int k = 0; k < times_.count; ++k) take->frames.push_back(take->nearest(times_.at(k)));
  }

  /// Up to three in a row, four in two rows.
  void place() {
    const int n = static_cast<int>(takes_.size()), columns = n == 4 ? 2 : n, rows = n == 4 ? 2 : 1;
    for (int i = 0; i < n; ++i) {
      Take& take = *takes_[static_cast<std::size_t>(i)];
      take.left = size_.width * (i % columns) / columns;
      take.top = size_.height * (i / columns) / rows;
      take.width = size_.width * (i % columns + 1) / columns - take.left;
      take.height = size_.height * (i / columns + 1) / rows - take.top;
    }
  }

  Vec3 origin(const Take& take, double time_s) const { return o_.follow ? take.followed(time_s) : Vec3{}; }

  /// What all frames of all runs have in common.
  void findScale() {
    const double unit = fieldWords(o_.picture.field).scale;
    Vec3 size;
    double margin_m = 0;
    for (const auto& take : takes_) {
      const RecordingReader& recording = take->run.recording;
      if (!o_.range) scale_.high = std::max(scale_.high, fieldRange(*take->run.scenario, recording, o_.picture.field));
      int last = -1;
      for (const int k : take->frames) {
        if (k == last) continue;
        last = k;
        PictureScale own = scaleOf(*take->run.scenario, recording, k, o_.picture);
        if (film_) own.high = 0;  // fieldRange has what a film's frames have in common
        scale_.include(own);
        if (film_ && !take->note) take->note = take->scenes.noteOf(k);
        const Frame recorded = recording.frame(k);
        for (const double v : shownOf(*take->run.scenario, recorded, o_.picture.field))
          take->least = std::min(take->least, v), take->most = std::max(take->most, v);
        PlacedBodies placed(*take->run.scenario);
        placed.moveTo(recorded.time_s);
        const std::array<Vec3, 2> shown =
            shownBox(*take->run.scenario, placed, positionsOf(recorded), o_.picture.around);
        const Vec3 o = origin(*take, recording.time(k));
        for (int c = 0; c < 3; ++c) {
          take->box[0][c] = std::min(take->box[0][c], shown[0][c] - o[c]);
          take->box[1][c] = std::max(take->box[1][c], shown[1][c] - o[c]);
        }
        margin_m = std::max(margin_m, pictureMargin(positionsOf(recorded)));
      }
      for (int c = 0; c < 3; ++c) size[c] = std::max(size[c], take->box[1][c] - take->box[0][c] + 2 * margin_m);
    }
    if (o_.range) low_ = (*o_.range)[0], scale_.high = (*o_.range)[1] / unit;
    double least = std::numeric_limits<double>::infinity();
    for (const auto& take : takes_) {
      take->below = take->least < low_;
      take->above = take->most > unit * scale_.high;
      DrawnFrame drawn = frame(*take, 0);
      const Vec3 middle =
          0.5 * (take->box[0] + take->box[1]) + origin(*take, take->run.recording.time(take->frames[0]));
      drawn.scene.focus = {middle - 0.5 * size, middle + 0.5 * size};
      take->camera = fitted(drawn.scene, drawn.shot, take->width, take->height);
      least = std::min(least, take->camera.pixels_per_m);
    }
    for (const auto& take : takes_) take->camera.pixels_per_m = least;
  }

  DrawnFrame frame(Take& take, std::size_t k) {
    PictureCase picture = o_.picture;
    if (film_ || &take != takes_[0].get()) picture.when = PictureTime::at;
    DrawnFrame drawn = take.scenes.at(take.frames[k], picture, from_, scale_, low_);
    if (o_.azimuth_deg || o_.elevation_deg)
      drawn.scene.subtitle = captionOf(picture, take.run.recording.time(take.frames[k]),
                                       take.run.scenario->definition.comfort.sensor_m, from_);
    drawn.shot.zoom = o_.zoom;
    if (!film_) return drawn;
    if (drawn.scene.bar) drawn.scene.bar->title = fieldWords(picture.field).title;
    drawn.shot.below = take.below, drawn.shot.above = take.above;
    drawn.shot.note = take.note;
    return drawn;
  }

  bool differs(int k) const {
    const auto i = static_cast<std::size_t>(k);
    return std::any_of(takes_.begin(), takes_.end(), [&](const auto& t) { return t->frames[i] != t->frames[i - 1]; });
  }

  Image draw(std::size_t k) {
    Image all{size_.width, size_.height, {}};
    all.rgb.resize(3 * static_cast<std::size_t>(all.width) * static_cast<std::size_t>(all.height));
    for (const auto& take : takes_) {
      const DrawnFrame drawn = frame(*take, k);
      Camera camera = take->camera;
      const auto time = [&](std::size_t i) { return take->run.recording.time(take->frames[i]); };
      camera.origin += origin(*take, time(k)) - origin(*take, time(0));
      const Image part = render(drawn.scene, drawn.shot, camera, take->width, take->height);
      for (int y = 0; y < part.height; ++y)
        std::copy_n(part.rgb.begin() + static_cast<std::ptrdiff_t>(3) * y * part.width, 3 * part.width,
                    all.rgb.begin() + 3 * (static_cast<std::ptrdiff_t>(take->top + y) * all.width + take->left));
    }
    return all;
  }

  const FilmRequest& o_;
  Viewpoint from_;
  PictureSize size_;
  bool film_ = false;
  FilmFormat format_ = FilmFormat::mp4;
  FilmTimes times_;
  std::vector<std::unique_ptr<Take>> takes_;
  PictureScale scale_;
  double low_ = 0;
};

/// The largest of the whole motion on the bare body does not move, and stands alone in a named view.
int renderBodyPressure(const FilmRequest& o) {
  const auto only = [](bool given, const char* option) {
    if (given) refuse(option, "does not go with --field body_pressure: one picture (.png) of one run in a named view");
  };
  FilmFormat format{};
  only(isFilmFile(o.output, format), "--output");
  only(o.results.size() > 1, "RESULTS");
  only(o.azimuth_deg.has_value(), "--azimuth");
  only(o.elevation_deg.has_value(), "--elevation");
  only(o.zoom != 1, "--zoom");
  only(o.range.has_value(), "--range");
  only(o.from_s || o.to_s || o.fps || o.follow, "--from");
  const auto [recording, scenario, facts] = recordedRun(o.results[0]);
  const bool peak = o.picture.when == PictureTime::peak;
  PictureScale scale;
  scale.high = fieldRange(*scenario, recording, o.picture.field);
  const int frame = frameOf(recording, peak ? measure(*scenario, recording) : Measured{}, o.picture);
  renderFrame(*scenario, recording, frame, o.picture, scale, o.output);
  return 0;
}

}  // namespace

std::string framesText(const RecordingReader& recording) {
  const int count = recording.frameCount();
  if (count == 0) return "no frame";
  if (count == 1) return fmt::format("1 frame at {:.4g} s", recording.time(0));
  return fmt::format("{} frames from {:.4g} to {:.4g} s", count, recording.time(0), recording.time(count - 1));
}

namespace schema {

Object filmTable() {
  using R = FilmRequest;
  return Table<R>("Film")
      .number("from", &R::from_s, "s", between(-3600, 3600), "where the film begins")
      .number("to", &R::to_s, "s", between(-3600, 3600), "where it ends")
      .number("fps", &R::fps, "", between(1, 120), "frames a second")
      .number("azimuth", &R::azimuth_deg, "deg", between(-360, 360), "from the front to the left")
      .number("elevation", &R::elevation_deg, "deg", between(-90, 90), "above the horizon")
      .number("zoom", &R::zoom, "", between(0.1, 20), "how much larger")
      .build();
}

}  // namespace schema

int renderFilm(const FilmRequest& request) {
  if (request.picture.field == PictureField::body_pressure) return renderBodyPressure(request);
  Filming(request).write();
  return 0;
}

}  // namespace gambeson
