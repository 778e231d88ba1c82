#include "gpu/check_near.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "gpu/near/skin_bender.hpp"
#include "gpu/scenes/dressed.hpp"
#include "gpu/scenes/skins.hpp"
#include "tools/armour_scene.hpp"
#include "tools/near_by_core.hpp"

namespace gambeson::gpu {
namespace {

void printFacts(const NearFacts& facts, const NearContacts& contacts) {
  int of_kind[5] = {};
  for (const ContactFacts& f : contacts.facts) ++of_kind[f.kind];
  fmt::print("  contacts: {} of samples on bodies, {} on cloth, {} of edges on edges, {} on sharp parts; {:016x}\n",
             of_kind[0], of_kind[1], of_kind[2], of_kind[4], facts.contacts_hash);
  fmt::print("  lists: {}\n", fmt::join(facts.sizes, ", "));
}

int checkScene(const DressedScene& scene, const NearCheck& settings, NearFacts& facts) {
  fmt::print("{}: {} samples, {} triangles of cloth, {} of bodies\n", scene.name, scene.x0.size(),
             scene.collisions.cloth_triangles,
             scene.collisions.mesh.triangles.size() - static_cast<std::size_t>(scene.collisions.cloth_triangles));
  const NearSizes room = roomForNear(scene.collisions);
  const auto make = [&](bool on_cuda, int groups_per_block) {
    auto search = on_cuda ? nearOnCuda(scene.model(), scene.step(), room, groups_per_block)
                          : nearOnReference(scene.model(), scene.step(), room);
    search->find(true);
    return search;
  };
  const auto first = make(settings.cuda, 4);
  facts = factsOf(*first);
  printFacts(facts, first->contacts());
  int different = 0;
  const auto expect = [&](const std::string& what, bool same) {
    fmt::print("  the same {}: {}\n", what, same ? "yes" : "NO");
    different += !same;
  };
  expect("as core", differencesToCore(first->contacts(), nearByCore(scene)) == 0);
  if (first->repeats() > 0) fmt::print("  passes repeated for want of room: {}\n", first->repeats());
  if (!settings.cuda) return different;
  expect("on the reference", factsOf(*make(false, 0)) == facts);
  expect("with one group a block", factsOf(*make(true, 1)) == facts);
  // The next step: samples are known to be outside.
  first->setStep(scene.step());
  first->find(false);
  expect("in a later step", hashOf(first->contacts()) == facts.contacts_hash);
  fmt::print("  median of {}: {:.4f} ms with trees rebuilt, {:.4f} ms refitted\n", settings.passes,
             first->medianMilliseconds(true, settings.passes), first->medianMilliseconds(false, settings.passes));
  first->find(false);
  expect("after the timing", hashOf(first->contacts()) == facts.contacts_hash);
  if (settings.stages)
    for (const auto& [name, ms] : first->stageTimes(settings.passes)) fmt::print("    {:<24} {:.4f} ms\n", name, ms);
  return different;
}

/// As many vertices as the armour's skin has, over an output window of steps.
int checkSkin(const NearCheck& settings) {
  constexpr int kTimes = 45;
  const Skin skin = tubeSkin(80, 176);
  const std::vector<Pose> poses = tubePoses(skin, kTimes);
  const auto bender = settings.cuda ? skinOnCuda(skin, kTimes) : skinOnReference(skin, kTimes);
  bender->bend(poses, kTimes);
  int different = 0;
  for (int k = 0; k < kTimes; ++k) {
    std::vector<Vec3> truth(skin.rest.vertices.size());
    const std::size_t links = skin.bind.size();
    skinPositions(skin, std::span(poses).subspan(static_cast<std::size_t>(k) * links, links), truth);
    different += bender->positions(k) != truth;
  }
  fmt::print("skin of {} vertices at {} times: {} times differ from core\n", skin.rest.vertices.size(), kTimes,
             different);
  if (settings.cuda)
    fmt::print("  median of {}: {:.4f} ms for all\n", settings.passes, bender->medianMilliseconds(settings.passes));
  return different;
}

}  // namespace

int checkNear(const NearCheck& settings, std::string& manifest) {
  int different = checkSkin(settings);
  for (const auto& scene : dressedScenes()) {
    NearFacts facts;
    different += checkScene(*scene, settings, facts);
    manifest +=
        fmt::format("{}    {{\"name\": \"{}\", \"lists\": [{}], \"contacts_hash\": \"{:016x}\"}}",
                    manifest.empty() ? "" : ",\n", scene->name, fmt::join(facts.sizes, ", "), facts.contacts_hash);
  }
  if (!std::filesystem::exists(settings.armour)) {
    fmt::print("no recorded armour{}\n", settings.armour.empty() ? "" : " in " + settings.armour);
    return different;
  }
  // The fine walk: 20,636 samples, contacts within 3.4 mm.
  NearFacts facts;
  return different + checkScene(*armourScene(settings.armour, 20636, 40054, 3.4e-3 / 1.1), settings, facts);
}

}  // namespace gambeson::gpu
