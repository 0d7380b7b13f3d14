// What is kept is on the disk before it has its name, and its name before anybody is told: the
// calls that see to it, in their order, and what is said when one fails.

#include <cerrno>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "drivers/files/atomic_file.h"
#include "drivers/files/pairs_file.h"
#include "tests/support/temporary_folder.h"

namespace {

std::vector<std::string> g_calls;
std::string g_failing;  // a call of this name fails
ino_t g_folder = 0;     // synced last

/// The call's answer where it is to fail or has no disk to wait for.
bool fails(const std::string& call) {
  g_calls.push_back(call);
  errno = EIO;
  return call == g_failing;
}

}  // namespace

// The linker sends each call of NAME to __wrap_NAME.
extern "C" {

int __real_rename(const char* from, const char* to);
int __wrap_rename(const char* from, const char* to);
int __wrap_fsync(int descriptor);

int __wrap_rename(const char* from, const char* to) {
  return fails("rename") ? -1 : __real_rename(from, to);
}

int __wrap_fsync(int descriptor) {
  struct stat status {};
  const bool folder = ::fstat(descriptor, &status) == 0 && S_ISDIR(status.st_mode);
  g_folder = folder ? status.st_ino : g_folder;
  return fails(folder ? "folder" : "file of " + std::to_string(status.st_size)) ? -1 : 0;
}
}

namespace tubesight::drivers {
namespace {

using Calls = std::vector<std::string>;

class StorageOrder : public ::testing::Test {
 protected:
  StorageOrder() {
    g_calls.clear();
    g_failing.clear();
  }

  /// Writes "new!" to a.toml.
  core::Result<void> replace(AtomicFile& file) const {
    EXPECT_TRUE(file.open(folder_.path("a.toml")));
    EXPECT_TRUE(file.write("new!"));
    return file.commit_to_disk();
  }

  support::TemporaryFolder folder_;
};

TEST_F(StorageOrder, IsBytesThenNameThenFolder) {
  AtomicFile file;

  ASSERT_TRUE(replace(file));

  EXPECT_EQ(g_calls, (Calls{"file of 4", "rename", "folder"}));
  EXPECT_EQ(folder_.read("a.toml"), "new!");
}

TEST_F(StorageOrder, OfAResultWaitsForNoDisk) {
  AtomicFile file;
  ASSERT_TRUE(file.open(folder_.path("fields.csv")));

  ASSERT_TRUE(file.commit());

  EXPECT_EQ(g_calls, Calls{"rename"});
}

TEST_F(StorageOrder, LeavesTheOldFileWhereBytesOrNameFail) {
  for (const char* failing : {"file of 4", "rename"}) {
    folder_.write("a.toml", "old");
    g_failing = failing;
    AtomicFile file;

    const auto replaced = replace(file);

    ASSERT_FALSE(replaced) << failing;
    EXPECT_EQ(replaced.error(), core::Error::kIo);
    EXPECT_EQ(folder_.read("a.toml"), "old") << failing;
    EXPECT_EQ(folder_.names(), Calls{"a.toml"}) << failing;
  }
}

TEST_F(StorageOrder, SaysThatANameMayBeTakenBack) {
  folder_.write("a.toml", "old");
  g_failing = "folder";
  AtomicFile file;

  ASSERT_FALSE(replace(file));

  EXPECT_EQ(file.message(),
            folder_.path("a.toml") +
                ": is in its place, but a power cut may take it back: Input/output error");
  EXPECT_EQ(folder_.read("a.toml"), "new!");
  EXPECT_EQ(folder_.names(), Calls{"a.toml"});
}

TEST_F(StorageOrder, OfAPairIsThatToo) {
  std::string message;

  ASSERT_TRUE(append_pair(folder_.path("p.csv"), core::PosePair{}, message));

  ASSERT_EQ(g_calls.size(), 3U);
  EXPECT_TRUE(g_calls[0].starts_with("file of ")) << g_calls[0];
  EXPECT_EQ(g_calls[1], "rename");
  EXPECT_EQ(g_calls[2], "folder");
  g_failing = "folder";
  ASSERT_FALSE(append_pair(folder_.path("p.csv"), core::PosePair{}, message))
      << "what may be taken back is not said to be written";
  EXPECT_NE(message.find("a power cut may take it back"), std::string::npos) << message;
}

TEST_F(StorageOrder, FollowsALinkToTheFolderOfTheFile) {
  ASSERT_EQ(::mkdir(folder_.path("data").c_str(), 0777), 0);
  std::filesystem::create_symlink(folder_.path("data/a.toml"), folder_.path("a.toml"));
  folder_.write("data/a.toml", "old");
  AtomicFile file;

  ASSERT_TRUE(replace(file));

  EXPECT_EQ(folder_.read("data/a.toml"), "new!");
  EXPECT_EQ(g_calls, (Calls{"file of 4", "rename", "folder"}));
  struct stat data {};
  ASSERT_EQ(::stat(folder_.path("data").c_str(), &data), 0);
  EXPECT_EQ(g_folder, data.st_ino);
}

}  // namespace
}  // namespace tubesight::drivers
