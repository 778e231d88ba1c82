#include <fmt/format.h>

#include <cstdint>
#include <fstream>
#include <string_view>

#include "cases/case.hpp"
#include "core/error.hpp"

namespace gambeson {
namespace {

/// FNV-1a, 64 bits, with the length after each part so that parts cannot run into each other.
class Hash {
 public:
  void add(std::string_view bytes) {
    for (const char c : bytes) step(static_cast<unsigned char>(c));
    for (std::uint64_t n = bytes.size(), i = 0; i < 8; ++i, n >>= 8) step(static_cast<unsigned char>(n & 0xff));
  }
  std::uint64_t value() const { return value_; }

 private:
  void step(unsigned char byte) {
    value_ ^= byte;
    value_ *= 0x100000001b3ULL;
  }
  std::uint64_t value_ = 0xcbf29ce484222325ULL;
};

/// The files that the case names, each replaced by its content: a case moved to another folder stays the same case.
void addFile(Hash& hash, std::filesystem::path& path) {
  if (path.empty()) return;
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw InputError({path.string(), 0, ""}, "cannot be opened");
  hash.add(std::string(std::istreambuf_iterator<char>(stream), {}));
  path = path.filename();
}

}  // namespace

std::string caseIdentity(const Case& c) {
  Hash hash;
  Case named = c;
  if (auto* file = std::get_if<FileGarment>(&named.garment.shape)) addFile(hash, file->path);
  if (named.human) {
    addFile(hash, named.human->urdf);
    addFile(hash, named.human->body);
    if (auto* trajectory = std::get_if<TrajectoryMotion>(&named.human->motion)) addFile(hash, trajectory->file);
  }
  for (ObstacleCase& o : named.obstacles)
    if (auto* mesh = std::get_if<MeshObstacle>(&o.shape)) addFile(hash, mesh->file);
  hash.add(writeCase(named));
  return fmt::format("{:016x}", hash.value());
}

}  // namespace gambeson
