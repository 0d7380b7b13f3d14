#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "board/visionbox/box_report.h"
#include "board/visionbox/box_settings.h"
#include "board/visionbox/journal_writer.h"
#include "board/visionbox/page_access.h"
#include "board/visionbox/page_errands.h"
#include "board/visionbox/page_gallery.h"
#include "board/visionbox/page_history.h"
#include "board/visionbox/page_json.h"
#include "board/visionbox/page_listeners.h"
#include "board/visionbox/picture_hub.h"
#include "board/visionbox/side_jobs.h"
#include "board/visionbox/wakeup.h"
#include "core/base/event.h"
#include "core/base/snapshot.h"
#include "drivers/control/socket_station.h"
#include "drivers/web/page_server.h"
#include "hal/clock.h"

namespace tubesight::board {

/// The operator's page: answers its questions, carries what a person does to the tracking thread,
/// and tells everybody what happens (docs/page.md).
///
/// Three threads of little priority: the server's, one for pictures and answers, one for what takes
/// long. None of them holds anything that the tracking thread waits for.
class PageDesk final : public drivers::PageHandler {
 public:
  /// What the desk has to do with the box; all outlive it.
  struct Box {
    const BoxSettings* settings = nullptr;
    drivers::SocketStation* station = nullptr;  ///< of the page alone
    PictureTap* tap = nullptr;
    const core::Snapshot<OverlaySnapshot>* marks = nullptr;
    const hal::Clock* clock = nullptr;  ///< that stamps fields
    JournalWriter* journal = nullptr;   ///< null: none is kept
    /// Asks for a recording, its number; empty: there is no recorder.
    std::function<std::uint32_t()> request_recording;
    std::function<RecordAnswer(std::uint32_t)> record_answer;
  };
  using Tell = std::function<void(const std::string&)>;

  /// Ids of the page's events begin here, beyond those of the control socket.
  static constexpr std::int64_t kFirstId = PageErrands::kFirstId;

  PageDesk(Box box, Tell tell);
  PageDesk(const PageDesk&) = delete;
  PageDesk& operator=(const PageDesk&) = delete;
  ~PageDesk() { stop(); }

  /// Serves from now on. False: it cannot be, which was told; the box goes on without.
  [[nodiscard]] bool start();
  void stop();

  /// How the box is doing. The thread that serves the box.
  void look(const BoxReport& report);

  [[nodiscard]] std::optional<drivers::PageAnswer> refuse(const drivers::PageRequest& request,
                                                          std::uint64_t body_bytes) override;
  [[nodiscard]] std::size_t most_body_bytes(const drivers::PageRequest& request) const override;
  [[nodiscard]] std::optional<drivers::PageAnswer> handle(
      const drivers::PageRequest& request, const std::shared_ptr<drivers::PageCall>& call) override;

 private:
  using Request = drivers::PageRequest;
  using Answer = std::optional<drivers::PageAnswer>;  ///< empty: later
  using Call = std::shared_ptr<drivers::PageCall>;
  using Picture = PictureHub::Picture;

  // Questions, by path.
  [[nodiscard]] Answer answer_get(const Request& request, const Call& call);
  [[nodiscard]] Answer answer_post(const Request& request, const Call& call, const Json& body);
  [[nodiscard]] Answer session(const Request& request);
  [[nodiscard]] Answer log_in(const Request& request, const Call& call, const Json& body);
  [[nodiscard]] Answer log_out(const Request& request);
  [[nodiscard]] Answer operate(const Request& request, const Json& body);
  [[nodiscard]] Answer frame(const Request& request, const Call& call);
  [[nodiscard]] Answer events(const Request& request, const Call& call);
  [[nodiscard]] Answer freeze(const Request& request, const Call& call);
  [[nodiscard]] Answer frozen(const Request& request);
  [[nodiscard]] Answer lattice(const Request& request, const Call& call);
  [[nodiscard]] Answer begin(const Request& request, const Call& call, const Json& body);
  [[nodiscard]] Answer pick(const Request& request, const Call& call, const Json& body);
  [[nodiscard]] Answer lamp(const Request& request, const Call& call, const Json& body);
  [[nodiscard]] Answer acknowledge(const Json& body);
  [[nodiscard]] Answer disagreement_frame(const Request& request);
  [[nodiscard]] Answer self_test_answer();
  [[nodiscard]] Answer record(const Call& call);
  [[nodiscard]] Answer recordings() const;
  [[nodiscard]] Answer recording(const Request& request) const;
  [[nodiscard]] Answer settings(const Request& request) const;
  [[nodiscard]] Answer change_settings(const Request& request, const Call& call, const Json& body);

  [[nodiscard]] Json session_json(const std::string& cookie, MonotonicTime now);
  [[nodiscard]] Json operator_json(const std::string& cookie, MonotonicTime now);
  [[nodiscard]] PageSurroundings surroundings();
  [[nodiscard]] bool tracks() const;
  [[nodiscard]] Answer errand(const Request& request, const Call& call,
                              const decltype(core::Event::content)& content);

  // The thread of pictures and answers.
  void run();
  void follow(MonotonicTime now);
  void tell_listeners(MonotonicTime now);
  void tell_operators(MonotonicTime now);

  Box box_;
  Tell tell_;
  drivers::PageServer server_{*this};
  std::unique_ptr<PageAccess> access_;
  PictureHub hub_;
  FrozenPictures frozen_;
  SideJobs jobs_;
  std::string sheet_;
  std::thread thread_;
  std::atomic<bool> stopping_{false};
  Wakeup wakeup_;

  std::mutex mutex_;  ///< of all below
  BoxReport report_;
  bool reported_ = false;
  PageErrands errands_;
  PageListeners listeners_;
  std::string told_operator_;  ///< session that operated when it was told last
  PageHistory history_;
  std::optional<core::ClaimReply> told_claim_;
  MonotonicTime followed_at_{0};
  MonotonicTime told_status_at_{0};
  MonotonicTime beat_at_{0};
};

}  // namespace tubesight::board
