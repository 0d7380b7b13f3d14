#include "drivers/control/control_server.h"

#include <array>
#include <cerrno>
#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include "drivers/control/socket_address.h"
#include "tests/support/temporary_folder.h"

namespace tubesight::drivers {
namespace {

/// Answers each line with itself in brackets; "later" gets its answer when the test says so.
class Echo final : public ControlHandler {
 public:
  std::optional<std::string> handle(ControlClient client, std::string_view line) override {
    lines.emplace_back(line);
    if (line == "later") {
      later.push_back(client);
      return {};
    }
    return "[" + std::string(line) + "]";
  }
  std::vector<std::string> lines;
  std::vector<ControlClient> later;
};

class Client {
 public:
  explicit Client(const std::string& path) : fd_(connect_to(path)) {}
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;
  ~Client() { leave(); }

  void say(const std::string& text) const {
    EXPECT_EQ(send(fd_, text.data(), text.size(), MSG_NOSIGNAL), static_cast<ssize_t>(text.size()));
  }
  /// What has come; "gone" at its end when the server has closed.
  std::string hear() const {
    std::string text;
    std::array<char, 4096> bytes;
    ssize_t got = 0;
    while ((got = recv(fd_, bytes.data(), bytes.size(), MSG_DONTWAIT)) > 0) {
      text.append(bytes.data(), static_cast<std::size_t>(got));
    }
    // What he said and nobody read makes a reset of the end.
    return got == 0 || errno == ECONNRESET ? text + "gone" : text;
  }
  void finish() const { shutdown(fd_, SHUT_WR); }
  void leave() {
    if (fd_ >= 0) {
      close(std::exchange(fd_, -1));
    }
  }

 private:
  int fd_;
};

class ControlServerTest : public ::testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(server_.start(path_)) << server_.message(); }
  void serve() {
    for (int i = 0; i < 40; ++i) {
      server_.serve(std::chrono::milliseconds(0));
    }
  }

  support::TemporaryFolder folder_;
  std::string path_ = folder_.path("box");
  Echo echo_;
  ControlServer server_{echo_};
};

TEST_F(ControlServerTest, AnswersEachLineInTurn) {
  const Client client(path_);
  client.say("one\ntwo\r\nthr");
  serve();
  EXPECT_EQ(client.hear(), "[one]\n[two]\n");

  client.say("ee\n\n");
  serve();
  EXPECT_EQ(client.hear(), "[three]\n[]\n");
}

TEST_F(ControlServerTest, AnswersThatComeLaterKeepTheOrder) {
  const Client client(path_);
  const Client other(path_);
  client.say("later\nafter\n");
  serve();
  ASSERT_EQ(echo_.later.size(), 1U);
  EXPECT_EQ(client.hear(), "");
  other.say("meanwhile\n");
  serve();
  EXPECT_EQ(other.hear(), "[meanwhile]\n");

  server_.answer(echo_.later[0], "now");
  serve();

  EXPECT_EQ(client.hear(), "now\n[after]\n");
  EXPECT_EQ(other.hear(), "");
}

TEST_F(ControlServerTest, AnAnswerForOneWhoHasGoneIsForNobody) {
  auto client = std::make_unique<Client>(path_);
  client->say("later\n");
  serve();
  ASSERT_EQ(echo_.later.size(), 1U);
  client.reset();
  serve();

  server_.answer(echo_.later[0], "now");
  serve();

  EXPECT_EQ(server_.clients(), 0U);
  const Client next(path_);
  serve();
  EXPECT_EQ(next.hear(), "");
}

TEST_F(ControlServerTest, WhoClosesIsStillAnswered) {
  const Client client(path_);
  client.say("one\ntwo\n");
  client.finish();
  serve();

  EXPECT_EQ(client.hear(), "[one]\n[two]\ngone");
  EXPECT_EQ(server_.clients(), 0U);
}

TEST_F(ControlServerTest, SendsAwayWhoNeverEndsHisLine) {
  const Client garbage(path_);
  const Client sound(path_);
  garbage.say(std::string(5000, '\xff'));
  sound.say("status\n");
  serve();

  EXPECT_EQ(garbage.hear(),
            "{\"ok\":false,\"error\":\"line too long, expected at most 1024 bytes\"}\ngone");
  EXPECT_EQ(sound.hear(), "[status]\n");
  EXPECT_EQ(server_.sent_away(), 1);
}

TEST_F(ControlServerTest, SendsAwayWhoDoesNotReadHisAnswers) {
  const Client deaf(path_);
  const Client sound(path_);
  const std::string many(1000, 'x');
  for (int i = 0; i < 5000 && server_.sent_away() == 0; ++i) {
    deaf.say(many + "\n");
    serve();
  }
  sound.say("status\n");
  serve();

  EXPECT_EQ(server_.sent_away(), 1);
  EXPECT_EQ(sound.hear(), "[status]\n");
  EXPECT_EQ(server_.clients(), 1U);
}

TEST_F(ControlServerTest, TheOneSilentLongestMakesRoom) {
  std::vector<std::unique_ptr<Client>> clients;
  for (std::size_t i = 0; i < ControlServer::kMostClients; ++i) {
    clients.push_back(std::make_unique<Client>(path_));
    serve();
  }
  clients.front()->say("I am here\n");
  serve();
  const Client late(path_);
  late.say("me too\n");
  serve();
  serve();

  EXPECT_EQ(late.hear(), "[me too]\n");
  EXPECT_EQ(clients[0]->hear(), "[I am here]\n");
  EXPECT_TRUE(clients[1]->hear().ends_with("gone"));
  EXPECT_EQ(server_.clients(), ControlServer::kMostClients);
}

TEST_F(ControlServerTest, SaysWhenTheOtherDescriptorIsReady) {
  std::array<int, 2> ends{};
  ASSERT_EQ(pipe(ends.data()), 0);
  EXPECT_FALSE(server_.serve(std::chrono::milliseconds(0), ends[0]));
  ASSERT_EQ(write(ends[1], "x", 1), 1);

  EXPECT_TRUE(server_.serve(std::chrono::milliseconds(1000), ends[0]));

  close(ends[0]);
  close(ends[1]);
}

}  // namespace
}  // namespace tubesight::drivers
