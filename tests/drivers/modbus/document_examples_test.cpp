// Replays the bytes of docs/robot-link.md: what the document shows is what the box answers.

#include <fstream>
#include <sstream>
#include <string>

#include "drivers/modbus/rtu_framer.h"
#include "drivers/modbus/tcp_framer.h"
#include "tests/drivers/modbus/link_bench.h"
#include "tests/drivers/modbus/serial_robot.h"

namespace tubesight::drivers {
namespace {

using tests::Bytes;

constexpr std::uint8_t kUnit = 17;

Bytes bytes_in(const std::string& line) {
  Bytes bytes;
  std::istringstream words(line);
  for (std::string word; words >> word;) {
    bytes.push_back(static_cast<std::uint8_t>(std::stoi(word, nullptr, 16)));
  }
  return bytes;
}

/// What that box knows of the robot's zones.
class ExampleZones final : public ZoneCorrections {
 public:
  bool at(core::TubeAddress tube, ZoneAnswer& answer) const override {
    answer = {{800'000, -400'000, 1'200'000}, 100'000, 250'000};
    return tube == core::TubeAddress{40, 60};
  }
};

/// The box of the document's examples, whose answers are those of a quick loop.
class ExampleBox {
 public:
  ExampleBox() { bench_.state.identity.zones = &zones_; }
  Bytes answer(const Bytes& sent, bool tcp) { return tcp ? answer_tcp(sent) : answer_serial(sent); }

 private:
  Bytes answer_serial(const Bytes& sent) {
    for (const std::uint8_t byte : sent) {
      framer_.append(byte);
      if (framer_.next() == Found::kRequest) {
        Pdu pdu;
        handle(framer_.request(), pdu);
        RtuFrame frame;
        RtuFramer::wrap(kUnit, pdu.view(), frame);
        return {frame.begin(), frame.end()};
      }
    }
    return {};
  }
  Bytes answer_tcp(const Bytes& sent) {
    TcpFramer framer;
    for (const std::uint8_t byte : sent) {
      framer.append(byte);
      if (framer.next() == TcpFramer::Found::kRequest) {
        Pdu pdu;
        handle(framer.request(), pdu);
        TcpFrame frame;
        framer.wrap(pdu.view(), frame);
        return {frame.begin(), frame.end()};
      }
    }
    return {};
  }

  void handle(std::span<const std::uint8_t> request, Pdu& answer) {
    const auto outcome = bench_.handler.take(request, bench_.now, answer);
    for (core::Event event = bench_.take_event(); event.id != 0; event = bench_.take_event()) {
      std::visit(
          core::Overloaded{[&](const core::Claim& claim) {
                             const core::TubeAddress seen{12, -7};
                             bench_.reply(event.id,
                                          core::ClaimReply{claim.tube,
                                                           claim.tube == seen
                                                               ? core::ClaimVerdict::kConfirmed
                                                               : core::ClaimVerdict::kContradicted,
                                                           core::ClaimDoubt::kNone, seen, 3601});
                           },
                           [&](const core::Start&) { bench_.reply(event.id, core::StartReply{}); },
                           [&](const core::Pick&) {
                             bench_.reply(event.id, core::PickReply{{}, {13, -6}});
                           },
                           [&](const core::LampCommand& lamp) {
                             bench_.reply(event.id, core::LampReply{lamp.permille});
                           },
                           [](const auto&) {}},
          event.content);
    }
    if (outcome == RequestHandler::Outcome::kWaits) {
      bench_.handler.finish(bench_.now, answer);
    }
  }

  ExampleZones zones_;
  tests::LinkBench bench_;
  RtuFramer framer_{kUnit, bench_.state.counters};
};

TEST(DocumentExamples, AreWhatTheBoxAnswers) {
  std::ifstream file(TUBESIGHT_SOURCE_DIR "/docs/robot-link.md");
  ASSERT_TRUE(file);
  ExampleBox box;
  Bytes sent;
  Bytes answer;
  bool tcp = false;
  int answers = 0;
  bool reading = false;  // the lines of an answer
  const auto compare = [&] {
    if (reading) {
      const Bytes expected = box.answer(sent, tcp);
      std::ostringstream hex;
      for (const std::uint8_t byte : expected) {
        hex << std::uppercase << std::hex << (byte < 16 ? "0" : "") << int{byte} << ' ';
      }
      EXPECT_EQ(answer, expected) << "answer " << answers + 1 << ": " << hex.str();
      ++answers;
      reading = false;
    }
  };

  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("```")) {
      compare();
      tcp = line == "```tcp";
    } else if (line.starts_with("> ")) {
      compare();
      sent = bytes_in(line.substr(2));
    } else if (line.starts_with("< ")) {
      reading = true;
      answer = bytes_in(line.substr(2));
    } else if (line.starts_with("+ ")) {  // goes on
      const Bytes more = bytes_in(line.substr(2));
      Bytes& whole = reading ? answer : sent;
      whole.insert(whole.end(), more.begin(), more.end());
    }
  }

  EXPECT_EQ(answers, 15);
}

}  // namespace
}  // namespace tubesight::drivers
