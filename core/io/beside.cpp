#include "core/io/beside.hpp"

#include <dlfcn.h>

#include <filesystem>

#include "core/error.hpp"

namespace gambeson {

void* functionBeside(const std::string& library, const std::string& function, const std::string& brings) {
  const std::filesystem::path file = std::filesystem::read_symlink("/proc/self/exe").parent_path() / library;
  void* const handle = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!handle) throw RunError(brings + " cannot be loaded: " + dlerror());
  void* const found = dlsym(handle, function.c_str());
  if (!found) throw RunError(file.string() + " is of another version");
  return found;
}

}  // namespace gambeson
