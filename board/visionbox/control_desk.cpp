#include "board/visionbox/control_desk.h"

#include <algorithm>
#include <chrono>
#include <utility>
#include <variant>

#include "board/visionbox/control_protocol.h"

namespace tubesight::board {
namespace {

/// The tracking thread answers after the next field; this is many of them.
constexpr MonotonicTime kPatience = std::chrono::seconds(2);

/// The fields that a recording goes on for, and a slow disk.
constexpr MonotonicTime kRecordingPatience = std::chrono::seconds(60);

constexpr std::string_view kRecord = "record";

/// Who waits for an answer of one kind: several of each client that has room. Those who asked and
/// went away wait, too, and are not to fill the memory of a box whose tracking stands still.
constexpr std::size_t kMostWaiting = 64;
constexpr std::string_view kTooMuch = "the box has too much to do, ask again";

}  // namespace

std::optional<std::string> ControlDesk::handle(drivers::ControlClient client,
                                               std::string_view line) {
  ControlRequest request = parse_request(line, *start_);
  if (const auto* const wrong = std::get_if<WrongRequest>(&request.content)) {
    return refusal_answer(request.command, wrong->error);
  }
  if (std::holds_alternative<StatusRequest>(request.content)) {
    return status_answer(report_());
  }
  if (std::holds_alternative<SelfTestRequest>(request.content)) {
    return self_test_answer(report_());
  }
  auto* const asked = std::get_if<EventRequest>(&request.content);
  if (asked == nullptr) {
    return record(client);
  }
  asked->event.id = next_id_++;
  if (waiting_.size() >= kMostWaiting || !box_->station().submit(asked->event)) {
    return refusal_answer(request.command, kTooMuch);
  }
  waiting_.push_back({asked->event.id, client, std::move(request.command), monotonic_now()});
  return {};
}

std::optional<std::string> ControlDesk::record(drivers::ControlClient client) {
  if (!box_->records()) {
    return refusal_answer(kRecord, "nothing is recorded: the settings have no [record]");
  }
  if (recordings_.size() >= kMostWaiting) {
    return refusal_answer(kRecord, kTooMuch);
  }
  recordings_.push_back({box_->request_recording(), client, monotonic_now()});
  return {};
}

void ControlDesk::serve_replies(drivers::ControlServer& server, MonotonicTime now) {
  serve_events(server, now);
  serve_recordings(server, now);
}

void ControlDesk::serve_recordings(drivers::ControlServer& server, MonotonicTime now) {
  std::erase_if(recordings_, [&](const Recording& each) {
    const RecordAnswer answer = box_->record_answer(each.number);
    if (answer.state == RecordAnswer::State::kWritten) {
      server.answer(each.client, recorded_answer(answer.words));
    } else if (answer.state != RecordAnswer::State::kPending) {
      server.answer(each.client, refusal_answer(kRecord, answer.words));
    } else if (now - each.since > kRecordingPatience) {
      server.answer(each.client, refusal_answer(kRecord, "not written yet, status will tell"));
    } else {
      return false;
    }
    return true;
  });
}

void ControlDesk::serve_events(drivers::ControlServer& server, MonotonicTime now) {
  while (const auto reply = box_->station().take_reply()) {
    const auto found = std::find_if(waiting_.begin(), waiting_.end(),
                                    [&](const Waiting& each) { return each.id == reply->id; });
    if (found != waiting_.end()) {
      server.answer(found->client, reply_answer(found->command, *reply));
      waiting_.erase(found);
    }
  }
  std::erase_if(waiting_, [&](const Waiting& each) {
    const bool late = now - each.since > kPatience;
    if (late) {
      server.answer(each.client, refusal_answer(each.command, "the box did not answer in time"));
    }
    return late;
  });
}

}  // namespace tubesight::board
