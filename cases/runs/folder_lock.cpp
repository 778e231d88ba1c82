#include "cases/runs/folder_lock.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "core/error.hpp"

namespace gambeson {

FolderLock::FolderLock(const std::filesystem::path& folder) {
  constexpr int tries_of_100_ms = 50;
  const InputError::Where where{"command line", 0, "--out"};
  const std::filesystem::path path = folder / file;
  descriptor_ = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0644);
  if (descriptor_ < 0)
    throw InputError(where, fmt::format("{} cannot be written: {}", path.string(), std::strerror(errno)));
  for (int tries = 0; flock(descriptor_, LOCK_EX | LOCK_NB) != 0; ++tries) {
    if (tries == tries_of_100_ms) {
      close(descriptor_);
      throw InputError(where,
                       fmt::format("{} is being written by another command; allowed: one at a time", folder.string()));
    }
    poll(nullptr, 0, 100);
  }
}

FolderLock::~FolderLock() { close(descriptor_); }

}  // namespace gambeson
