/// What is near on the reference device: against core bit for bit, for any width of a group, with too little room.
#include "gpu/near/near_search.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>

#include "gpu/device/reference.hpp"
#include "gpu/near/near_finder.hpp"
#include "gpu/scenes/dressed.hpp"
#include "tools/near_by_core.hpp"

namespace gambeson::gpu {
namespace {

std::unique_ptr<NearSearch> found(const DressedScene& scene, const NearSizes& room) {
  auto search = nearOnReference(scene.model(), scene.step(), room);
  search->find(true);
  return search;
}
std::unique_ptr<NearSearch> found(const DressedScene& scene) { return found(scene, roomForNear(scene.collisions)); }

/// For messages.
std::string text(const ContactFacts& f) {
  char line[256];
  std::snprintf(line, sizeof line, "kind %d sample %d obstacle %d feature %d pair %d gap %.17g clearance %.17g", f.kind,
                f.sample, f.obstacle, f.feature, f.pair, f.gap_m, f.clearance_m);
  return line;
}
void expectSame(const NearContacts& got, const NearContacts& truth, const std::string& name) {
  const auto missing = [&](const NearContacts& a, const NearContacts& b, const char* what) {
    int shown = 0;
    for (const ContactFacts& f : a.facts)
      if (std::none_of(b.facts.begin(), b.facts.end(),
                       [&](const ContactFacts& g) { return !comesBefore(f, g) && !comesBefore(g, f); }) &&
          shown++ < 5)
        ADD_FAILURE() << name << ": " << what << " " << text(f);
  };
  missing(got, truth, "not in core:");
  missing(truth, got, "only in core:");
  ASSERT_EQ(got.facts.size(), truth.facts.size()) << name;
  for (std::size_t i = 0; i < got.facts.size(); ++i) {
    ASSERT_TRUE(sameAsCore(got, truth, i)) << name << "\n" << text(got.facts[i]) << "\n" << text(truth.facts[i]);
  }
}

TEST(NearSearch, FindsWhatCoreFindsToTheLastBit) {
  int of_kind[5] = {}, deep = 0;
  for (const auto& scene : dressedScenes()) {
    const NearContacts got = found(*scene)->contacts();
    expectSame(got, nearByCore(*scene), scene->name);
    int here[5] = {};
    for (const ContactFacts& f : got.facts) ++of_kind[f.kind], ++here[f.kind], deep += f.gap_m < -4e-3;
    std::printf("[ measured ] %s: %d samples on bodies, %d on cloth, %d edges on edges, %d on sharp parts\n",
                scene->name.c_str(), here[0], here[1], here[2], here[4]);
  }
  EXPECT_GT(of_kind[kSampleOnBody], 500);
  EXPECT_GT(of_kind[kSampleOnCloth], 500);
  EXPECT_GT(of_kind[kEdgeOnEdge], 20);
  EXPECT_GT(of_kind[kEdgeOnBody], 50);
  EXPECT_GT(deep, 50);  // beyond the reach of what is near
}

template <int W>
NearFacts factsWith(const DressedScene& scene) {
  NearFinder<ReferenceOf<W>> finder(scene.model(), scene.step(), roomForNear(scene.collisions));
  finder.find(true);
  return factsOf(finder);
}

TEST(NearSearch, LeavesOutWhatIsNearAtRest) {
  const auto fine = foldedSheet(30, 1.3e-3);
  const auto search = found(*fine);
  const NearSizes sizes = search->sizes();
  EXPECT_LT(3 * sizes[kOpenPoints], 2 * sizes[kClothPoints]);
  EXPECT_LT(3 * sizes[kOpenEdges], 2 * sizes[kClothEdges]);
  EXPECT_GT(search->contacts().facts.size(), 500u);
}

TEST(NearSearch, AnyWidthOfAGroupGivesTheSameBits) {
  for (const auto& scene : dressedScenes()) {
    const NearFacts facts = factsWith<1>(*scene);
    EXPECT_EQ(factsWith<5>(*scene), facts) << scene->name;
    EXPECT_EQ(factsWith<32>(*scene), facts) << scene->name;
  }
}

TEST(NearSearch, TooLittleRoomIsRepeatedWithMore) {
  for (const auto& scene : {twoLayers(14), sheetOnSkin(14)}) {
    NearSizes ample = roomForNear(scene->collisions);
    for (auto& room : ample) room *= 8;
    const auto truth = found(*scene, ample);
    EXPECT_EQ(truth->repeats(), 0);
    const NearFacts facts = factsOf(*truth);
    for (int k = 0; k < kNearLists; ++k) {
      if (facts.sizes[k] < 4) continue;
      NearSizes room = ample;
      room[k] = 3;
      const auto search = found(*scene, room);
      EXPECT_GE(search->repeats(), 1) << scene->name << ", list " << k;
      EXPECT_EQ(factsOf(*search), facts) << scene->name << ", list " << k;
    }
    NearSizes none;
    none.fill(1);
    EXPECT_EQ(factsOf(*found(*scene, none)), facts) << scene->name;
  }
}

/// What is known of samples from the last step, and trees made elsewhere, change nothing.
TEST(NearSearch, LaterStepsFindTheSame) {
  for (const auto& scene : dressedScenes()) {
    const NearStep step = scene->step();
    const auto search = found(*scene);
    const NearFacts facts = factsOf(*search);
    search->find(false);
    EXPECT_EQ(factsOf(*search), facts) << scene->name << ", refitted";
    search->setStep(step);
    search->find(false);
    EXPECT_EQ(factsOf(*search).contacts_hash, facts.contacts_hash) << scene->name << ", once more";
    // Elsewhere, then back.
    std::vector<Vec3> away = scene->x0;
    for (Vec3& x : away) x += Vec3{0, 0, 0.5};
    NearStep far = step;
    far.x0 = far.x1 = away;
    search->setStep(far);
    search->forget();
    search->find(true);
    search->setStep(step);
    search->forget();
    search->find(false);
    EXPECT_EQ(factsOf(*search).contacts_hash, facts.contacts_hash) << scene->name << ", back from elsewhere";
  }
}

/// Contacts leave what they have borne, and those of the next step start from it, as core's do.
TEST(NearSearch, WarmStartsAreThoseOfCore) {
  int partners = 0;
  for (const auto& scene : {twoLayers(24), facingPeaks(16), sheetOnSkin(24), sheetOnSolids(24, true)}) {
    CoreStep first(*scene, {});
    const auto search = found(*scene);
    const std::size_t n = first.w.rows.size();
    ASSERT_EQ(search->contacts().facts.size(), n);
    // Some bear nothing, some pull.
    std::vector<Vec3> tractions(n);
    for (std::size_t k = 0; k < n; ++k)
      if (k % 4 != 0)
        tractions[k] = (k % 7 == 1 ? -1e-3 : 1e-3 * static_cast<double>(1 + k % 5)) * first.w.rows[k].contact.normal +
                       Vec3{1e-5 * static_cast<double>(k % 3), 0, 0};
    State after;
    const std::vector<WarmStart> borne = first.bear(tractions, after);
    after.last_step_s = scene->dt_s / 1.5;
    search->keepWarm(borne, scene->dt_s / after.last_step_s);
    const std::vector<WarmEntry> left = search->warmEntries();
    ASSERT_EQ(left.size(), after.warm.size()) << scene->name;
    for (std::size_t k = 0; k < left.size(); ++k) {
      const WarmContact& truth = after.warm[k];
      EXPECT_EQ(left[k].key, (ContactKey{static_cast<int>(truth.kind), truth.sample, truth.obstacle, truth.feature}))
          << k;
      EXPECT_EQ(left[k].start.traction, truth.traction) << k;
      EXPECT_EQ(left[k].start.mean_Pa, truth.mean_Pa) << k;
      partners += truth.kind == ContactKind::sample_on_cloth && truth.feature == -1;
    }
    // The cloth goes on, farther than in a step: feet come to other features.
    for (std::size_t s = 0; s < scene->x0.size(); ++s)
      scene->x0[s] = scene->x1[s] += Vec3{2e-3 * static_cast<double>(s % 2), 1e-3, 0};
    const CoreStep second(*scene, after);
    search->setStep(scene->step());
    search->find(false);
    const std::vector<WarmStart> starts = search->warmStarts();
    ASSERT_EQ(starts.size(), second.w.rows.size()) << scene->name;
    int known = 0, around = 0;
    for (std::size_t k = 0; k < starts.size(); ++k) {
      EXPECT_EQ(starts[k].traction, second.w.warm[k]) << scene->name << " " << k;
      EXPECT_EQ(starts[k].mean_Pa, second.w.rows[k].mean_Pa) << scene->name << " " << k;
      known += starts[k].slip_m_per_s == 0;
      around += starts[k].slip_m_per_s < 0 && starts[k].traction != Vec3{};
    }
    std::printf(
        "[ measured ] %s: %zu left, %d of partners so far; of %zu next ones %d known, %d start from the mean around\n",
        scene->name.c_str(), left.size(), partners, starts.size(), known, around);
    EXPECT_GT(known, 10) << scene->name;
  }
  EXPECT_GT(partners, 40);
}

/// Counts and hashes that another build found; `gambeson_gpu_check --write-manifest` writes them, and on what device.
TEST(NearSearch, FindsWhatTheManifestSays) {
  std::ifstream file(std::string(GAMBESON_SOURCE_DIR) + "/gpu/manifest.json");
  const auto manifest = nlohmann::json::parse(file);
  const auto scenes = dressedScenes();
  const auto& all = manifest.at("near");
  ASSERT_EQ(all.size(), scenes.size());
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const auto& kept = all[i];
    EXPECT_EQ(kept.at("name"), scenes[i]->name);
    const NearFacts facts{kept.at("lists").get<NearSizes>(),
                          std::stoull(kept.at("contacts_hash").get<std::string>(), nullptr, 16)};
    EXPECT_EQ(factsOf(*found(*scenes[i])), facts) << scenes[i]->name;
  }
}

}  // namespace
}  // namespace gambeson::gpu
