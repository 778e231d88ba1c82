#include "cases/study/maker.hpp"

#include <fmt/format.h>

#include "cases/input/table.hpp"
#include "cases/study/axes.hpp"
#include "cases/study/files.hpp"
#include "cases/study/make_variant.hpp"
#include "core/error.hpp"

namespace gambeson::study {

using schema::Entry;

void tooMany(const Entry& at) { at.fail("more than 2,000 variants; allowed: at most 2,000 together"); }

Maker::Maker(const schema::Entry& entry, const StudyInput& in, Study& study) : entry_(entry), in_(in), study_(study) {
  base_ = readJson(in.file);
  if (in.set.type != JsonNode::Type::null) common_ = settingsOf(entry.member(*entry.node.find("set")));
}

void Maker::add(std::vector<int> levels, const std::vector<Setting>& more, const std::string& extra_label,
                const schema::Entry& at) {
  Variant v;
  v.levels = std::move(levels);
  v.grid = more.empty();
  JsonNode root = base_;
  std::vector<Setting> all = common_;
  for (std::size_t a = 0; a < study_.axes.size(); ++a) {
    const Axis& axis = study_.axes[a];
    const Level& level = axis.levels[static_cast<std::size_t>(v.levels[a])];
    all.insert(all.end(), level.set.begin(), level.set.end());
    v.folder += (v.folder.empty() ? "" : "__") + level.folder;
    v.label += (v.label.empty() ? "" : ", ") + level.name;
  }
  all.insert(all.end(), more.begin(), more.end());
  if (!extra_label.empty()) {
    v.folder += (v.folder.empty() ? "" : "__") + folderName(extra_label);
    v.label += (v.label.empty() ? "" : ", ") + extra_label;
  }
  if (const std::string why = files::unfitFolder(v.folder); !why.empty()) at.fail(fmt::format("a variant {}", why));
  if (!folders_.insert(v.folder).second)
    at.fail(fmt::format("there are two variants {}; allowed: labels that differ", v.label));
  if (study_.variants.size() >= most_variants) tooMany(at);
  defineVariant(study_, root, in_.file, all, v);
  study_.variants.push_back(std::move(v));
  root_ = std::move(root);
}

}  // namespace gambeson::study
