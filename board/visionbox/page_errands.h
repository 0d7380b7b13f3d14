#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "board/visionbox/page_json.h"
#include "board/visionbox/recording_writer.h"
#include "board/visionbox/source_clock.h"
#include "core/base/event.h"
#include "core/base/reply.h"
#include "core/base/settings.h"
#include "drivers/control/socket_station.h"
#include "drivers/web/page_server.h"

namespace tubesight::board {

/// What people at the page ask the tracking thread and the recorder to do, until each has his
/// answer; and who was warned of what. Guarded by the caller.
class PageErrands {
 public:
  using Call = std::shared_ptr<drivers::PageCall>;
  /// Empty: the answer comes later.
  using Answer = std::optional<drivers::PageAnswer>;

  /// Asks for a recording, its number; empty: there is no recorder.
  using RequestRecording = std::function<std::uint32_t()>;
  using RecordingAnswer = std::function<RecordAnswer(std::uint32_t)>;

  /// Ids of the page's events begin here, beyond those of the control socket.
  static constexpr std::int64_t kFirstId = std::int64_t{1} << 49;

  /// `station` is of the page alone; all outlive this.
  PageErrands(drivers::SocketStation& station, const core::TubesheetSettings& sheet,
              RequestRecording request_recording, RecordingAnswer recording_answer)
      : station_(&station),
        sheet_(&sheet),
        request_recording_(std::move(request_recording)),
        recording_answer_(std::move(recording_answer)) {}

  /// Hands an event over for the session of a cookie.
  [[nodiscard]] Answer submit(const std::string& cookie, const Call& call,
                              const decltype(core::Event::content)& content);
  /// The same where nobody waits for the answer; false: there is no room.
  [[nodiscard]] bool submit(const decltype(core::Event::content)& content);

  /// Of the event that is handed over next.
  [[nodiscard]] std::int64_t next_id() const { return next_id_; }

  [[nodiscard]] Answer record(const Call& call);

  /// What somebody has to be warned of before he starts.
  struct StartRisks {
    bool tracks = false;   ///< the box knows a place already
    bool clicked = false;  ///< a person numbered the tube-ends: perhaps turned
  };
  /// Warns a session of what a start would risk, one after the other, unless it was warned of it
  /// and confirms.
  [[nodiscard]] Answer warn(const std::string& cookie, bool confirmed, const StartRisks& risks);
  /// Whether a start of this session was refused for this and nothing was started since.
  [[nodiscard]] bool was_refused(const std::string& cookie, core::StartRefusal refusal) const;
  /// Forgets what sessions were told that have ended.
  void forget(const std::function<bool(const std::string& cookie)>& ended) {
    std::erase_if(warned_, [&](const auto& each) { return ended(each.first); });
  }

  /// Hands out the answers that came, and tells whoever waits too long.
  void serve(MonotonicTime now);
  [[nodiscard]] bool busy() const { return !replies_.empty(); }

 private:
  static constexpr std::size_t kMostWaiting = 32;

  struct WaitingReply {
    std::int64_t id = 0;
    Call call;
    std::string cookie;
    MonotonicTime since{0};
  };
  struct WaitingRecording {
    std::uint32_t number = 0;
    Call call;
    MonotonicTime since{0};
  };

  [[nodiscard]] std::optional<std::int64_t> hand_over(
      const decltype(core::Event::content)& content);
  void serve_recordings(MonotonicTime now);
  [[nodiscard]] drivers::PageAnswer answer_to(const std::string& cookie, const core::Reply& reply);

  drivers::SocketStation* station_;
  const core::TubesheetSettings* sheet_;
  RequestRecording request_recording_;
  RecordingAnswer recording_answer_;
  std::vector<WaitingReply> replies_;
  std::vector<WaitingRecording> recordings_;
  std::map<std::string, std::set<std::string>> warned_;  ///< by session
  std::int64_t next_id_ = kFirstId;
};

}  // namespace tubesight::board
