/// Detail of compare.hpp: pictures of the variants side by side.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cases/study/compare.hpp"
#include "cases/study/files.hpp"
#include "cases/wear/results/results.hpp"
#include "cases/wear/results/write.hpp"
#include "core/error.hpp"
#include "core/io/own_file.hpp"

namespace gambeson::study {
namespace {

/// The time that a wish means in a group: the peak is that of its baseline, or of its first good run.
double timeOf(const VariantGroup& g, const Comparison& c, const PictureCase& wish) {
  if (wish.when == PictureTime::at) return wish.time_s;
  const RunNumbers* run = g.baseline >= 0 ? &c.runs[static_cast<std::size_t>(g.baseline)] : nullptr;
  for (std::size_t k = 0; k < g.members.size() && (!run || !run->good); ++k) run = &c.runs[g.members[k]];
  if (!run || !run->good) return 0;
  const JointNumbers* top = run->highest();
  return wish.when == PictureTime::end || !top ? run->recorded_to_s : top->peak_time_s;
}

}  // namespace

std::vector<SidePicture> takeSidePictures(const Study& s, const Comparison& c, const std::filesystem::path& out,
                                          std::vector<std::string>& failures) {
  std::vector<SidePicture> pictures;
  if (s.pictures.empty()) return pictures;
  const std::filesystem::path folder = out / files::pictures;
  std::filesystem::create_directories(folder);
  for (const std::filesystem::path& earlier : ownFiles(folder)) removeOwnFile(earlier);
  // One scale for all groups, so that motions can be compared as well.
  std::vector<PictureScale> scales(s.pictures.size());
  for (const bool draw : {false, true})
    for (const VariantGroup& g : c.groups)
      for (const std::size_t i : g.members) {
        if (!c.runs[i].good || !std::holds_alternative<Case>(s.variants[i].definition)) continue;
        const Variant& v = s.variants[i];
        try {
          const auto [recording, scenario, facts] = recordedRun(out / v.folder);
          for (std::size_t w = 0; w < s.pictures.size(); ++w) {
            PictureCase wish = s.pictures[w];
            wish.time_s = timeOf(g, c, wish);
            wish.when = PictureTime::at;
            const int frame = frameOf(recording, {}, wish);
            if (!draw) {
              scales[w].include(scaleOf(*scenario, recording, frame, wish.field));
              scales[w].high = std::max(scales[w].high, fieldRange(*scenario, recording, wish.field));
              continue;
            }
            const std::filesystem::path png = folder / files::pictureName(v.folder, w);
            renderFrame(*scenario, recording, frame, wish, scales[w], png);
            pictures.push_back(
                {i, w, png,
                 v.label + ". " +
                     captionOf(wish, recording.time(frame), std::get<Case>(v.definition).comfort.sensor_m)});
          }
        } catch (const std::runtime_error& e) {
          if (draw) failures.push_back(fmt::format("A picture of {} could not be drawn: {}", v.label, e.what()));
        }
      }
  return pictures;
}

}  // namespace gambeson::study
