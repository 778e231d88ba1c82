/// gambeson_manikin DIR [--skins]: writes the six manikins, each as NAME.urdf and NAME.body.json, and their skins in
/// the standing posture as NAME.skin.obj.

#include <cstdio>
#include <exception>
#include <string_view>

#include "core/error.hpp"
#include "human/files/mesh.hpp"
#include "human/manikin/manikin.hpp"
#include "human/skin/make_skin.hpp"

int main(int argc, char** argv) {
  using namespace gambeson;
  const bool skins = argc == 3 && argv[2] == std::string_view("--skins");
  if (argc != 2 && !skins) {
    std::fputs("usage: gambeson_manikin DIR [--skins]\n", stderr);
    return 2;
  }
  try {
    const std::filesystem::path folder = argv[1];
    for (const std::string& name : manikinNames()) {
      writeManikin(name, folder / (name + ".urdf"), folder / (name + ".body.json"));
      if (skins) writeMesh(makeSkin(makeManikin(name)).rest, folder / (name + ".skin.obj"));
    }
  } catch (const InputError& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 2;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
  }
  return 0;
}
