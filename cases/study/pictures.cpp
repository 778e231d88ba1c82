/// Detail of compare.hpp: pictures of the variants side by side.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <mutex>

#include "cases/study/compare.hpp"
#include "cases/study/files.hpp"
#include "cases/wear/results/results.hpp"
#include "cases/wear/results/write.hpp"
#include "core/error.hpp"
#include "core/io/own_file.hpp"
#include "core/math/parallel.hpp"

namespace gambeson::study {
namespace {

/// The time that a wish means in a group: the peak is that of its baseline, or of its first good run; of a population
/// each run's own.
double timeOf(const VariantGroup& g, std::size_t own, const Comparison& c, const PictureCase& wish) {
  if (wish.when == PictureTime::at) return wish.time_s;
  const RunNumbers* run = c.population      ? &c.runs[own]
                          : g.baseline >= 0 ? &c.runs[static_cast<std::size_t>(g.baseline)]
                                            : nullptr;
  for (std::size_t k = 0; k < g.members.size() && (!run || !run->good); ++k) run = &c.runs[g.members[k]];
  if (!run || !run->good) return 0;
  const JointNumbers* top = run->highest();
  return wish.when == PictureTime::end || !top ? run->recorded_to_s : top->peak_time_s;
}

/// "; there thickness x 1 pays most", of pictures at the peak of another run's torque; else empty.
std::string whoseOf(const Study& s, const VariantGroup& g, std::size_t own, const Comparison& c,
                    const PictureCase& wish) {
  if (wish.when != PictureTime::peak || c.population || g.baseline < 0) return "";
  const auto base = static_cast<std::size_t>(g.baseline);
  return base == own || !c.runs[base].good ? "" : "; at that moment " + memberName(s, c, base) + " pays most";
}

/// A run that is drawn, and the group in which it stands.
struct Drawn {
  const VariantGroup& group;
  std::size_t run;
};

/// Of a population those whom it burdens most alone.
bool isShown(const Comparison& c, std::size_t run) {
  if (!c.population) return true;
  return std::any_of(c.population->worst.begin(), c.population->worst.end(),
                     [&](std::size_t w) { return c.population->wearers[w].taken()->variant == run; });
}

std::vector<Drawn> drawnOf(const Study& s, const Comparison& c) {
  std::vector<Drawn> drawn;
  for (const VariantGroup& g : c.groups)
    for (const std::size_t i : g.members)
      if (c.runs[i].good && isShown(c, i) && std::holds_alternative<Case>(s.variants[i].definition))
        drawn.push_back({g, i});
  return drawn;
}

/// f(k) for k < n, side by side where recordings may be read so; why each did not go well.
template <class F>
std::vector<std::string> forAllRuns(std::size_t n, F&& f) {
  std::vector<std::string> why(n);
  const auto nothing = [](int) { return 0; };
  forAllInTeam(recordsSideBySide() ? omp_get_max_threads() : 1, static_cast<int>(n), nothing, [&](int, int, int at) {
    const auto k = static_cast<std::size_t>(at);
    try {
      f(k);
    } catch (const std::exception& e) {
      why[k] = e.what();
    }
  });
  return why;
}

}  // namespace

std::vector<SidePicture> takeSidePictures(const Study& s, const Comparison& c, const std::filesystem::path& out,
                                          std::vector<std::string>& failures) {
  std::vector<SidePicture> pictures;
  if (s.pictures.empty()) return pictures;
  const std::filesystem::path folder = out / files::pictures;
  std::filesystem::create_directories(folder);
  for (const std::filesystem::path& earlier : ownFiles(folder)) removeOwnFile(earlier);
  const std::vector<Drawn> drawn = drawnOf(s, c);
  const auto wishOf = [&](const Drawn& d, std::size_t w) {
    PictureCase wish = s.pictures[w];
    wish.time_s = timeOf(d.group, d.run, c, wish);
    wish.when = PictureTime::at;
    return wish;
  };
  // One scale for all groups, so that motions can be compared as well.
  std::vector<PictureScale> scales(s.pictures.size());
  std::vector<std::vector<PictureScale>> own(drawn.size(), scales);
  forAllRuns(drawn.size(), [&](std::size_t k) {
    const auto [recording, scenario, facts] = recordedRun(out / s.variants[drawn[k].run].folder);
    for (std::size_t w = 0; w < s.pictures.size(); ++w) {
      const PictureCase wish = wishOf(drawn[k], w);
      PictureScale& scale = own[k][w];
      scale = scaleOf(*scenario, recording, frameOf(recording, {}, wish), wish);
      scale.high = std::max(scale.high, fieldRange(*scenario, recording, wish.field));
    }
  });
  for (const std::vector<PictureScale>& of_run : own)
    for (std::size_t w = 0; w < scales.size(); ++w) scales[w].include(of_run[w]);
  std::vector<std::vector<SidePicture>> taken(drawn.size());
  std::mutex pencil;  // pictures are drawn by one thread of a process at a time
  const std::vector<std::string> why = forAllRuns(drawn.size(), [&](std::size_t k) {
    const Variant& v = s.variants[drawn[k].run];
    const auto [recording, scenario, facts] = recordedRun(out / v.folder);
    for (std::size_t w = 0; w < s.pictures.size(); ++w) {
      const PictureCase wish = wishOf(drawn[k], w);
      const int frame = frameOf(recording, {}, wish);
      const std::filesystem::path png = folder / files::pictureName(v.folder, w);
      {
        const std::lock_guard alone(pencil);
        renderFrame(*scenario, recording, frame, wish, scales[w], png);
      }
      taken[k].push_back({drawn[k].run, w, png,
                          v.label + ". " +
                              captionOf(wish, recording.time(frame), std::get<Case>(v.definition).comfort.sensor_m) +
                              whoseOf(s, drawn[k].group, drawn[k].run, c, s.pictures[w])});
    }
  });
  for (std::size_t k = 0; k < drawn.size(); ++k) {
    pictures.insert(pictures.end(), taken[k].begin(), taken[k].end());
    if (!why[k].empty())
      failures.push_back(fmt::format("A picture of {} could not be drawn: {}", s.variants[drawn[k].run].label, why[k]));
  }
  return pictures;
}

}  // namespace gambeson::study
