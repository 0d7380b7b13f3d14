#include "drivers/ffmpeg/child_process.h"

#include <array>
#include <cerrno>
#include <utility>

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

namespace tubesight::drivers {
namespace {

using core::Error;
using core::Result;
using core::Unexpected;

constexpr int kNotesDescriptor = 3;
constexpr int kFileDescriptor = 4;
constexpr int kCannotStart = 127;

void close_one(int& descriptor) {
  if (descriptor >= 0) {
    ::close(descriptor);
    descriptor = -1;
  }
}

/// Two ends of a pipe, closed on destruction. Descriptors up to 4 are what the program will have,
/// so none of ours may stand there.
class Ends {
 public:
  Ends() = default;
  Ends(const Ends&) = delete;
  Ends& operator=(const Ends&) = delete;
  ~Ends() {
    close_one(reader);
    close_one(writer);
  }

  [[nodiscard]] bool open_pipe() {
    std::array<int, 2> ends{};
    return ::pipe2(ends.data(), O_CLOEXEC) == 0 && take(ends);
  }
  /// For what is written without the signal that a pipe raises when nobody reads.
  [[nodiscard]] bool open_socket() {
    std::array<int, 2> ends{};
    return ::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) == 0 && take(ends);
  }

  int reader = -1;
  int writer = -1;

 private:
  [[nodiscard]] bool take(std::array<int, 2> ends) {
    reader = lift(ends[0]);
    writer = lift(ends[1]);
    return reader >= 0 && writer >= 0;
  }
  static int lift(int descriptor) {
    if (descriptor > kFileDescriptor) {
      return descriptor;
    }
    const int lifted = ::fcntl(descriptor, F_DUPFD_CLOEXEC, kFileDescriptor + 1);
    ::close(descriptor);
    return lifted;
  }
};

/// In the new process, where only such calls are allowed as a signal handler may make.
[[noreturn]] void become(char* const* arguments, int input, int output, int errors, int notes,
                         int file, pid_t parent, int refusal) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  bool good = ::getppid() == parent;  // it may have ended before the line above
  ::signal(SIGPIPE, SIG_DFL);
  good = good && ::dup2(input, STDIN_FILENO) >= 0 && ::dup2(output, STDOUT_FILENO) >= 0 &&
         ::dup2(errors, STDERR_FILENO) >= 0 &&
         (notes < 0 || ::dup2(notes, kNotesDescriptor) >= 0) &&
         (file < 0 || ::dup2(file, kFileDescriptor) >= 0);
  if (good) {
    ::execvp(arguments[0], arguments);
  }
  const int why = errno;
  static_cast<void>(!::write(refusal, &why, sizeof why));
  ::_exit(kCannotStart);
}

}  // namespace

Result<void> ChildProcess::start(const std::vector<std::string>& arguments, Pipes pipes) {
  if (process_ >= 0) {
    return Unexpected(Error::kNotReady);
  }
  end();
  Ends input;
  Ends output;
  Ends errors;
  Ends notes;
  Ends refusal;
  if (pipes.input) {
    if (!input.open_socket()) {
      return Unexpected(Error::kIo);
    }
  } else {
    input.reader = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
  }
  // It may stand where the pipes go.
  Ends file;
  if (pipes.file >= 0) {
    file.reader = ::fcntl(pipes.file, F_DUPFD_CLOEXEC, kFileDescriptor + 1);
    if (file.reader < 0) {
      return Unexpected(Error::kIo);
    }
  }
  if (input.reader < 0 || !output.open_pipe() || !errors.open_pipe() || !refusal.open_pipe() ||
      (pipes.notes && !notes.open_pipe())) {
    return Unexpected(Error::kIo);
  }
  std::vector<char*> words;
  for (const std::string& argument : arguments) {
    words.push_back(const_cast<char*>(argument.c_str()));  // execvp() changes none
  }
  words.push_back(nullptr);
  const pid_t parent = ::getpid();
  process_ = ::fork();
  if (process_ < 0) {
    return Unexpected(Error::kIo);
  }
  if (process_ == 0) {
    become(words.data(), input.reader, output.writer, errors.writer, notes.writer, file.reader,
           parent, refusal.writer);
  }
  close_one(refusal.writer);
  int why = 0;
  ssize_t count = 0;
  do {
    count = ::read(refusal.reader, &why, sizeof why);
  } while (count < 0 && errno == EINTR);
  if (count == static_cast<ssize_t>(sizeof why)) {
    end();
    errno = why;
    return Unexpected(why == ENOENT ? Error::kUnsupported : Error::kIo);
  }
  input_ = std::exchange(input.writer, -1);
  output_ = std::exchange(output.reader, -1);
  errors_ = std::exchange(errors.reader, -1);
  notes_ = std::exchange(notes.reader, -1);
  return {};
}

bool ChildProcess::write(std::span<const std::byte> bytes) {
  while (!bytes.empty() && input_ >= 0) {
    const ssize_t count = ::send(input_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (count < 0 && errno == EINTR) {
      continue;
    }
    if (count < 0) {
      return false;
    }
    bytes = bytes.subspan(static_cast<std::size_t>(count));
  }
  return bytes.empty();
}

void ChildProcess::close_input() { close_one(input_); }

void ChildProcess::close_output() { close_one(output_); }

int ChildProcess::wait() {
  if (process_ < 0) {
    return status_;
  }
  int status = 0;
  pid_t ended = -1;
  do {
    ended = ::waitpid(process_, &status, 0);
  } while (ended < 0 && errno == EINTR);
  process_ = -1;
  if (ended < 0) {
    status_ = kCannotStart;
  } else {
    status_ = WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
  }
  return status_;
}

void ChildProcess::end() {
  if (process_ >= 0) {
    ::kill(process_, SIGKILL);
    static_cast<void>(wait());
  }
  close_one(input_);
  close_one(output_);
  close_one(errors_);
  close_one(notes_);
}

}  // namespace tubesight::drivers
