#include "core/io/atomic_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <string>
#include <system_error>

#include "core/error.hpp"

namespace gambeson {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const char* what, const fs::path& path, int error) {
  throw RunError(std::string("cannot ") + what + " " + path.string() + ": " + std::generic_category().message(error));
}

class Descriptor {
 public:
  Descriptor(const fs::path& path, int flags, const char* what) : fd_(::open(path.c_str(), flags | O_CLOEXEC, 0666)) {
    if (fd_ < 0) fail(what, path, errno);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  int get() const { return fd_; }
  /// close() reports what a network file system kept back.
  int close() {
    const int fd = fd_;
    fd_ = -1;
    return ::close(fd);
  }

 private:
  int fd_;
};

void writeAll(const fs::path& path, std::string_view content) {
  if (::unlink(path.c_str()) != 0 && errno != ENOENT) fail("remove", path, errno);  // of a writer that was killed
  Descriptor file(path, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW, "create");
  while (!content.empty()) {
    const ssize_t n = ::write(file.get(), content.data(), content.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail("write", path, errno);
    content.remove_prefix(static_cast<std::size_t>(n));
  }
  if (::fsync(file.get()) != 0) fail("write", path, errno);
  if (file.close() != 0) fail("write", path, errno);
}

}  // namespace

void writeFileAtomically(const fs::path& path, std::string_view content) {
  std::error_code error;
  fs::path target = path;
  if (fs::is_symlink(path, error)) {
    target = fs::weakly_canonical(path, error);
    if (error) fail("follow", path, error.value());
  }
  // A rename onto a device or pipe would replace it by a file.
  const fs::file_status status = fs::status(target, error);
  if (fs::exists(status) && !fs::is_regular_file(status))
    throw RunError("cannot write " + path.string() + ": not a regular file");

  fs::path temporary = target;
  temporary += kUnfinishedSuffix;
  try {
    writeAll(temporary, content);
    if (::rename(temporary.c_str(), target.c_str()) != 0) fail("replace", path, errno);
  } catch (...) {
    ::unlink(temporary.c_str());
    throw;
  }
  syncDirectory(target.has_parent_path() ? target.parent_path() : fs::path("."));
}

void syncDirectory(const fs::path& directory) {
  Descriptor d(directory, O_RDONLY | O_DIRECTORY, "open");
  // Some file systems refuse fsync on a directory (EINVAL): they have no such promise to give.
  if (::fsync(d.get()) != 0 && errno != EINVAL) fail("sync", directory, errno);
}

}  // namespace gambeson
