// Faults around a running box: masters that flood, a full disk, a source that goes, a second box on
// the line.

#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include "drivers/control/json_line.h"
#include "tests/drivers/modbus/serial_robot.h"
#include "tests/system/daemon.h"
#include "tests/system/tcp_line.h"

namespace tubesight::tests {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

/// A request of Modbus TCP to unit 1.
std::string tcp_frame(const Bytes& pdu) {
  std::string frame{0, 1, 0, 0, 0, static_cast<char>(pdu.size() + 1), 1};
  return frame.append(pdu.begin(), pdu.end());
}

/// Function 16: a claim of a tube that nothing stands under.
Bytes wrong_claim(std::uint8_t id) {
  return {16, 1, 44, 0, 8, 16, 0, 0, 0, id, 0, 0, 0, 3, 0, 0, 0, 3, 0, 0, 0, 1};
}

/// A master that sends as fast as the box takes, and reads what comes or not.
class Flood {
 public:
  Flood(int port, std::string what, bool reads)
      : thread_([this, port, what = std::move(what), reads] {
          while (!done_) {
            const int master = connect_to_port(port);
            while (master >= 0 && !done_ &&
                   (send(master, what.data(), what.size(), MSG_NOSIGNAL | MSG_DONTWAIT) >= 0 ||
                    errno == EAGAIN)) {
              std::this_thread::sleep_for(std::chrono::microseconds(200));
              char answers[4096];
              while (reads && recv(master, answers, sizeof answers, MSG_DONTWAIT) > 0) {
              }
            }
            close(master);
          }
        }) {}
  Flood(const Flood&) = delete;
  Flood& operator=(const Flood&) = delete;
  ~Flood() {
    done_ = true;
    thread_.join();
  }

 private:
  static int connect_to_port(int port) {
    const int master = socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    if (connect(master, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0) {
      std::this_thread::sleep_for(milliseconds(1));
    }
    return master;
  }

  std::atomic<bool> done_{false};
  std::thread thread_;
};

std::string line_and_port(const std::string& device, int port) {
  return "[link]\nkind = \"modbus\"\nbaud = 115200\nparity = \"none\"\ndevice = \"" + device +
         "\"\ntcp_port = " + std::to_string(port) + "\n";
}

Answered run_robot(const std::string& device, const std::string& for_s) {
  return run_program("/usr/bin/python3", {"-B", TUBESIGHT_SOURCE_DIR "/docs/examples/robot.py",
                                          device + ",115200,N", for_s});
}

int count(const std::string& text, const std::string& part) {
  int found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++found;
  }
  return found;
}

std::int64_t number_in(const std::string& status, const std::string& object,
                       const std::string& key) {
  const std::size_t at = status.find("\"" + object + "\":{");
  return at == std::string::npos ? -1 : drivers::find_json_number(status.substr(at), key, -1);
}

TEST(BoxFaults, MastersThatFloodNeitherDelayTheTrackingNorShutOutTheRobot) {
  const PtyPair line;
  const int port = free_port();
  Daemon box;
  box.write_simulated_settings(line_and_port(line.box.device(), port));
  ASSERT_TRUE(box.start_and_wait()) << box.said();
  std::string claims;
  for (std::uint8_t i = 0; i < 40; ++i) {
    claims += tcp_frame(wrong_claim(i));
  }

  Answered run;
  {
    const Flood first(port, claims, true);
    const Flood second(port, claims, true);
    const Flood deaf(port, claims, false);
    const Flood garbage(port, std::string(500, '\x5a'), false);
    run = run_robot(line.robot.device(), "3");
  }

  ASSERT_EQ(run.status, 0) << run.err << run.out;
  EXPECT_TRUE(has(run.out, "start taken\n")) << run.out;
  EXPECT_EQ(count(run.out, "NO ANSWER") + count(run.out, "OF ANOTHER CLAIM"), 0) << run.out;
  EXPECT_EQ(count(run.out, "40,60 AGREE tube 41,60") + count(run.out, "41,60 AGREE"), 0);
  EXPECT_GT(count(run.out, "40,60 AGREE tube 40,60"), 20) << run.out;
  EXPECT_GT(count(run.out, "41,60 DISAGREE tube 40,60"), 20) << run.out;
  const std::string status = box.ask({"status", "--json"}).out;
  EXPECT_TRUE(has(status, "\"state\":\"tracking\"")) << status;
  EXPECT_GT(number_in(status, "link", "requests"), 1000) << status;
  EXPECT_GT(number_in(status, "link", "errors"), 100) << status;
  EXPECT_LE(number_in(status, "counters", "missing"), number_in(status, "source", "made_late"))
      << status;
  EXPECT_GT(number_in(status, "link", "exceptions"), 100) << "what found no room is told";
}

/// Files of programs that are started meanwhile end at so many bytes, as on a full disk.
class SmallDisk {
 public:
  explicit SmallDisk(rlim_t bytes) {
    EXPECT_EQ(getrlimit(RLIMIT_FSIZE, &before_), 0);
    const rlimit limit{bytes, before_.rlim_max};
    EXPECT_EQ(setrlimit(RLIMIT_FSIZE, &limit), 0);
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;
  ~SmallDisk() { EXPECT_EQ(setrlimit(RLIMIT_FSIZE, &before_), 0); }

  /// Frees the disk of one that runs.
  void free(pid_t process) const {
    EXPECT_EQ(prlimit(process, RLIMIT_FSIZE, &before_, nullptr), 0);
  }

 private:
  rlimit before_{};
};

int count_endings(const Daemon& box, const std::string& ending) {
  int found = 0;
  for (const std::string& name : box.folder().names()) {
    found += name.ends_with(ending) ? 1 : 0;
  }
  return found;
}

TEST(BoxFaults, AFullDiskCostsTheRecordingAloneAndTheNextIsWrittenWhenThereIsRoom) {
  Daemon box;
  box.write_simulated_settings(
      "script = true\n[record]\nfolder = \".\"\nmemory_mb = 20\nfields_after = 5\n");
  const SmallDisk disk(200'000);
  ASSERT_TRUE(box.start_and_wait()) << box.said();
  ASSERT_TRUE(has(box.wait_for("\"state\":\"tracking\"", kLong), "\"tracking\"")) << box.said();

  const Answered full = box.ask({"record"});

  EXPECT_EQ(full.status, 1) << full.out;
  EXPECT_TRUE(has(full.err, "File too large")) << full.err;
  std::string status = box.ask({"status", "--json"}).out;
  EXPECT_EQ(number_in(status, "recorder", "failed"), 1) << status;
  EXPECT_EQ(number_in(status, "recorder", "written"), 0) << status;
  EXPECT_TRUE(has(status, "\"state\":\"tracking\"")) << "nothing else noticed: " << status;
  EXPECT_TRUE(has(box.ask({"self-test"}).out, "disk      bad"));
  EXPECT_EQ(count_endings(box, ".part") + count_endings(box, ".y4m"), 0) << "nothing of it stays";

  disk.free(box.process());
  const Answered free = box.ask({"record"});

  EXPECT_EQ(free.status, 0) << free.err;
  status = box.ask({"status", "--json"}).out;
  EXPECT_EQ(number_in(status, "recorder", "written"), 1) << status;
  EXPECT_TRUE(has(box.ask({"self-test"}).out, "disk      good")) << status;
  EXPECT_EQ(count_endings(box, ".y4m"), 1);
}

TEST(BoxFaults, ASourceThatGoesIsToldCountedAndOpenedAgain) {
  const std::string shipped = TUBESIGHT_TEST_DATA_DIR "/recordings/square_flush/";
  Daemon box;
  const std::string recording = box.folder().path("recording.y4m.xz");
  std::filesystem::copy_file(shipped + "recording.y4m.xz", recording);
  box.folder().write("box.toml", "include = [\"" + shipped +
                                     "session.toml\"]\n[control]\nsocket = \"box\"\n[source]\n"
                                     "kind = \"replay\"\nrecording = \"recording.y4m.xz\"\n");
  ASSERT_TRUE(box.start_and_wait()) << box.said();
  ASSERT_TRUE(has(box.wait_for("\"state\":\"playing\"", kLong), "\"playing\"")) << box.said();

  std::filesystem::rename(recording, recording + ".away");

  std::string status = box.wait_for("\"state\":\"failed\"", kLong);
  EXPECT_GE(number_in(status, "source", "failures"), 1) << status;
  EXPECT_TRUE(has(box.ask({"self-test"}).out, "source    bad"));
  const std::int64_t missing = number_in(status, "counters", "missing");
  EXPECT_TRUE(has(box.said(), "recording.y4m.xz: cannot be read")) << box.said();
  std::filesystem::rename(recording + ".away", recording);
  status = box.wait_for("\"state\":\"playing\"", kLong);
  EXPECT_TRUE(has(status, "\"state\":\"playing\"")) << status;
  EXPECT_GT(number_in(status, "counters", "missing"), missing) << "steps went on without fields";
}

TEST(BoxFaults, ASecondBoxDoesNotGetTheLineOfTheFirst) {
  const PtyPair line;
  Daemon first;
  Daemon second;
  const std::string link =
      "[link]\nkind = \"modbus\"\nbaud = 115200\nparity = \"none\"\ndevice = \"" +
      line.box.device() + "\"\n";
  first.write_simulated_settings(link);
  second.write_simulated_settings(link);
  ASSERT_TRUE(first.start_and_wait()) << first.said();
  ASSERT_TRUE(second.start_and_wait()) << second.said();
  EXPECT_TRUE(has(second.said(), ": Device or resource busy; the box goes on")) << second.said();
  const Answered run = run_robot(line.robot.device(), "1");
  EXPECT_GT(count(run.out, "40,60 AGREE tube 40,60"), 5) << run.out << run.err;

  first.signal(SIGKILL);
  ASSERT_EQ(first.wait_for_end(kLong), -1);

  EXPECT_TRUE(has(second.wait_for("\"open\":true", kLong), "\"open\":true")) << second.said();
  const Answered other = run_robot(line.robot.device(), "0");
  EXPECT_TRUE(has(other.out, ", tube -, not vouched for\n"))
      << "it waits for a start: " << other.out;
}

}  // namespace
}  // namespace tubesight::tests
