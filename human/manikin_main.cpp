/// gambeson_manikin DIR: writes the six manikins, each as NAME.urdf and NAME.body.json.

#include <cstdio>
#include <exception>

#include "core/error.hpp"
#include "human/load.hpp"
#include "human/manikin.hpp"

int main(int argc, char** argv) {
  using namespace gambeson;
  if (argc != 2) {
    std::fputs("usage: gambeson_manikin DIR\n", stderr);
    return 2;
  }
  try {
    const std::filesystem::path folder = argv[1];
    for (const std::string& name : manikinNames())
      writeManikin(name, folder / (name + ".urdf"), folder / (name + ".body.json"));
  } catch (const InputError& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 2;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
  }
  return 0;
}
