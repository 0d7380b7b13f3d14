#include "drivers/ffmpeg/child_process.h"

#include <array>
#include <cerrno>
#include <string>
#include <string_view>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

namespace tubesight::drivers {
namespace {

std::string read_all(int descriptor) {
  std::string text;
  std::array<char, 512> part{};
  ssize_t count = 0;
  while ((count = ::read(descriptor, part.data(), part.size())) > 0) {
    text.append(part.data(), static_cast<std::size_t>(count));
  }
  return text;
}

TEST(ChildProcess, HandsArgumentsOverAsTheyAre) {
  ChildProcess child;

  ASSERT_TRUE(child.start({"printf", "%s|", "a b", "$HOME", "'; exit"}, {}));

  EXPECT_EQ(read_all(child.output()), "a b|$HOME|'; exit|");
  EXPECT_EQ(child.wait(), 0);
}

TEST(ChildProcess, TellsThatThereIsNoSuchProgram) {
  ChildProcess child;

  const auto started = child.start({"no-such-program-of-anybody"}, {});

  ASSERT_FALSE(started);
  EXPECT_EQ(started.error(), core::Error::kUnsupported);
  EXPECT_EQ(errno, ENOENT);
}

TEST(ChildProcess, GivesItPipesAndAFileAndNothingElse) {
  const int file = ::open("/dev/zero", O_RDONLY);  // without O_CLOEXEC
  ASSERT_GE(file, 0);
  ChildProcess child;

  ASSERT_TRUE(child.start({"sh", "-c",
                           "cat; echo note >&3; head -c 2 /dev/fd/4 | od -An -tu1; "
                           "echo wrong >&2; exit 7"},
                          {.input = true, .notes = true, .file = file}));
  ASSERT_TRUE(child.write(std::as_bytes(std::span(std::string_view("given ")))));
  child.close_input();

  EXPECT_EQ(read_all(child.output()), "given    0   0\n");
  EXPECT_EQ(read_all(child.notes()), "note\n");
  EXPECT_EQ(read_all(child.errors()), "wrong\n");
  EXPECT_EQ(child.wait(), 7);
  ::close(file);
}

TEST(ChildProcess, IsKilledAndReaped) {
  pid_t process = 0;
  {
    ChildProcess child;
    ASSERT_TRUE(child.start({"sh", "-c", "echo $$; exec sleep 1000"}, {}));
    std::array<char, 32> text{};
    ASSERT_GT(::read(child.output(), text.data(), text.size() - 1), 0);
    process = static_cast<pid_t>(std::stol(text.data()));
    ASSERT_EQ(::kill(process, 0), 0);
  }

  EXPECT_EQ(::kill(process, 0), -1);
  EXPECT_EQ(errno, ESRCH);
}

/// Whoever is killed takes along what it started.
TEST(ChildProcess, EndsWithWhoStartedIt) {
  std::array<int, 2> told{};
  ASSERT_EQ(::pipe(told.data()), 0);
  const pid_t starter = ::fork();
  if (starter == 0) {
    ChildProcess child;
    // Its standard error is the pipe's end, which closes with it.
    static_cast<void>(!child.start({"sh", "-c", "exec sleep 1000"}, {.file = told[1]}));
    ::write(told[1], "x", 1);
    ::pause();
    ::_exit(1);
  }
  ::close(told[1]);
  char ready = 0;
  ASSERT_EQ(::read(told[0], &ready, 1), 1);

  ASSERT_EQ(::kill(starter, SIGKILL), 0);
  ASSERT_EQ(::waitpid(starter, nullptr, 0), starter);

  EXPECT_EQ(::read(told[0], &ready, 1), 0);  // the end: nobody holds the pipe any more
  ::close(told[0]);
}

TEST(ChildProcess, RaisesNoSignalWhereNobodyReads) {
  ChildProcess child;
  ASSERT_TRUE(child.start({"true"}, {.input = true}));
  EXPECT_EQ(child.wait(), 0);

  const std::string much(1 << 20, 'x');
  EXPECT_FALSE(child.write(std::as_bytes(std::span(much))));
}

}  // namespace
}  // namespace tubesight::drivers
