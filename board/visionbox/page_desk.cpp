#include "board/visionbox/page_desk.h"

#include <utility>

#include "board/visionbox/page_numbers.h"
#include "board/visionbox/page_time.h"
#include "drivers/web/page_files.h"

namespace tubesight::board {
namespace {

using drivers::PageAnswer;
using drivers::PageRole;

constexpr std::size_t kMostBody = std::size_t{64} * 1024;
constexpr std::size_t kMostSettings = std::size_t{1024} * 1024;

void be_modest(const char* name) {
  name_this_thread(name);
  schedule_behind_others();
}

}  // namespace

PageDesk::PageDesk(Box box, Tell tell)
    : box_(std::move(box)),
      tell_(std::move(tell)),
      hub_(*box_.tap, box_.settings->told().camera.width_px,
           box_.settings->told().camera.height_px),
      errands_(*box_.station, box_.settings->told().tubesheet, box_.request_recording,
               box_.record_answer) {
  history_.know_sheet(box_.settings->told().tubesheet);
  sheet_ = text(sheet_json(box_.settings->told().tubesheet));
}

bool PageDesk::start() {
  const PageSettings& settings = box_.settings->page;
  stopping_ = false;
  access_ = std::make_unique<PageAccess>(settings, settings.server.port);
  if (!server_.start(settings.server)) {
    tell_(server_.message());
    return false;
  }
  thread_ = std::thread([this] { run(); });
  jobs_.start([] { be_modest("page-jobs"); });
  tell_("page: " + access_->names().link() +
        (settings.fingerprint.empty() ? "" : ", certificate " + settings.fingerprint));
  return true;
}

void PageDesk::stop() {
  stopping_ = true;
  wakeup_.wake();
  if (thread_.joinable()) {
    thread_.join();
  }
  jobs_.stop();
  server_.stop();
}

void PageDesk::look(const BoxReport& report) {
  const std::lock_guard lock(mutex_);
  report_ = report;
  reported_ = true;
}

std::optional<PageAnswer> PageDesk::refuse(const Request& request, std::uint64_t /*body_bytes*/) {
  const std::lock_guard lock(mutex_);
  return access_->refuse(request, monotonic_now());
}

std::size_t PageDesk::most_body_bytes(const Request& request) const {
  return request.path.starts_with("/api/settings") ? kMostSettings : kMostBody;
}

PageDesk::Answer PageDesk::handle(const Request& request, const Call& call) {
  if (!request.path.starts_with("/api/")) {
    const auto file = drivers::page_file(request.path);
    if (!file) {
      return error_answer(404, "there is no such thing here");
    }
    PageAnswer answer;
    answer.type = file->type;
    answer.body = std::make_shared<const std::string>(file->bytes);
    answer.headers.emplace_back("Cache-Control", "no-cache");
    return answer;
  }
  if (request.method == "GET") {
    return answer_get(request, call);
  }
  const Json body = Json::parse(request.body, nullptr, false);
  if (!body.is_object()) {
    return error_answer(400, "expected a JSON object");
  }
  return answer_post(request, call, body);
}

PageDesk::Answer PageDesk::answer_get(const Request& request, const Call& call) {
  const std::string& path = request.path;
  if (path == "/api/session") {
    return session(request);
  }
  if (path == "/api/frame") {
    return frame(request, call);
  }
  if (path == "/api/events") {
    return events(request, call);
  }
  if (path == "/api/frozen") {
    return frozen(request);
  }
  if (path == "/api/lattice") {
    return lattice(request, call);
  }
  if (path == "/api/sheet") {
    PageAnswer answer;
    answer.body = std::make_shared<const std::string>(sheet_);
    return answer;
  }
  if (path == "/api/recordings") {
    return recordings();
  }
  if (path.starts_with("/api/recordings/")) {
    return recording(request);
  }
  if (path == "/api/settings" || path == "/api/backup") {
    return settings(request);
  }
  const std::lock_guard lock(mutex_);
  if (path == "/api/status") {
    if (!reported_) {
      return error_answer(503, "the box has just been started");
    }
    PageAnswer answer;
    answer.body = std::make_shared<const std::string>(status_answer(report_));
    return answer;
  }
  if (path == "/api/visits") {
    return json_answer(history_.visits());
  }
  if (path == "/api/disagreements") {
    return json_answer(history_.disagreements());
  }
  return disagreement_frame(request);
}

PageDesk::Answer PageDesk::answer_post(const Request& request, const Call& call, const Json& body) {
  const std::string& path = request.path;
  if (path == "/api/login") {
    return log_in(request, call, body);
  }
  if (path == "/api/logout") {
    return log_out(request);
  }
  if (path == "/api/operator") {
    return operate(request, body);
  }
  if (path == "/api/freeze") {
    return freeze(request, call);
  }
  if (path == "/api/start") {
    return begin(request, call, body);
  }
  if (path == "/api/pick") {
    return pick(request, call, body);
  }
  if (path == "/api/lamp") {
    return lamp(request, call, body);
  }
  if (path == "/api/acknowledge") {
    return acknowledge(body);
  }
  if (path == "/api/self-test") {
    return self_test_answer();
  }
  if (path == "/api/record") {
    return record(call);
  }
  if (path == "/api/settings" || path == "/api/settings/check") {
    return change_settings(request, call, body);
  }
  return error_answer(501, "this box does not serve that: change it in the settings");
}

void PageDesk::run() {
  be_modest("page-pictures");
  constexpr MonotonicTime kLooking = std::chrono::milliseconds(4);
  constexpr MonotonicTime kIdle = std::chrono::milliseconds(100);
  while (!stopping_) {
    const MonotonicTime now = monotonic_now();
    const bool looked_at = hub_.serve(now);
    bool waits = false;
    {
      const std::lock_guard lock(mutex_);
      errands_.serve(now);
      follow(now);
      tell_listeners(now);
      waits = errands_.busy();
    }
    wakeup_.wait_until(now + (looked_at || waits ? kLooking : kIdle));
  }
}

/// Where the tool goes, and what the robot is told.
void PageDesk::follow(MonotonicTime now) {
  constexpr MonotonicTime kOften = std::chrono::milliseconds(100);
  if (now - followed_at_ < kOften) {
    return;
  }
  followed_at_ = now;
  const auto marks = std::make_unique<OverlaySnapshot>();
  if (!box_.marks->try_read(*marks)) {
    return;
  }
  history_.take(*marks, hub_.latest());
  const std::optional<core::ClaimReply>& claim = marks->news.claim();
  const bool known = claim && told_claim_ && claim->claimed == told_claim_->claimed &&
                     claim->verdict == told_claim_->verdict && claim->field == told_claim_->field;
  if (!claim || known) {
    return;
  }
  told_claim_ = claim;
  listeners_.tell_all("reply", text(claim_json(*claim)));
  const std::int64_t disagreement =
      history_.take_claim(*claim, seconds(marks->sighting.time), wall_time_text());
  if (disagreement > 0) {
    listeners_.tell_all("disagreement", text({{"id", disagreement}}));
  }
}

void PageDesk::tell_operators(MonotonicTime now) {
  told_operator_ = access_->sessions().who_operates(now).session;
  listeners_.tell_each("operator",
                       [&](const std::string& cookie) { return text(operator_json(cookie, now)); });
}

void PageDesk::tell_listeners(MonotonicTime now) {
  constexpr MonotonicTime kStatus = std::chrono::milliseconds(500);
  constexpr MonotonicTime kBeat = std::chrono::seconds(2);
  if (now - told_status_at_ >= kStatus) {
    told_status_at_ = now;
    // Whoever listens is there; a session that has ended hears no more.
    listeners_.drop([&](const std::string& cookie) {
      const auto* const session = access_->sessions().find(cookie, now);
      return session == nullptr || session->role == PageRole::kNone;
    });
    errands_.forget(
        [&](const std::string& cookie) { return !access_->sessions().is_there(cookie); });
    if (reported_ && !listeners_.empty()) {
      listeners_.tell_all("status", status_answer(report_));
    }
    if (access_->sessions().who_operates(now).session != told_operator_) {
      tell_operators(now);
    }
  }
  if (now - beat_at_ >= kBeat) {
    beat_at_ = now;
    listeners_.beat();
  }
}

}  // namespace tubesight::board
