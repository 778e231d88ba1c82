#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <bit>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <random>
#include <stdexcept>

#include "core/error.hpp"
#include "core/io/atomic_file.hpp"
#include "core/io/csv.hpp"

namespace gambeson {
namespace {

namespace fs = std::filesystem;

std::string slurp(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

class FileTest : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "gambeson_file_XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    dir = name;
  }
  void TearDown() override { fs::remove_all(dir); }
  fs::path dir;
};

TEST_F(FileTest, ReplacesWholeFileAndLeavesNothingBeside) {
  writeFileAtomically(dir / "a.txt", "a longer text than the next");
  writeFileAtomically(dir / "a.txt", std::string_view("b\0c", 3));
  EXPECT_EQ(slurp(dir / "a.txt"), std::string("b\0c", 3));
  EXPECT_EQ(std::distance(fs::directory_iterator(dir), {}), 1);
}

TEST_F(FileTest, FollowsALinkAndRefusesWhatIsNotAFile) {
  writeFileAtomically(dir / "target", "old");
  fs::create_symlink("target", dir / "link");
  writeFileAtomically(dir / "link", "new");
  EXPECT_TRUE(fs::is_symlink(dir / "link"));
  EXPECT_EQ(slurp(dir / "target"), "new");
  EXPECT_THROW(writeFileAtomically(dir, "x"), RunError);
  EXPECT_THROW(writeFileAtomically("/dev/null", "x"), RunError);
}

TEST_F(FileTest, SaysWhyItCannotWrite) {
  try {
    writeFileAtomically(dir / "absent" / "a.txt", "x");
    FAIL() << "no exception";
  } catch (const RunError& e) {
    EXPECT_NE(std::string(e.what()).find("absent"), std::string::npos) << e.what();
    EXPECT_NE(std::string(e.what()).find("No such file"), std::string::npos) << e.what();
  }
}

// A full disk, played by the limit on the size of files in a child: the old content stays, nothing is left beside it.
TEST_F(FileTest, KeepsTheOldFileWhereTheDiskIsFull) {
  writeFileAtomically(dir / "a.txt", "old");
  const pid_t child = fork();
  if (child == 0) {
    signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{1024, 1024};
    setrlimit(RLIMIT_FSIZE, &limit);
    try {
      writeFileAtomically(dir / "a.txt", std::string(4096, 'x'));
    } catch (const RunError&) {
      _exit(0);
    }
    _exit(1);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_EQ(status, 0);
  EXPECT_EQ(slurp(dir / "a.txt"), "old");
  EXPECT_EQ(std::distance(fs::directory_iterator(dir), {}), 1);
}

// Every finite double reads back to its own bits (strtod is the independent reader).
TEST(Csv, NumbersRoundTrip) {
  EXPECT_EQ(shortest(0.1), "0.1");
  EXPECT_EQ(shortest(-1e-9), "-1e-09");
  EXPECT_EQ(shortest(2), "2");
  std::mt19937_64 random(1);
  for (int i = 0; i < 10000; ++i) {
    const auto value = std::bit_cast<double>(random());
    if (std::isfinite(value)) {
      ASSERT_EQ(std::strtod(shortest(value).c_str(), nullptr), value);
    }
  }
}

TEST(Csv, HeaderRowsAndQuotes) {
  EXPECT_EQ(formatCsv({"time_s", "a,\"b\""}, {{0, 0.5}, {1, -2}}), "time_s,\"a,\"\"b\"\"\"\n0,0.5\n1,-2\n");
  EXPECT_EQ(formatCsv("segment", {"left, thigh"}, {"force_N"}, {{3}}), "segment,force_N\n\"left, thigh\",3\n");
  EXPECT_THROW(formatCsv({"a"}, {{1, 2}}), std::logic_error);
  EXPECT_THROW(formatCsv("segment", {}, {"a"}, {{1}}), std::logic_error);
}

TEST_F(FileTest, WritesCsv) {
  writeCsv(dir / "t.csv", {"time_s"}, {{0.25}});
  EXPECT_EQ(slurp(dir / "t.csv"), "time_s\n0.25\n");
}

}  // namespace
}  // namespace gambeson
