/// Only what this program wrote is replaced.

#include "core/io/own_file.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <iterator>

#include "core/io/atomic_file.hpp"

namespace gambeson {
namespace {

namespace fs = std::filesystem;

class OwnFile : public testing::Test {
 protected:
  fs::path dir;
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "gambeson_own_XXXXXX").string();
    dir = mkdtemp(name.data());
  }
  void TearDown() override { fs::remove_all(dir); }

  void write(const std::string& name, const std::string& text) const { std::ofstream(dir / name) << text; }
  std::string read(const std::string& name) const {
    std::ifstream stream(dir / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  void refused(const std::string& name, const std::string& why) const {
    try {
      writeOwnFile(dir / name, "ours");
      ADD_FAILURE() << name << " was replaced";
    } catch (const InputError& e) {
      EXPECT_NE(std::string(e.what()).find(why), std::string::npos) << e.what();
      EXPECT_NE(std::string(e.what()).find(name), std::string::npos) << e.what();
    }
  }
};

TEST_F(OwnFile, ReplacesItsOwnAndNoOthers) {
  writeOwnFile(dir / "a", "one");
  writeOwnFile(dir / "a", "two");
  EXPECT_EQ(read("a"), "two");
  EXPECT_TRUE(isOwnFile(dir / "a"));
  write("b", "mine");
  refused("b", "was not written by this program");
  EXPECT_EQ(read("b"), "mine");
  // Edited, it is the user's; as it was, ours again.
  write("a", "two and mine");
  refused("a", "was changed");
  EXPECT_EQ(read("a"), "two and mine");
  write("a", "two");
  EXPECT_NO_THROW(writeOwnFile(dir / "a", "three"));
  // What was deleted may be written again; what a user then puts there not.
  fs::remove(dir / "a");
  write("a", "mine");
  refused("a", "was changed");
}

TEST_F(OwnFile, FollowsNoLinkAndReplacesNoFolder) {
  fs::create_directories(dir / "out");
  write("target", "mine");
  fs::create_symlink("../target", dir / "out/a");
  refused("out/a", "symbolic link");
  EXPECT_EQ(read("target"), "mine");
  fs::create_symlink("../nowhere", dir / "out/b");
  refused("out/b", "symbolic link");
  EXPECT_FALSE(fs::exists(dir / "nowhere"));
  // Nor the one under the name of an unfinished write.
  fs::create_symlink("../target", dir / "out/c.gambeson.tmp");
  writeOwnFile(dir / "out/c", "ours");
  EXPECT_EQ(read("target"), "mine");
  EXPECT_EQ(read("out/c"), "ours");
  fs::create_directories(dir / "out/d");
  refused("out/d", "not a regular file");
}

TEST_F(OwnFile, TheListIsNoOnesElse) {
  write(".gambeson", "my notes\n");
  refused("a", "is not the list");
  EXPECT_EQ(read(".gambeson"), "my notes\n");
  fs::remove(dir / ".gambeson");
  write("notes", "mine");
  fs::create_symlink("notes", dir / ".gambeson");
  refused("a", "is not the list");
  EXPECT_EQ(read("notes"), "mine");
  fs::remove(dir / ".gambeson");
  fs::create_directories(dir / ".gambeson");
  refused("a", "is not the list");
}

TEST_F(OwnFile, ACopiedFolderStaysOurs) {
  writeOwnFile(dir / "a", "one");
  fs::create_directories(dir / "copy");
  fs::copy_file(dir / "a", dir / "copy/a");
  refused("copy/a", "was not written by this program");
  fs::copy_file(dir / ".gambeson", dir / "copy/.gambeson");
  EXPECT_NO_THROW(writeOwnFile(dir / "copy/a", "two"));
}

/// Two users in one folder, as in /tmp: each has a list, and neither replaces what the other wrote.
TEST_F(OwnFile, EveryUserHasAListInAFolderOfSomebodyElses) {
  if (geteuid() != 0) GTEST_SKIP() << "only root can be two users";
  fs::permissions(dir, fs::perms::all | fs::perms::sticky_bit);
  writeOwnFile(dir / "a", "root's");
  const pid_t child = fork();
  if (child == 0) {
    if (seteuid(12345) != 0) _exit(2);
    bool good = inTheWay(dir / "a") != "";
    for (const char* text : {"one", "two"}) writeOwnFile(dir / "b", text);
    _exit(good && isOwnFile(dir / "b") ? 0 : 1);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_EQ(status, 0);
  refused("b", "was not written by this program");
  EXPECT_EQ(read("a"), "root's");
}

TEST_F(OwnFile, RemovesItsOwnAlone) {
  writeOwnFile(dir / "a", "one");
  writeOwnFile(dir / "b", "one");
  write("b", "edited");
  write("c", "mine");
  EXPECT_EQ(ownFiles(dir), std::vector<fs::path>{dir / "a"});
  for (const char* name : {"a", "b", "c", "d"}) removeOwnFile(dir / name);
  EXPECT_FALSE(fs::exists(dir / "a"));
  EXPECT_EQ(read("b"), "edited");
  EXPECT_EQ(read("c"), "mine");
}

TEST_F(OwnFile, ALogIsOursWhateverIsWrittenIntoIt) {
  claimFile(dir / "run.log");
  write("run.log", "said");
  EXPECT_NO_THROW(claimFile(dir / "run.log"));
  EXPECT_EQ(read("run.log"), "said");
  write("mine.log", "mine");
  EXPECT_THROW(claimFile(dir / "mine.log"), InputError);
}

/// Killed at any moment, the file is ours, old or new; and where the disk is full while the list is written.
TEST_F(OwnFile, StaysOursWhateverHappensToTheWriter) {
  writeOwnFile(dir / "a", "begin");
  for (int delay_us = 0; delay_us < 3000; delay_us += 100) {
    const pid_t child = fork();
    if (child == 0) {
      for (int i = 0;; ++i) writeOwnFile(dir / "a", "content " + std::to_string(i));
    }
    usleep(static_cast<useconds_t>(delay_us));
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    ASSERT_TRUE(isOwnFile(dir / "a")) << read("a");
  }
  const auto size = fs::file_size(dir / ".gambeson");
  for (rlim_t limit = size; limit < size + 60; limit += 7) {
    const pid_t child = fork();
    if (child == 0) {
      signal(SIGXFSZ, SIG_IGN);
      const rlimit bytes{limit, limit};
      setrlimit(RLIMIT_FSIZE, &bytes);
      try {
        writeOwnFile(dir / "b", "b");
      } catch (const RunError&) {
        _exit(0);
      }
      _exit(1);
    }
    int status = 0;
    waitpid(child, &status, 0);
    fs::remove(dir / "b");
    writeOwnFile(dir / "c", "c");
    ASSERT_TRUE(isOwnFile(dir / "c")) << limit;
    ASSERT_TRUE(isOwnFile(dir / "a")) << limit;
  }
  // A header that was cut short.
  const std::string list = read(".gambeson");
  fs::remove_all(dir);
  fs::create_directories(dir);
  write(".gambeson", list.substr(0, 20));
  writeOwnFile(dir / "d", "d");
  EXPECT_TRUE(isOwnFile(dir / "d"));
}

}  // namespace
}  // namespace gambeson
