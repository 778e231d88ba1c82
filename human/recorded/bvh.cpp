#include "human/recorded/bvh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <set>

#include "core/error.hpp"
#include "human/files/text_lines.hpp"
#include "human/files/units.hpp"

namespace gambeson {
namespace {

constexpr std::size_t most_joints = 10000;
constexpr int deepest = 200;

std::string lower(std::string_view text) {
  std::string s(text);
  std::transform(s.begin(), s.end(), s.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return s;
}

/// Reads one word after another; words of the format may stand in any case; lines matter only for messages and in
/// MOTION.
struct Words {
  TextLines& lines;
  std::vector<std::string_view> words;
  std::size_t at = 0;

  std::string_view next(const char* expected) {
    while (at >= words.size()) {
      if (!lines.nextFull()) lines.fail(fmt::format("the file ends where {} should stand", expected));
      words = lines.words(), at = 0;
    }
    return words[at++];
  }
  void expect(std::string_view word) {
    const std::string_view got = next(std::string(word).c_str());
    if (lower(got) != lower(word)) lines.fail(fmt::format("'{}' stands where '{}' should", got.substr(0, 40), word));
  }
  double number(const char* what) { return lines.number(next(what), at, what); }
};

class HierarchyReader {
 public:
  HierarchyReader(Words& words, BvhClip& clip) : w_(words), clip_(clip) {}
  int channels() const { return channels_; }

  void joint(int parent, const std::string& name, bool end_site, int depth) {
    if (depth > deepest) w_.lines.fail(fmt::format("joints stand more than {} deep", deepest));
    if (clip_.joints.size() >= most_joints) w_.lines.fail(fmt::format("has more than {} joints", most_joints));
    if (!end_site && !names_.insert(name).second) w_.lines.fail("stands twice", name);
    const int me = static_cast<int>(clip_.joints.size());
    clip_.joints.push_back({end_site ? "" : name, parent, {}, {}, channels_});
    w_.expect("{");
    w_.expect("OFFSET");
    for (int k = 0; k < 3; ++k) clip_.joints[me].offset[k] = w_.number("OFFSET");
    for (;;) {
      const std::string_view written = w_.next("}");
      const std::string word = lower(written);
      if (word == "}") return;
      if (end_site) w_.lines.fail(fmt::format("'{}' stands in an end site", written.substr(0, 40)));
      if (word == "channels") {
        readChannels(clip_.joints[me], name);
      } else if (word == "joint") {
        joint(me, std::string(w_.next("a name")), false, depth + 1);
      } else if (word == "end") {
        w_.expect("Site");
        joint(me, "", true, depth + 1);
      } else {
        w_.lines.fail(fmt::format("'{}' is not known here: CHANNELS, JOINT, End Site or }}", written.substr(0, 40)));
      }
    }
  }

 private:
  void readChannels(BvhJoint& j, const std::string& name) {
    if (!j.channels.empty()) w_.lines.fail("has CHANNELS twice", name);
    const double n = w_.number("CHANNELS");
    if (!(n >= 1 && n <= 6) || n != std::floor(n))
      w_.lines.fail(fmt::format("{} channels are not allowed: 1 to 6", n), name);
    const std::array<std::string_view, 6> known{"xposition", "yposition", "zposition",
                                                "xrotation", "yrotation", "zrotation"};
    for (int k = 0; k < static_cast<int>(n); ++k) {
      const std::string_view word = w_.next("a channel");
      const auto found = std::find(known.begin(), known.end(), lower(word));
      if (found == known.end()) w_.lines.fail(fmt::format("'{}' is no channel", word.substr(0, 40)), name);
      const int c = static_cast<int>(found - known.begin());
      if (std::find(j.channels.begin(), j.channels.end(), c) != j.channels.end())
        w_.lines.fail(fmt::format("{} stands twice", word), name);
      j.channels.push_back(c);
    }
    channels_ += static_cast<int>(n);
  }

  Words& w_;
  BvhClip& clip_;
  std::set<std::string> names_;
  int channels_ = 0;
};

}  // namespace

int BvhClip::joint(const std::string& name) const {
  for (int i = 0; i < static_cast<int>(joints.size()); ++i)
    if (!name.empty() && joints[i].name == name) return i;
  return -1;
}

int BvhClip::endSite(int joint) const {
  for (int i = 0; i < static_cast<int>(joints.size()); ++i)
    if (joints[i].parent == joint && joints[i].name.empty()) return i;
  return -1;
}

BvhClip readBvh(const std::filesystem::path& file) {
  TextLines lines(file);
  BvhClip clip;
  clip.file = file.string();
  Words w{lines, {}};
  if (lower(w.next("HIERARCHY")) != "hierarchy") lines.fail("is no BVH file: it does not start with HIERARCHY");
  w.expect("ROOT");
  HierarchyReader hierarchy(w, clip);
  hierarchy.joint(-1, std::string(w.next("a name")), false, 0);
  w.expect("MOTION");
  w.expect("Frames:");
  const double frames = w.number("Frames:");
  if (!(frames >= 1 && frames <= static_cast<double>(most_rows)))
    lines.fail(fmt::format("{} is not allowed: 1 to {}", frames, most_rows), "Frames:");
  w.expect("Frame");
  w.expect("Time:");
  clip.frame_time_s = w.number("Frame Time:");
  if (!(clip.frame_time_s > 0 && clip.frame_time_s <= 10))
    lines.fail(fmt::format("{} is not allowed: > 0, <= 10 s", clip.frame_time_s), "Frame Time:");
  if (hierarchy.channels() == 0) lines.fail("no joint has a channel");
  while (lines.nextFull()) {
    const auto cells = lines.words();
    if (static_cast<int>(cells.size()) != hierarchy.channels())
      lines.fail(fmt::format("has {} values; there are {} channels", cells.size(), hierarchy.channels()));
    if (clip.frames.size() >= most_rows)
      lines.fail(fmt::format("is one frame too many: at most {} are read", most_rows));
    auto& row = clip.frames.emplace_back();
    row.reserve(cells.size());
    for (std::size_t k = 0; k < cells.size(); ++k) row.push_back(lines.number(cells[k], k + 1, "channel"));
  }
  if (clip.frames.empty()) lines.fail("holds no frame");
  if (frames != static_cast<double>(clip.frames.size()))
    clip.notes.push_back(fmt::format("the header names {} frames, the file holds {}", frames, clip.frames.size()));
  return clip;
}

std::vector<Pose> bvhPoses(const BvhClip& clip, const std::vector<double>& frame, bool position_adds) {
  std::vector<Pose> X(clip.joints.size());
  for (std::size_t i = 0; i < clip.joints.size(); ++i) {
    const BvhJoint& j = clip.joints[i];
    Pose local{{}, j.offset};
    for (std::size_t k = 0; k < j.channels.size(); ++k) {
      const int c = j.channels[k];
      const double value = frame[j.first_channel + k];
      if (c < 3) {
        local.origin[c] = value + (position_adds ? j.offset[c] : 0);
      } else {
        Vec3 axis;
        axis[c - 3] = 1;
        local.rotation = local.rotation * rotationAbout(axis, value * rad_per_deg);
      }
    }
    X[i] = j.parent < 0 ? local : X[j.parent] * local;
  }
  return X;
}

}  // namespace gambeson
