#include "drivers/files/atomic_file.h"

#include <algorithm>
#include <csignal>
#include <filesystem>

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "drivers/files/commit_together.h"
#include "drivers/files/unfinished.h"
#include "tests/support/temporary_folder.h"

namespace tubesight::drivers {
namespace {

using support::TemporaryFolder;
using Names = std::vector<std::string>;

Names sorted(Names names) {
  std::sort(names.begin(), names.end());
  return names;
}

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

TEST(AtomicFile, RemovesWhatAKilledProgramLeftOfTheSameTarget) {
  const TemporaryFolder folder;
  folder.write("a.csv.0.part", "of a program that was killed");
  folder.write("b.csv.0.part", "of another target");
  AtomicFile file;

  ASSERT_TRUE(file.open(folder.path("a.csv")));
  ASSERT_TRUE(file.write("new"));
  ASSERT_TRUE(file.commit());

  EXPECT_EQ(sorted(folder.names()), (Names{"a.csv", "b.csv.0.part"}));
  EXPECT_EQ(folder.read("a.csv"), "new");
}

TEST(AtomicFile, LeavesAloneWhatAnotherOneIsWriting) {
  const TemporaryFolder folder;
  AtomicFile first;
  AtomicFile second;

  ASSERT_TRUE(first.open(folder.path("a.csv")));
  ASSERT_TRUE(second.open(folder.path("a.csv")));
  ASSERT_TRUE(first.write("first"));
  ASSERT_TRUE(second.write("second"));

  ASSERT_TRUE(second.commit());
  EXPECT_EQ(folder.read("a.csv"), "second");
  ASSERT_TRUE(first.commit());
  EXPECT_EQ(folder.read("a.csv"), "first");
  EXPECT_EQ(folder.names(), Names{"a.csv"});
}

TEST(UnfinishedFolder, ReplacesWhatAKilledProgramLeft) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.path("pictures.0.part"));
  folder.write("pictures.0.part/old.png", "old");
  std::string path;

  const int lock = make_unfinished_folder(folder.path("pictures"), path);

  ASSERT_GE(lock, 0);
  EXPECT_EQ(path, folder.path("pictures.0.part"));
  EXPECT_TRUE(std::filesystem::is_empty(path));
  std::string beside;
  const int other = make_unfinished_folder(folder.path("pictures"), beside);
  ASSERT_GE(other, 0);
  EXPECT_EQ(beside, folder.path("pictures.1.part"));
  forget_unfinished(path);
  forget_unfinished(beside);
  ::close(lock);
  ::close(other);
}

/// Ends a child as a signal would: removes for good, while a file is open.
void end_while_writing(const std::string& path) {
  AtomicFile file;
  if (!file.open(path) || !file.write("half")) {
    ::_exit(2);
  }
  remove_unfinished_for_good();
  ::_exit(0);
}

TEST(UnfinishedFiles, AreRemovedForGood) {
  const TemporaryFolder folder;
  folder.write("a.csv", "old");

  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    end_while_writing(folder.path("a.csv"));
  }
  int status = -1;
  ASSERT_EQ(::waitpid(child, &status, 0), child);

  EXPECT_EQ(status, 0);
  EXPECT_EQ(folder.names(), Names{"a.csv"});
  EXPECT_EQ(folder.read("a.csv"), "old");
}

TEST(CommitTogether, PutsAllInTheirPlacesAtItsOwnCommit) {
  const TemporaryFolder folder;
  CommitTogether together;
  for (const char* const name : {"a.csv", "b.csv"}) {
    AtomicFile file;
    ASSERT_TRUE(file.open(folder.path(name)));
    ASSERT_TRUE(file.write(name));
    ASSERT_TRUE(file.commit());
  }
  EXPECT_FALSE(std::filesystem::exists(folder.path("a.csv")));

  ASSERT_TRUE(together.commit());

  EXPECT_EQ(sorted(folder.names()), (Names{"a.csv", "b.csv"}));
  EXPECT_EQ(folder.read("b.csv"), "b.csv");
}

TEST(CommitTogether, PutsNoneInItsPlaceWhenOneFailed) {
  const TemporaryFolder folder;
  folder.write("a.csv", "old");
  {
    CommitTogether together;
    AtomicFile first;
    ASSERT_TRUE(first.open(folder.path("a.csv")));
    ASSERT_TRUE(first.write("new"));
    ASSERT_TRUE(first.commit());
    AtomicFile second;
    ASSERT_FALSE(second.open(folder.path("none/b.csv")));

    EXPECT_FALSE(together.commit());
    EXPECT_EQ(together.message(), "") << "the second told why";
  }
  EXPECT_EQ(folder.names(), Names{"a.csv"});
  EXPECT_EQ(folder.read("a.csv"), "old");
}

TEST(CommitTogether, TellsANameThatTheSystemRefuses) {
  const TemporaryFolder folder;
  CommitTogether together;
  AtomicFile file;
  ASSERT_TRUE(file.open(folder.path("a.csv")));
  ASSERT_TRUE(file.commit());
  std::filesystem::create_directory(folder.path("a.csv"));

  EXPECT_FALSE(together.commit());

  EXPECT_EQ(together.message(),
            folder.path("a.csv") + ": cannot be put in its place: Is a directory");
  EXPECT_EQ(folder.names(), Names{"a.csv"});
}

TEST(CommitTogether, IsLeftAloneByWhatIsPutTogetherInAnotherWay) {
  const TemporaryFolder folder;
  const CommitTogether together;
  const CommitAlone alone;
  AtomicFile file;
  ASSERT_TRUE(file.open(folder.path("a.csv")));
  ASSERT_TRUE(file.commit());

  EXPECT_EQ(folder.names(), Names{"a.csv"});
}

}  // namespace
}  // namespace tubesight::drivers
