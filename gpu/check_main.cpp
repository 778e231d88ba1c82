/// Compares CUDA with the reference and with core, and times it.
///
///   gambeson_gpu_check [--only PART] [--broad NAME ...] [--data FOLDER] [--armour FILE] [--solves FOLDER]
///                      [--passes N] [--queries N] [--stages] [--write-manifest FILE]
///
/// Forces of shells (check_forces.hpp); contact solves, recorded (where --solves has them) and made up
/// (check_solves.hpp); what is near in dressed bodies (check_near.hpp); impacts of steps with their rows
/// (check_step_impacts.hpp); impacts: public frames of cloth on a ball and in a funnel (where FOLDER, shared/data by
/// name, has them), 460 balls that fly through each other, ten wavy sheets, and queries by themselves, random and
/// degenerate; with --broad instead of these: broad phases on the same scenes, on triangles of all sizes and on long
/// ways. Of each: what it gives on both devices and, where core has it, in core, to the bit (forces: to 1e-13 of the
/// largest); medians of a pass. Without CUDA, or --reference: the reference alone. Exit: 0; 1 where two differ; 2 bad
/// input.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <fstream>

#include "core/error.hpp"
#include "core/math/parallel.hpp"
#include "gpu/check_broad.hpp"
#include "gpu/check_forces.hpp"
#include "gpu/check_near.hpp"
#include "gpu/check_solves.hpp"
#include "gpu/check_step_impacts.hpp"
#include "gpu/scenes/solve_facts.hpp"
#include "gpu/scenes/stage_facts.hpp"
#include "tools/frames_scene.hpp"
#include "tools/impact_questions.hpp"

namespace gambeson::gpu {
namespace {

namespace fs = std::filesystem;

struct Settings {
  std::string data = "../shared/data", solves = "../shared/trials/gpu", armour, manifest, only;
  std::vector<std::string> broad;
  int passes = 15, queries = 1000000;
  bool stages = false, reference_alone = false, large = true, fast = false;

  bool asks(std::string_view part) const { return broad.empty() && (only.empty() || only == part); }
};

std::vector<Scene> scenes(const Settings& settings) {
  const fs::path folder = fs::path(settings.data) / "real" / "collision";
  std::vector<Scene> all;
  for (const FramesFiles& files : kPublicFrames) {
    if (fs::exists(folder / files.folder / files.start))
      all.push_back(framesScene(folder, files));
    else
      fmt::print("no {} in {}\n", files.name, folder.string());
  }
  if (settings.broad.empty())
    for (Scene& scene : manifestScenes()) all.push_back(std::move(scene));
  if (settings.large) {
    all.push_back(flyingBalls(460));
    all.push_back(wavySheets(10, 316));
  }
  if (!settings.broad.empty()) {
    all.push_back(settings.large ? gradedPyramids(4, 128) : gradedPyramids(2, 48));
    all.push_back(longWays(settings.large ? 160 : 20));
  }
  return all;
}

FourPoints pointsOf(const Scene& scene, const std::vector<Vec3>& x, PairKind kind, const Pair& pair) {
  if (kind == PairKind::edgeEdge) {
    const auto &a = scene.mesh.edges[pair.first], &b = scene.mesh.edges[pair.second];
    return {x[a[0]], x[a[1]], x[b[0]], x[b[1]]};
  }
  const auto& f = scene.mesh.faces[pair.second];
  return {x[pair.first], x[f[0]], x[f[1]], x[f[2]]};
}

/// Pairs for which core says otherwise.
int differencesToCore(const Scene& scene, ImpactSearch& search, PairKind kind) {
  const std::vector<Pair> pairs = search.pairs(kind);
  const std::vector<Hit> hits = search.hits(kind);
  if (!std::ranges::is_sorted(hits, {}, &Hit::pair)) return static_cast<int>(hits.size());
  return countOf(Each::much, static_cast<int>(pairs.size()), [&](int i) {
    const FourPoints x0 = pointsOf(scene, scene.x0, kind, pairs[i]), x1 = pointsOf(scene, scene.x1, kind, pairs[i]);
    const SearchOptions& o = scene.options;
    const auto truth = kind == PairKind::edgeEdge ? edgeEdgeImpact(x0, x1, o.separation_m, o.tolerance_m)
                                                  : pointTriangleImpact(x0, x1, o.separation_m, o.tolerance_m);
    const auto found = std::ranges::lower_bound(hits, pairs[i], {}, &Hit::pair);
    const bool is_hit = found != hits.end() && found->pair == pairs[i];
    return is_hit != truth.has_value() || (is_hit && !sameBits(found->time, truth->time));
  });
}

int compareWithCore(const Scene& scene, ImpactSearch& search) {
  const int different =
      differencesToCore(scene, search, PairKind::pointTriangle) + differencesToCore(scene, search, PairKind::edgeEdge);
  fmt::print("  of its pairs {} differ from core/contact/certified_impact\n", different);
  return different;
}

void printTimes(ImpactSearch& search, int passes, bool stages) {
  fmt::print("  median of {}: {:.4f} ms with trees rebuilt, {:.4f} ms refitted\n", passes,
             search.medianMilliseconds(Trees::rebuilt, passes), search.medianMilliseconds(Trees::refitted, passes));
  if (!stages) return;
  for (const auto& [name, ms] : search.stageTimes(passes)) fmt::print("    {:<24} {:.4f} ms\n", name, ms);
}

int checkScene(const Scene& scene, const Settings& settings, bool cuda, Facts& facts) {
  fmt::print("{}: {} vertices, {} faces, {} edges\n", scene.name, scene.mesh.vertices, scene.mesh.faces.size(),
             scene.mesh.edges.size());
  const BothSizes room = roomFor(scene.mesh);
  const auto make = [&](bool on_cuda, const SearchOptions& options, int groups_per_block) {
    auto search = on_cuda ? searchOnCuda(scene.mesh, scene.x0, options, room, groups_per_block)
                          : searchOnReference(scene.mesh, scene.x0, options, room);
    search->setMotion(scene.x0, scene.x1);
    search->find(Trees::rebuilt);
    return search;
  };
  const auto first = make(cuda, scene.options, 4);
  facts = factsOf(*first);
  fmt::print("{}  passes repeated for want of room: {}\n", print(facts), first->repeats());
  int different = compareWithCore(scene, *first);
  if (!cuda) return different;
  printTimes(*first, settings.passes, settings.stages);
  const auto expect = [&](const char* what, ImpactSearch& other) {
    const bool same = factsOf(other) == facts;
    fmt::print("  the same on {}: {}\n", what, same ? "yes" : "NO");
    different += !same;
  };
  expect("CUDA once more, after the timing", *first);
  SearchOptions other = scene.options;
  for (const auto& [queries, groups] : {std::pair{1, 1}, {8, 1}, {16, 4}}) {
    other.queries_per_group = queries;
    const auto search = make(true, other, groups);
    expect(fmt::format("CUDA, {} queries a group, {} groups a block", queries, groups).c_str(), *search);
    if (settings.stages) printTimes(*search, settings.passes, false);
  }
  expect("the reference", *make(false, scene.options, 0));
  return different;
}

int checkQueries(const Settings& settings, bool cuda) {
  const std::vector<ImpactQuestion> asked = impactQuestions(settings.queries);
  const std::vector<ImpactAnswer> got = cuda ? answersOnCuda(asked) : answersOnReference(asked);
  int different = 0, hits = 0;
  for (std::size_t i = 0; i < asked.size(); ++i) {
    const auto truth = answerOfCore(asked[i]);
    hits += truth.has_value();
    different += !sameBits(got[i], truth);
  }
  fmt::print("{} queries, random and degenerate, {} of them hits: {} differ from core/contact/certified_impact\n",
             asked.size(), hits, different);
  return different;
}

/// What the parts found of the manifest's scenes.
struct Found {
  std::vector<std::pair<Scene, Facts>> impacts;
  std::string near;  ///< as the manifest has it
  ForceCheck forces;
};

void writeManifest(const fs::path& file, const std::string& device, const Found& found) {
  std::ofstream out(file);
  out << "{\n  \"device\": \"" << device << "\",\n  \"scenes\": [\n";
  for (std::size_t i = 0; i < found.impacts.size(); ++i) {
    const auto& [scene, facts] = found.impacts[i];
    out << "    {\"name\": \"" << scene.name << "\"";
    for (int k = 0; k < kPairKinds; ++k)
      out << fmt::format(
          ",\n     \"{}\": {{\"pairs\": {}, \"open\": {}, \"hard\": {}, \"hits\": {}, \"pairs_hash\": \"{:016x}\", "
          "\"hits_hash\": \"{:016x}\"}}",
          k == 0 ? "points" : "edges", facts[k].sizes.pairs, facts[k].sizes.open, facts[k].sizes.hard,
          facts[k].sizes.hits, facts[k].pairs_hash, facts[k].hits_hash);
    out << (i + 1 < found.impacts.size() ? "},\n" : "}\n");
  }
  out << "  ],\n  \"near\": [\n" << found.near << "\n  ],\n  \"solves\": [\n";
  const std::vector<ContactProblem> problems = manifestProblems();
  for (std::size_t i = 0; i < problems.size(); ++i) {
    const auto on = device == "reference" ? sweepsOnReference() : sweepsOnCuda();
    const SweepFacts facts = factsOf(solved(problems[i], kManifestIterations, on.get()));
    out << fmt::format(
        "    {{\"name\": \"{}\", \"rows\": {}, \"islands\": {}, \"iterations\": {}, \"hash\": \"{:016x}\"}}{}\n",
        problems[i].name, facts.rows, facts.islands, facts.iterations, facts.hash, i + 1 < problems.size() ? "," : "");
  }
  out << "  ],\n  \"forces\": [\n";
  const auto& forces = found.forces.hashes;
  for (std::size_t i = 0; i < forces.size(); ++i)
    out << fmt::format("    {{\"name\": \"{}\", \"hash\": \"{:016x}\"}}{}\n", forces[i].first, forces[i].second,
                       i + 1 < forces.size() ? "," : "");
  out << "  ]\n}\n";
  if (!out) throw RunError("cannot write " + file.string());
}

int checkImpacts(const Settings& settings, bool cuda, std::vector<std::pair<Scene, Facts>>& kept) {
  int different = checkQueries(settings, cuda);
  const std::vector<Scene> of_manifest = manifestScenes();
  for (Scene& scene : scenes(settings)) {
    Facts facts;
    different += checkScene(scene, settings, cuda, facts);
    if (std::ranges::find(of_manifest, scene.name, &Scene::name) != of_manifest.end())
      kept.emplace_back(std::move(scene), facts);
    std::fflush(stdout);
  }
  return different;
}

int run(const Settings& settings) {
  if (!settings.manifest.empty() && !(settings.only.empty() && settings.broad.empty()))
    throw InputError({"", 0, "--write-manifest"}, "is of all parts: leave out --only and --broad");
  const bool cuda = cudaBuilt() && !settings.reference_alone;
  const std::string device = cuda ? cudaDevice() : "reference";
  fmt::print("device: {}{}\n", device, cudaBuilt() ? "" : " (this program was built without CUDA)");
  Found found;
  int different = 0;
  if (settings.asks("forces")) {
    found.forces = checkForces(cuda, settings.passes, settings.large);
    different += found.forces.different;
  }
  if (settings.asks("solves"))
    different += checkSolves({settings.solves, settings.passes, cuda, settings.large, settings.stages});
  if (settings.asks("near"))
    different += checkNear({settings.armour, settings.passes, settings.stages, cuda}, found.near);
  if (settings.asks("step_impacts"))
    different += checkStepImpacts({settings.armour, settings.passes, settings.stages, cuda});
  if (!settings.broad.empty())
    different += checkBroad(scenes(settings), {settings.broad, settings.passes, cuda, settings.stages, !settings.fast});
  else if (settings.asks("impacts"))
    different += checkImpacts(settings, cuda, found.impacts);
  if (!settings.manifest.empty()) writeManifest(settings.manifest, device, found);
  fmt::print("{}\n", different == 0 ? "all the same" : "DIFFERENT");
  return different == 0 ? 0 : 1;
}

}  // namespace
}  // namespace gambeson::gpu

int main(int argc, char** argv) {
  CLI::App app("Compares CUDA with the reference and with core, and times it.");
  gambeson::gpu::Settings settings;
  app.add_option("--data", settings.data, "folder with real/collision in it");
  app.add_option("--armour", settings.armour, "a recorded mesh of a walk in armour");
  app.add_option("--solves", settings.solves, "folder of recorded contact solves, solve0.bin and so on");
  app.add_option("--only", settings.only, "a part of it")
      ->check(CLI::IsMember({"forces", "solves", "near", "step_impacts", "impacts"}));
  app.add_option("--broad", settings.broad, "compare these broad phases")
      ->check(CLI::IsMember(gambeson::gpu::broadNames()));
  app.add_flag("--fast", settings.fast, "with --broad: leave out the reference on CUDA");
  app.add_option("--passes", settings.passes, "of which a time is the median")->check(CLI::Range(1, 1000));
  app.add_option("--queries", settings.queries, "by themselves")->check(CLI::Range(0, 100000000));
  app.add_flag("--stages", settings.stages, "time each stage and variant too");
  app.add_flag("--reference", settings.reference_alone, "the reference alone");
  app.add_flag("!--small", settings.large, "leave out what is large");
  app.add_option("--write-manifest", settings.manifest, "counts and hashes of the small scenes, as gpu/manifest.json");
  CLI11_PARSE(app, argc, argv);
  try {
    return gambeson::gpu::run(settings);
  } catch (const gambeson::InputError& error) {
    fmt::print(stderr, "gambeson_gpu_check: {}\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    fmt::print(stderr, "gambeson_gpu_check: {}\n", error.what());
    return 1;
  }
}
