#include "drivers/files/atomic_file.h"

#include <csignal>
#include <filesystem>

#include <gtest/gtest.h>
#include <sys/resource.h>

#include "tests/support/temporary_folder.h"

namespace tubesight::drivers {
namespace {

using support::TemporaryFolder;
using Names = std::vector<std::string>;

TEST(AtomicFile, AppearsOnlyWhenCommitted) {
  const TemporaryFolder folder;
  AtomicFile file;

  ASSERT_TRUE(file.open(folder.path("a.csv")));
  ASSERT_TRUE(file.write("one\n"));
  EXPECT_FALSE(std::filesystem::exists(folder.path("a.csv")));
  ASSERT_EQ(folder.names().size(), 1u);
  EXPECT_TRUE(folder.names()[0].ends_with(".part"));
  ASSERT_TRUE(file.commit());

  EXPECT_EQ(folder.names(), Names{"a.csv"});
  EXPECT_EQ(folder.read("a.csv"), "one\n");
}

TEST(AtomicFile, LeavesTheOldFileWhenNotCommitted) {
  const TemporaryFolder folder;
  folder.write("a.csv", "old");
  {
    AtomicFile file;
    ASSERT_TRUE(file.open(folder.path("a.csv")));
    ASSERT_TRUE(file.write(std::string(100000, 'x')));
  }
  EXPECT_EQ(folder.names(), Names{"a.csv"});
  EXPECT_EQ(folder.read("a.csv"), "old");
}

TEST(AtomicFile, ReplacesWhatASymbolicLinkPointsTo) {
  const TemporaryFolder folder;
  folder.write("real.csv", "old");
  std::filesystem::create_symlink(folder.path("real.csv"), folder.path("link.csv"));
  AtomicFile file;

  ASSERT_TRUE(file.open(folder.path("link.csv")));
  ASSERT_TRUE(file.write("new"));
  ASSERT_TRUE(file.commit());

  EXPECT_TRUE(std::filesystem::is_symlink(folder.path("link.csv")));
  EXPECT_EQ(folder.read("real.csv"), "new");
}

TEST(AtomicFile, TellsAFolderThatIsNotThere) {
  const TemporaryFolder folder;
  AtomicFile file;

  const auto opened = file.open(folder.path("none/a.csv"));

  ASSERT_FALSE(opened);
  EXPECT_EQ(opened.error(), core::Error::kIo);
  EXPECT_EQ(file.message(),
            folder.path("none/a.csv") + ": cannot be written: No such file or directory");
}

TEST(AtomicFile, TellsAFolderInTheFilesPlace) {
  const TemporaryFolder folder;
  AtomicFile file;

  EXPECT_FALSE(file.open(folder.path("")));
  EXPECT_EQ(file.message(), folder.path("") + ": cannot be written: Is a directory");
}

TEST(AtomicFile, TellsAFullDisk) {
  AtomicFile file;
  ASSERT_TRUE(file.open("/dev/full"));
  ASSERT_TRUE(file.write("few bytes are only collected"));

  const auto committed = file.commit();

  ASSERT_FALSE(committed);
  EXPECT_EQ(committed.error(), core::Error::kIo);
  EXPECT_EQ(file.message(), "/dev/full: cannot be written: No space left on device");
}

TEST(AtomicFile, LeavesNothingWhenItCannotGrow) {
  const TemporaryFolder folder;
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{100000, before.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  AtomicFile file;
  ASSERT_TRUE(file.open(folder.path("a.csv")));

  const bool written = file.write(std::string(300000, 'x')).has_value();
  const bool committed = file.commit().has_value();
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);

  EXPECT_FALSE(written);
  EXPECT_FALSE(committed);
  EXPECT_EQ(file.message(), folder.path("a.csv") + ": cannot be written: File too large");
  EXPECT_EQ(folder.names(), Names{});
}

TEST(AtomicFile, RefusesToWriteBeforeOpen) {
  AtomicFile file;

  EXPECT_EQ(file.write("x").error(), core::Error::kNotReady);
  EXPECT_EQ(file.commit().error(), core::Error::kNotReady);
}

}  // namespace
}  // namespace tubesight::drivers
