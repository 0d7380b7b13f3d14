#include "board/visionbox/page_errands.h"

#include <algorithm>
#include <chrono>

#include "board/visionbox/page_access.h"
#include "core/base/words.h"

namespace tubesight::board {
namespace {

/// The tracking thread answers after the next field; this is many of them.
constexpr MonotonicTime kReplyPatience = std::chrono::seconds(2);
/// The fields that a recording goes on for, and a slow disk.
constexpr MonotonicTime kRecordingPatience = std::chrono::seconds(60);
constexpr const char* kTooMuch = "the box has too much to do, ask again";
constexpr const char* kTracking = "tracking";
constexpr const char* kNumbering = "numbering";

drivers::PageAnswer warning(const char* refusal, const char* words, const char* advice) {
  return json_answer({{"taken", false},
                      {"refusal", refusal},
                      {"words", words},
                      {"advice", advice},
                      {"confirmable", true}});
}

}  // namespace

std::optional<std::int64_t> PageErrands::hand_over(const decltype(core::Event::content)& content) {
  core::Event event;
  event.origin = core::EventOrigin::kOperator;
  event.id = next_id_++;
  event.content = content;
  return station_->submit(event) ? std::optional(event.id) : std::nullopt;
}

bool PageErrands::submit(const decltype(core::Event::content)& content) {
  return hand_over(content).has_value();
}

PageErrands::Answer PageErrands::submit(const std::string& cookie, const Call& call,
                                        const decltype(core::Event::content)& content) {
  const auto id = replies_.size() < kMostWaiting ? hand_over(content) : std::nullopt;
  if (!id) {
    return error_answer(503, kTooMuch);
  }
  replies_.push_back({*id, call, cookie, monotonic_now()});
  return {};
}

PageErrands::Answer PageErrands::record(const Call& call) {
  if (!request_recording_) {
    return error_answer(409, "nothing is recorded: the settings have no [record]");
  }
  if (recordings_.size() >= kMostWaiting) {
    return error_answer(503, kTooMuch);
  }
  recordings_.push_back({request_recording_(), call, monotonic_now()});
  return {};
}

PageErrands::Answer PageErrands::warn(const std::string& cookie, bool confirmed,
                                      const StartRisks& risks) {
  std::set<std::string>& warned = warned_[cookie];
  if (!confirmed) {
    warned.clear();
  }
  if (risks.tracks && warned.insert(kTracking).second) {
    return warning(kTracking, "the box tracks already: a new start replaces what it knows",
                   "Confirm if that is what you want.");
  }
  // A lattice turned by half a turn looks the same, and its numbers would all be wrong.
  if (risks.clicked && warned.insert(kNumbering).second) {
    return warning(kNumbering, "nothing in the picture tells whether the numbers are turned",
                   "Compare a second tube-end with the plan, then confirm.");
  }
  return {};
}

bool PageErrands::was_refused(const std::string& cookie, core::StartRefusal refusal) const {
  const auto found = warned_.find(cookie);
  return found != warned_.end() && found->second.contains(std::string(core::name_of(refusal)));
}

drivers::PageAnswer PageErrands::answer_to(const std::string& cookie, const core::Reply& reply) {
  if (const auto* const start = core::content_if<core::StartReply>(reply)) {
    if (start->refusal == core::StartRefusal::kNone) {
      warned_.erase(cookie);
    } else {
      warned_[cookie].insert(std::string(core::name_of(start->refusal)));
    }
    return json_answer(start_json(*start));
  }
  if (const auto* const pick = core::content_if<core::PickReply>(reply)) {
    const auto& plugs = sheet_->plugged;
    const bool plugged = std::find(plugs.begin(), plugs.end(), pick->tube) != plugs.end();
    return json_answer(pick_json(*pick, plugged));
  }
  if (const auto* const lamp = core::content_if<core::LampReply>(reply)) {
    return json_answer({{"permille", lamp->permille}, {"automatic", lamp->automatic}});
  }
  return error_answer(501, "the box does not serve that");
}

void PageErrands::serve(MonotonicTime now) {
  while (const auto reply = station_->take_reply()) {
    const auto found = std::find_if(replies_.begin(), replies_.end(),
                                    [&](const WaitingReply& each) { return each.id == reply->id; });
    if (found != replies_.end()) {
      found->call->answer(answer_to(found->cookie, *reply));
      replies_.erase(found);
    }
  }
  std::erase_if(replies_, [&](const WaitingReply& each) {
    const bool late = now - each.since > kReplyPatience;
    if (late) {
      each.call->answer(error_answer(504, "the box did not answer in time"));
    }
    return late;
  });
  serve_recordings(now);
}

void PageErrands::serve_recordings(MonotonicTime now) {
  std::erase_if(recordings_, [&](const WaitingRecording& each) {
    const RecordAnswer answer = recording_answer_(each.number);
    if (answer.state == RecordAnswer::State::kWritten) {
      each.call->answer(json_answer({{"path", answer.words}}));
    } else if (answer.state != RecordAnswer::State::kPending) {
      each.call->answer(error_answer(409, answer.words));
    } else if (now - each.since > kRecordingPatience) {
      each.call->answer(error_answer(504, "not written yet, the status will tell"));
    } else {
      return false;
    }
    return true;
  });
}

}  // namespace tubesight::board
