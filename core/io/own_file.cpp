#include "core/io/own_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdint>
#include <set>
#include <system_error>

#include "core/io/atomic_file.hpp"

namespace gambeson {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view header =
    "# What gambeson wrote in this folder: it replaces no other files. This list may be removed.\n";
/// Stands in place of size and hash: the file is ours whatever its content.
constexpr std::string_view any = "any";

[[noreturn]] void fail(const char* what, const fs::path& path, int error) {
  throw RunError(std::string("cannot ") + what + " " + path.string() + ": " + std::generic_category().message(error));
}

class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  int get() const { return fd_; }

 private:
  int fd_;
};

/// FNV-1a, 64 bits, of a content that comes in parts; and its size.
struct Mark {
  std::uint64_t hash = 0xcbf29ce484222325ULL, size = 0;
  void add(std::string_view part) {
    for (const char c : part) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
    size += part.size();
  }
  std::string text() const {
    char buffer[40];
    char* end = std::to_chars(buffer, buffer + 20, size).ptr;
    *end++ = ':';
    end = std::to_chars(end, buffer + sizeof buffer, hash, 16).ptr;
    return {buffer, end};
  }
};

/// Calls `take` with the parts of an open file; false where it cannot be read.
template <class Take>
bool readParts(int fd, Take take) {
  std::vector<char> buffer(1 << 16);
  for (;;) {
    const ssize_t n = ::read(fd, buffer.data(), buffer.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return false;
    if (n == 0) return true;
    take(std::string_view(buffer.data(), static_cast<std::size_t>(n)));
  }
}

fs::path folderOf(const fs::path& file) { return file.has_parent_path() ? file.parent_path() : fs::path("."); }
/// In a folder of somebody else's, such as /tmp, every user has a list.
fs::path listIn(const fs::path& folder) {
  struct stat status {};
  std::string name(kOwnFiles);
  if (::stat(folder.c_str(), &status) == 0 && status.st_uid != ::geteuid())
    name.append(".").append(std::to_string(::geteuid()));
  return folder / name;
}
fs::path listOf(const fs::path& file) { return listIn(folderOf(file)); }

/// The list of a folder, empty where there is none; a file of that name that is no list of ours lists nothing.
std::string readList(const fs::path& list) {
  const Descriptor file(::open(list.c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC | O_NONBLOCK));
  struct stat status {};
  std::string text;
  if (file.get() < 0 || ::fstat(file.get(), &status) != 0 || !S_ISREG(status.st_mode)) return text;
  if (!readParts(file.get(), [&](std::string_view part) { text += part; }) || !text.starts_with(header)) text.clear();
  return text;
}

/// Marks of each line that ends; a line that was cut short is none.
template <class Take>
void eachLine(std::string_view list, Take take) {
  for (std::size_t end = 0; (end = list.find('\n')) != std::string_view::npos; list.remove_prefix(end + 1)) {
    const std::string_view line = list.substr(0, end);
    const std::size_t blank = line.find(' ');
    if (blank != std::string_view::npos && line[0] != '#') take(line.substr(0, blank), line.substr(blank + 1));
  }
}

/// Appends a line and brings it to the disk: from then on the file is ours as soon as it has that content.
void enter(const fs::path& file, std::string_view mark) {
  const fs::path list = listOf(file);
  const auto refuse = [&] {
    throw InputError({list.string(), 0, ""},
                     "is not the list of this program's files; allowed: another folder, or one without that file");
  };
  const Descriptor d(::open(list.c_str(), O_RDWR | O_APPEND | O_CREAT | O_NOFOLLOW | O_CLOEXEC | O_NONBLOCK, 0666));
  if (d.get() < 0 && (errno == ELOOP || errno == EISDIR || errno == ENXIO)) refuse();
  if (d.get() < 0) fail("create", list, errno);
  struct stat status {};
  if (::fstat(d.get(), &status) != 0) fail("read", list, errno);
  if (!S_ISREG(status.st_mode)) refuse();
  std::string line;
  if (status.st_size == 0) {
    line = header;
  } else {
    std::string begin(std::min<std::size_t>(header.size(), static_cast<std::size_t>(status.st_size)), '\0');
    if (::pread(d.get(), begin.data(), begin.size(), 0) != static_cast<ssize_t>(begin.size()))
      fail("read", list, errno);
    char last = 0;
    if (::pread(d.get(), &last, 1, status.st_size - 1) != 1) fail("read", list, errno);
    if (begin != header) {
      // A header that was cut short (a full disk) is begun again; anything else is not ours.
      if (!header.starts_with(begin)) refuse();
      if (::ftruncate(d.get(), 0) != 0) fail("write", list, errno);
      line = header;
    } else if (last != '\n') {
      line.push_back('\n');  // after a line that was cut short
    }
  }
  line.append(mark).append(" ").append(file.filename().string()).append("\n");
  // One call, so that lines of two programs do not mix; what a full disk takes of it is no line, and said by the next.
  for (std::string_view rest = line; !rest.empty();) {
    const ssize_t n = ::write(d.get(), rest.data(), rest.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail("write", list, errno);
    rest.remove_prefix(static_cast<std::size_t>(n));
  }
  if (::fsync(d.get()) != 0) fail("write", list, errno);
}

enum class Stands { nothing, own, link, other_kind, unlisted, changed, unreadable };

Stands standsAt(const fs::path& path) {
  struct stat status {};
  if (::lstat(path.c_str(), &status) != 0)
    return errno == ENOENT || errno == ENOTDIR ? Stands::nothing : Stands::unreadable;
  if (S_ISLNK(status.st_mode)) return Stands::link;
  if (!S_ISREG(status.st_mode)) return Stands::other_kind;
  const std::string name = path.filename().string();
  std::set<std::string, std::less<>> marks;
  eachLine(readList(listOf(path)), [&](std::string_view mark, std::string_view of) {
    if (of == name) marks.emplace(mark);
  });
  if (marks.empty()) return Stands::unlisted;
  if (marks.contains(any)) return Stands::own;
  Mark mark;
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC));
  if (file.get() < 0 || !readParts(file.get(), [&](std::string_view part) { mark.add(part); }))
    return Stands::unreadable;
  return marks.contains(mark.text()) ? Stands::own : Stands::changed;
}

}  // namespace

std::string inTheWay(const fs::path& file) {
  switch (standsAt(file)) {
    case Stands::nothing:
    case Stands::own:
      return "";
    case Stands::link:
      return "is a symbolic link, and what it points to would be overwritten";
    case Stands::other_kind:
      return "is not a regular file";
    case Stands::unlisted:
      return "was not written by this program (or by a version that kept no list), and would be overwritten";
    case Stands::changed:
      return "was changed since this program wrote it, and would be overwritten";
    case Stands::unreadable:
      return "cannot be read, and would be overwritten";
  }
  return "";
}

bool isOwnFile(const fs::path& file) { return standsAt(file) == Stands::own; }

void requireFree(const fs::path& file, const InputError::Where& where) {
  if (const std::string why = inTheWay(file); !why.empty())
    throw InputError(where, file.string() + " " + why + "; allowed: another name, or none of that file there");
}

void writeOwnFile(const fs::path& file, std::string_view content) {
  requireFree(file, {"", 0, ""});
  Mark mark;
  mark.add(content);
  enter(file, mark.text());
  writeFileAtomically(file, content);
}

void claimFile(const fs::path& file) {
  requireFree(file, {"", 0, ""});
  enter(file, any);
  const Descriptor d(::open(file.c_str(), O_WRONLY | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0666));
  if (d.get() < 0) fail("create", file, errno);
}

void removeOwnFile(const fs::path& file) {
  if (!isOwnFile(file)) return;
  if (::unlink(file.c_str()) != 0 && errno != ENOENT) fail("remove", file, errno);
}

std::vector<fs::path> ownFiles(const fs::path& folder) {
  std::set<std::string> names;
  eachLine(readList(listIn(folder)), [&](std::string_view, std::string_view name) { names.emplace(name); });
  std::vector<fs::path> own;
  for (const std::string& name : names)
    if (isOwnFile(folder / name)) own.push_back(folder / name);
  return own;
}

}  // namespace gambeson
