// The robot's link without its line: bytes, silences, answers of the box and time passing, in any
// order. Whatever comes, each request gets one answer of the protocol's form, and AGREE is read
// only for the latest claim, with its id, after the box has vouched for just that tube.
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <span>

#include "drivers/modbus/dialogue.h"
#include "drivers/modbus/request_handler.h"
#include "drivers/modbus/rtu_framer.h"
#include "drivers/modbus/tcp_framer.h"

namespace {

using namespace tubesight;
using namespace tubesight::drivers;

void require(bool holds) {
  if (!holds) {
    std::abort();
  }
}

/// A claim that the loop has taken.
struct Taken {
  std::int64_t ticket = 0;
  core::Claim claim;
  bool confirmed = false;
};

class Bench {
 public:
  void feed_serial(std::uint8_t byte) {
    framer_.append(byte);
    for (Found found = framer_.next(); found != Found::kNothing; found = framer_.next()) {
      take(found);
    }
  }
  void silence() { take(framer_.silence()); }

  void feed_tcp(std::uint8_t byte) {
    if (broken_) {
      return;
    }
    tcp_.append(byte);
    const TcpFramer::Found found = tcp_.next();
    broken_ = found == TcpFramer::Found::kBroken;
    if (found == TcpFramer::Found::kRequest) {
      Pdu answer;
      request(tcp_.request(), answer);
      TcpFrame frame;
      tcp_.wrap(answer.view(), frame);
      require(frame.size() == kTcpHeadBytes + answer.size());
    }
  }

  /// A frame with a sound check sum, so that the handler is reached.
  void feed_frame(std::span<const std::uint8_t> pdu) {
    RtuFrame frame;
    RtuFramer::wrap(kUnit, pdu, frame);
    for (const std::uint8_t byte : frame) {
      feed_serial(byte);
    }
  }

  /// The box answers the event that waits longest, or an old one again.
  void reply(std::uint8_t how) {
    core::Event event;
    if (events_.try_pop(event)) {
      if (const auto* const claim = core::content_if<core::Claim>(event)) {
        taken_ = {event.id, *claim, false};
      }
      last_id_ = event.id;
    }
    core::Reply told;
    told.id = how % 3 == 2 ? last_id_ - (std::int64_t{1} << 32) : last_id_;
    const auto verdict = static_cast<core::ClaimVerdict>(how / 3 % 3);
    const core::TubeAddress tube = how % 5 == 0 ? core::TubeAddress{1, 1} : taken_.claim.tube;
    switch (how / 9 % 6) {
      case 0: told.content = core::StartReply{}; break;
      case 1: told.content = core::PickReply{}; break;
      case 2: told.content = core::LampReply{500}; break;
      case 3: told.content = core::PoseReply{}; break;
      default:
        told.content = core::ClaimReply{tube, verdict, core::ClaimDoubt::kNone, tube, 7};
        if (told.id == taken_.ticket && tube == taken_.claim.tube) {
          taken_.confirmed = taken_.confirmed || verdict == core::ClaimVerdict::kConfirmed;
        }
    }
    dialogue_.hear(told, now_);
  }

  void pass(std::uint8_t milliseconds) { now_ += std::chrono::milliseconds(milliseconds); }

  void check() {
    Pdu answer;
    const std::array<std::uint8_t, 5> ask{3, 0, 200, 0, 24};
    request(ask, answer);
    require(answer.size() == 50);
    if (word(answer, 205) != 1) {
      return;
    }
    require(taken_.confirmed && dialogue_.claims_taken() > 0);
    require((word(answer, 204) & 3) == 3);
    require(number(answer, 208) == static_cast<std::int32_t>(taken_.ticket & 0xFFFFFFFF));
    require(number(answer, 210) == taken_.claim.tube.row);
    require(number(answer, 212) == taken_.claim.tube.column);
    require(number(answer, 214) == taken_.claim.tube.row);
  }

 private:
  static constexpr std::uint8_t kUnit = 17;

  static std::int32_t word(const Pdu& answer, std::int32_t address) {
    const std::int32_t at = 2 + 2 * (address - 200);
    return answer[at] << 8 | answer[at + 1];
  }
  static std::int32_t number(const Pdu& answer, std::int32_t address) {
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(word(answer, address)) << 16 |
                                     static_cast<std::uint32_t>(word(answer, address + 1)));
  }

  void take(Found found) {
    if (found == Found::kNothing) {
      return;
    }
    require(!framer_.request().empty());
    Pdu answer;
    request(framer_.request(), answer);
    RtuFrame frame;
    RtuFramer::wrap(kUnit, answer.view(), frame);
  }

  void request(std::span<const std::uint8_t> pdu, Pdu& answer) {
    const std::uint8_t function = pdu.front();
    const auto outcome = handler_.take(pdu, now_, answer);
    if (outcome == RequestHandler::Outcome::kWaits) {
      require(function == 23 && dialogue_.claim_waits());
      handler_.finish(now_, answer);
    }
    require(answer.size() >= 2);
    if (outcome == RequestHandler::Outcome::kRefused) {
      require(answer.size() == 2 && answer[0] == (function | 0x80));
      require(answer[1] == 1 || answer[1] == 2 || answer[1] == 3 || answer[1] == 6);
    } else {
      require(answer[0] == function);
    }
  }

  LinkState state_{
      .identity = {}, .sighting = {}, .sequence = 0, .health = {}, .self_test = {}, .counters = {}};
  EventQueue events_;
  Outbox outbox_{events_};
  Dialogue dialogue_{WordOrder::kHighFirst, state_, outbox_};
  RequestHandler handler_{dialogue_};
  RtuFramer framer_{kUnit, state_.counters};
  TcpFramer tcp_;
  bool broken_ = false;
  core::FieldTime now_ = std::chrono::seconds(10);
  Taken taken_;
  std::int64_t last_id_ = 0;
};

}  // namespace

/// The input: an operation, a length, so many bytes, and so on.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bench bench;
  std::span<const std::uint8_t> left(data, size);
  while (left.size() >= 2) {
    const std::uint8_t operation = left[0];
    const std::size_t length = std::min<std::size_t>(left[1], left.size() - 2);
    const auto bytes = left.subspan(2, length);
    left = left.subspan(2 + length);
    switch (operation % 6) {
      case 0:
        for (const std::uint8_t byte : bytes) {
          bench.feed_serial(byte);
        }
        break;
      case 1: bench.silence(); break;
      case 2:
        for (const std::uint8_t byte : bytes) {
          bench.reply(byte);
        }
        break;
      case 3: bench.pass(static_cast<std::uint8_t>(length)); break;
      case 4:
        for (const std::uint8_t byte : bytes) {
          bench.feed_tcp(byte);
        }
        break;
      default:
        if (!bytes.empty() && bytes.size() <= kMostPduBytes) {
          bench.feed_frame(bytes);
        }
    }
    bench.check();
  }
  return 0;
}
