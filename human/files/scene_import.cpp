#include "human/files/scene_import.hpp"

#include <assimp/postprocess.h>
#include <fmt/format.h>

#include <algorithm>
#include <assimp/IOStream.hpp>
#include <assimp/IOSystem.hpp>
#include <cctype>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <regex>
#include <sstream>

#include "core/error.hpp"
#include "human/files/ply_check.hpp"
#include "human/files/read_text.hpp"

namespace gambeson {
namespace {

constexpr int deepest_json = 64;

/// A file in memory.
class Memory : public Assimp::IOStream {
 public:
  explicit Memory(std::string text) : text_(std::move(text)) {}
  std::size_t Read(void* to, std::size_t size, std::size_t count) override {
    if (size == 0) return 0;
    const std::size_t n = std::min(count, (text_.size() - at_) / size);
    if (n > 0) std::memcpy(to, text_.data() + at_, n * size);
    at_ += n * size;
    return n;
  }
  std::size_t Write(const void*, std::size_t, std::size_t) override { return 0; }
  aiReturn Seek(std::size_t offset, aiOrigin origin) override {
    const std::size_t from = origin == aiOrigin_SET ? 0 : origin == aiOrigin_CUR ? at_ : text_.size();
    const std::size_t to = origin == aiOrigin_END ? from - offset : from + offset;
    if (to > text_.size()) return aiReturn_FAILURE;
    at_ = to;
    return aiReturn_SUCCESS;
  }
  std::size_t Tell() const override { return at_; }
  std::size_t FileSize() const override { return text_.size(); }
  void Flush() override {}

 private:
  std::string text_;
  std::size_t at_ = 0;
};

/// Opens regular files up to a size, and keeps why it did not open the first that is none.
class RegularFiles : public Assimp::IOSystem {
 public:
  explicit RegularFiles(std::optional<InputError>& refused) : refused_(refused) {}
  bool Exists(const char* file) const override { return std::filesystem::exists(file); }
  char getOsSeparator() const override { return '/'; }
  Assimp::IOStream* Open(const char* file, const char*) override {
    try {
      return new Memory(readText(file, largest_scene_file));
    } catch (const InputError& e) {
      if (!refused_) refused_ = e;
      return nullptr;
    }
  }
  void Close(Assimp::IOStream* stream) override { delete stream; }

 private:
  std::optional<InputError>& refused_;
};

/// rapidjson, which assimp reads glTF with, calls itself for every level.
void checkDepth(std::string_view json, const std::string& file) {
  int depth = 0, line = 1;
  bool quoted = false;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (c == '\n') ++line;
    if (quoted) {
      if (c == '\\') ++i;
      quoted = c != '"';
    } else if (c == '"') {
      quoted = true;
    } else if (c == '{' || c == '[') {
      if (++depth > deepest_json)
        throw InputError({file, line, ""}, fmt::format("is nested deeper than {} levels", deepest_json));
    } else if (c == '}' || c == ']') {
      --depth;
    }
  }
}

/// Throws InputError with the line of the first face of an OBJ that names a vertex which is not there.
void checkIndices(std::string_view obj, const std::string& file) {
  long vertices = 0;
  int number = 0;
  for (std::size_t begin = 0; begin < obj.size(); ++number) {
    const std::size_t end = std::min(obj.find('\n', begin), obj.size());
    std::istringstream line{std::string(obj.substr(begin, end - begin))};
    begin = end + 1;
    std::string word;
    line >> word;
    if (word == "v") ++vertices;
    if (word != "f") continue;
    while (line >> word) {
      const long index = std::strtol(word.c_str(), nullptr, 10);
      if (index == 0 || std::abs(index) > vertices)
        throw InputError({file, number + 1, "f"},
                         fmt::format("names vertex '{}' of the {} before it", word.substr(0, 20), vertices));
    }
  }
}

/// What assimp says of files without a surface, or with faces of vertices that are not there, in a user's words.
std::string inWords(const std::string& said) {
  static const std::regex outside(R"(mFaces\[(\d+)\]::mIndices\[\d+\] is out of range)");
  if (std::smatch found; std::regex_search(said, found, outside))
    return "face " + found[1].str() + ": names a vertex that the file does not have; the first face is 0";
  for (const char* none : {"mNumMeshes is 0", "contains no faces", "no faces"})
    if (said.find(none) != std::string::npos)
      return "holds no surface: triangles or polygons between vertices are needed";
  return said;
}

/// The JSON of a binary glTF: its first chunk, after 12 bytes of header and 8 of its own.
std::string_view jsonOf(std::string_view glb) { return glb.substr(std::min<std::size_t>(20, glb.size())); }

}  // namespace

std::string extensionOf(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension;
}

const aiScene& importScene(Assimp::Importer& importer, const std::filesystem::path& file) {
  const std::string extension = extensionOf(file), name = file.string();
  std::string text = readText(file, largest_scene_file);
  if (extension == ".ply") checkPly(text, name);
  if (extension == ".gltf") checkDepth(text, name);
  if (extension == ".glb") {
    std::uint32_t length = 0;
    if (text.size() >= 16) std::memcpy(&length, text.data() + 12, sizeof length);
    checkDepth(jsonOf(text).substr(0, length), name);
  }
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  std::optional<InputError> refused;
  importer.SetIOHandler(new RegularFiles(refused));
  const aiScene* scene = nullptr;
  if (extension == ".gltf" || extension == ".glb" || extension == ".fbx") {
    // These may name other files beside them.
    text = {};
    scene = importer.ReadFile(name, aiProcess_ValidateDataStructure);
  } else {
    // Importers look for a newline at the end (but that of STL, whose length tells binary from text).
    if (extension != ".stl") text += '\n';
    scene =
        importer.ReadFileFromMemory(text.data(), text.size(), aiProcess_ValidateDataStructure, extension.c_str() + 1);
  }
  importer.SetIOHandler(nullptr);
  if (!scene && refused) throw InputError(refused->where(), refused->reason());
  if (!scene && extension == ".obj") checkIndices(text, name);
  if (!scene) throw InputError({name, 0, ""}, inWords(importer.GetErrorString()));
  // Triangulating a mesh some of whose faces have no corner ends the program in an assertion of assimp.
  for (unsigned k = 0; k < scene->mNumMeshes; ++k)
    for (unsigned i = 0; i < scene->mMeshes[k]->mNumFaces; ++i)
      if (scene->mMeshes[k]->mFaces[i].mNumIndices == 0)
        throw InputError({name, 0, fmt::format("face {} of part {}", i, k)}, "has no corner");
  return *scene;
}

const aiScene& processScene(Assimp::Importer& importer, unsigned steps, const std::filesystem::path& file) {
  const aiScene* scene = importer.ApplyPostProcessing(steps);
  if (!scene) throw InputError({file.string(), 0, ""}, importer.GetErrorString());
  return *scene;
}

}  // namespace gambeson
