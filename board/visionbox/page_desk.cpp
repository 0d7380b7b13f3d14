#include "board/visionbox/page_desk.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "board/box/version.h"
#include "board/visionbox/journal_store.h"
#include "board/visionbox/page_body.h"
#include "board/visionbox/page_lattice.h"
#include "board/visionbox/page_numbers.h"
#include "board/visionbox/page_recordings.h"
#include "board/visionbox/page_settings_text.h"
#include "board/visionbox/page_time.h"
#include "board/visionbox/report_words.h"
#include "core/base/words.h"
#include "drivers/web/page_files.h"
#include "hal/dimmer.h"

namespace tubesight::board {
namespace {

using drivers::PageAnswer;
using drivers::PageRole;

constexpr std::size_t kMostBody = std::size_t{64} * 1024;
constexpr std::size_t kMostSettings = std::size_t{1024} * 1024;
constexpr int kUsualQuality = 75;

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

// --- Who asks ---------------------------------------------------------------------------------

Json PageDesk::operator_json(const std::string& cookie, MonotonicTime now) {
  const drivers::PageSessions::Operator& holder = access_->sessions().who_operates(now);
  Json json = {{"held", !holder.session.empty()}, {"mine", access_->sessions().operates(cookie)}};
  if (!holder.session.empty()) {
    json["name"] = holder.name;
    json["since_s"] = std::round(seconds(now - holder.since));
  }
  return json;
}

Json PageDesk::session_json(const std::string& cookie, MonotonicTime now) {
  const drivers::PageSessions::Session* const session = access_->sessions().find(cookie, now);
  const core::CameraSettings& camera = box_.settings->told().camera;
  Json json;
  json["role"] = name_of(session == nullptr ? PageRole::kNone : session->role);
  json["token"] = session == nullptr ? "" : session->token;
  json["login"] = access_->asks_passwords();
  json["operator"] = operator_json(cookie, now);
  json["box"] = {{"version", program_version()},
                 {"source", name_of(box_.settings->source.kind)},
                 {"calibration", box_.settings->session.camera_quality.id}};
  if (reported_ && report_.boots.known()) {
    json["box"]["boot"] = report_.boots.words();
  }
  json["now_s"] = seconds(box_.clock->now());
  json["frame"] = {{"width", camera.width_px}, {"height", camera.height_px}};
  json["languages"] = {"en"};
  return json;
}

PageDesk::Answer PageDesk::session(const Request& request) {
  const std::lock_guard lock(mutex_);
  const MonotonicTime now = monotonic_now();
  std::string cookie;
  if (access_->sessions().find(request.cookie, now) == nullptr) {
    cookie = access_->sessions().open(
        access_->asks_passwords() ? PageRole::kNone : PageRole::kEngineer, now);
    if (cookie.empty()) {
      return error_answer(503, "too many are at the page");
    }
  }
  PageAnswer answer = json_answer(session_json(cookie.empty() ? request.cookie : cookie, now));
  answer.cookie = cookie;
  return answer;
}

PageDesk::Answer PageDesk::log_in(const Request& request, const Call& call, const Json& body) {
  const std::optional<PageRole> role = drivers::role_of(text_of(body, "role"));
  const std::string password = text_of(body, "password");
  if (!role || password.empty()) {
    return error_answer(400, "expected role and password");
  }
  const std::lock_guard lock(mutex_);
  if (!access_->asks_passwords()) {
    return json_answer(session_json(request.cookie, monotonic_now()));
  }
  const auto wait = access_->throttle().wait(request.address, monotonic_now());
  if (wait > MonotonicTime{0}) {
    const auto wait_s = static_cast<std::int64_t>(std::ceil(seconds(wait)));
    return json_answer({{"error", "too many attempts, wait"}, {"retry_after_s", wait_s}}, 403);
  }
  // Until it is known to be right it counts as wrong: attempts at once are slowed like others.
  access_->throttle().note_wrong(request.address, monotonic_now());
  const bool taken = jobs_.add([this, request, call, role, password] {
    const bool right = access_->is_right(*role, password);
    const std::lock_guard inner(mutex_);
    const MonotonicTime now = monotonic_now();
    if (!right) {
      const auto next = access_->throttle().wait(request.address, now);
      call->answer(json_answer(
          {{"error", "the password is wrong"}, {"retry_after_s", std::ceil(seconds(next))}}, 403));
      return;
    }
    access_->throttle().note_right(request.address);
    const std::string cookie = access_->sessions().renew(request.cookie, *role, now);
    if (cookie.empty()) {
      call->answer(error_answer(503, "too many are at the page"));
      return;
    }
    PageAnswer answer = json_answer(session_json(cookie, now));
    answer.cookie = cookie;
    call->answer(std::move(answer));
  });
  return taken ? Answer() : error_answer(503, "the box has too much to do, ask again");
}

PageDesk::Answer PageDesk::log_out(const Request& request) {
  const std::lock_guard lock(mutex_);
  access_->sessions().close(request.cookie);
  frozen_.drop(request.cookie);
  PageAnswer answer = json_answer(Json::object());
  answer.forget_cookie = true;
  return answer;
}

PageDesk::Answer PageDesk::operate(const Request& request, const Json& body) {
  const std::lock_guard lock(mutex_);
  const MonotonicTime now = monotonic_now();
  drivers::PageSessions& sessions = access_->sessions();
  if (!flag_of(body, "take")) {
    sessions.hand_back(request.cookie);
  } else {
    const std::string name = text_of(body, "name");
    if (name.empty()) {
      return error_answer(400, "expected the name of who operates");
    }
    if (!sessions.take_over(request.cookie, name, flag_of(body, "confirmed"), now)) {
      return json_answer({{"error", "somebody else operates the box: confirm to take over"},
                          {"held_by", sessions.who_operates(now).name}},
                         409);
    }
  }
  tell_operators(now);
  return json_answer(operator_json(request.cookie, now));
}

// --- Pictures ---------------------------------------------------------------------------------

PageSurroundings PageDesk::surroundings() {
  const std::lock_guard lock(mutex_);
  PageSurroundings around;
  around.now_s = seconds(box_.clock->now());
  if (!reported_) {
    return around;
  }
  const TrackingStatus& tracking = report_.tracking;
  around.lamp_dimmed = tracking.lamp;
  around.lamp_permille = tracking.lamp_permille;
  around.lamp_automatic = tracking.lamp_automatic;
  around.lamp_words = core::lighting::words_of(tracking.lamp_condition).meaning;
  around.link_state = !there_is_link(report_) ? "none" : report_.link.open ? "open" : "closed";
  around.link_words = link_text(report_);
  around.camera_words = report_.camera ? report_.camera->words : name_of(report_.source);
  around.fields_per_s = report_.fields_per_s;
  return around;
}

PageDesk::Answer PageDesk::frame(const Request& request, const Call& call) {
  const std::int64_t after = number_of(argument_of(request, "after")).value_or(-1);
  const int quality = static_cast<int>(
      std::clamp<std::int64_t>(number_of(argument_of(request, "quality")).value_or(kUsualQuality),
                               10, 95) /
      5 * 5);
  const MonotonicTime now = monotonic_now();
  if (argument_of(request, "estimates") == "1") {
    hub_.want_estimates(now);
  }
  const bool asked = hub_.ask(after, now, [this, call, quality](const Picture& picture) {
    if (picture == nullptr) {
      PageAnswer none;
      none.status = 204;
      call->answer(none);
      return;
    }
    call->answer(picture_answer(*picture, quality, box_.settings->told(), surroundings()));
  });
  if (!asked) {
    return error_answer(503, "too many look already");
  }
  wakeup_.wake();
  return {};
}

PageDesk::Answer PageDesk::events(const Request& request, const Call& call) {
  const std::lock_guard lock(mutex_);
  if (listeners_.full()) {
    return error_answer(503, "too many listen already");
  }
  listeners_.add(call->stream(), request.cookie);
  tell_operators(monotonic_now());
  return {};
}

PageDesk::Answer PageDesk::freeze(const Request& request, const Call& call) {
  const Picture latest = hub_.latest();
  const std::int64_t after = latest == nullptr ? -1 : latest->field();
  const std::string cookie = request.cookie;
  const bool asked = hub_.ask(after, monotonic_now(), [this, call, cookie](const Picture& picture) {
    if (picture == nullptr) {
      call->answer(error_answer(503, "no picture came"));
      return;
    }
    frozen_.keep(cookie, picture);
    call->answer(json_answer({{"field", picture->field()}}));
  });
  if (!asked) {
    return error_answer(503, "too many look already");
  }
  wakeup_.wake();
  return {};
}

PageDesk::Answer PageDesk::frozen(const Request& request) {
  const Picture picture = frozen_.of(request.cookie);
  return picture == nullptr
             ? error_answer(404, "nothing is frozen")
             : picture_answer(*picture, kUsualQuality, box_.settings->told(), surroundings());
}

PageDesk::Answer PageDesk::lattice(const Request& request, const Call& call) {
  const Picture picture = frozen_.of(request.cookie);
  if (picture == nullptr) {
    return error_answer(404, "nothing is frozen");
  }
  const bool taken = jobs_.add([this, picture, call] {
    Json json = find_page_lattice(picture->picture(), box_.settings->told());
    json["field"] = picture->field();
    call->answer(json_answer(json));
  });
  return taken ? Answer() : error_answer(503, "the box has too much to do, ask again");
}

PageDesk::Answer PageDesk::disagreement_frame(const Request& request) {
  // /api/disagreements/ID/frame?step=K
  const std::string_view rest =
      std::string_view(request.path).substr(std::string_view("/api/disagreements/").size());
  const std::size_t slash = rest.find('/');
  const auto id = number_of(rest.substr(0, slash));
  const auto step = number_of(argument_of(request, "step")).value_or(0);
  if (!id || slash == std::string_view::npos || rest.substr(slash) != "/frame" || step < 0) {
    return error_answer(404, "there is no such thing here");
  }
  const Picture picture = history_.picture(*id, static_cast<std::size_t>(step));
  if (picture == nullptr) {
    return error_answer(404, "no picture was kept of it");
  }
  PageSurroundings then;
  then.now_s = seconds(picture->marks().sighting.time);
  return picture_answer(*picture, kUsualQuality, box_.settings->told(), then);
}

// --- What a person does -----------------------------------------------------------------------

/// By the last field, not by a report that is some fields old. Where it cannot be known, it may.
bool PageDesk::tracks() const {
  const auto marks = std::make_unique<OverlaySnapshot>();
  if (!box_.marks->try_read(*marks)) {
    return box_.marks->version() > 0;
  }
  const core::TrackState state = marks->sighting.state;
  return state == core::TrackState::kTracking || state == core::TrackState::kDegraded;
}

PageDesk::Answer PageDesk::begin(const Request& request, const Call& call, const Json& body) {
  core::Start start;
  const bool own = body.contains("tubes");
  if (own && !read_tubes(body, start)) {
    return error_answer(400, "expected tubes: 1 to 8 of {row, column, u, v}");
  }
  if (!own) {
    start.tubes = box_.settings->told().start.tubes;
    if (start.tubes.empty()) {
      return error_answer(400, "the settings have no [start] tubes, expected tubes");
    }
  }
  start.seen_field = field_of(body);
  const std::lock_guard lock(mutex_);
  const bool confirmed = flag_of(body, "confirmed");
  if (auto warning = errands_.warn(request.cookie, confirmed, {tracks(), own})) {
    return warning;
  }
  // What was not told to this person is not confirmed by him.
  start.confirmed =
      confirmed && errands_.was_refused(request.cookie, core::StartRefusal::kElsewhere);
  if (box_.journal != nullptr) {
    box_.journal->name(errands_.next_id(), access_->sessions().who_operates(monotonic_now()).name);
  }
  return errand(request, call, start);
}

PageDesk::Answer PageDesk::errand(const Request& request, const Call& call,
                                  const decltype(core::Event::content)& content) {
  wakeup_.wake();
  return errands_.submit(request.cookie, call, content);
}

PageDesk::Answer PageDesk::pick(const Request& request, const Call& call, const Json& body) {
  core::Pick pick;
  const auto u = px_of(body, "u");
  const auto v = px_of(body, "v");
  if (!u || !v) {
    return error_answer(400, "expected u and v");
  }
  pick.at_px = {*u, *v};
  pick.seen_field = field_of(body);
  const std::lock_guard lock(mutex_);
  return errand(request, call, pick);
}

PageDesk::Answer PageDesk::lamp(const Request& request, const Call& call, const Json& body) {
  core::LampCommand command;
  command.automatic = flag_of(body, "automatic");
  const auto permille = whole_of(body, "permille", 0, hal::kFullLevel_permille);
  if (command.automatic == permille.has_value()) {
    return error_answer(400, "expected permille of 0 to 1000, or automatic");
  }
  command.permille = static_cast<std::int32_t>(permille.value_or(0));
  const std::lock_guard lock(mutex_);
  return errand(request, call, command);
}

PageDesk::Answer PageDesk::acknowledge(const Json& body) {
  constexpr std::size_t kMostText = 500;
  const auto id = whole_of(body, "id", 1, INT64_MAX);
  const std::string name = text_of(body, "name").substr(0, kMostText);
  const std::string reason = text_of(body, "reason").substr(0, kMostText);
  if (!id || name.empty() || reason.empty()) {
    return error_answer(400, "expected id, name and reason");
  }
  const std::lock_guard lock(mutex_);
  if (!history_.acknowledge(*id, name, reason, seconds(box_.clock->now()))) {
    return error_answer(404, "there is no such disagreement");
  }
  if (!errands_.submit(core::Acknowledge{})) {
    return error_answer(503, "the box has too much to do, ask again");
  }
  if (box_.journal != nullptr) {
    JournalLine line;
    line.kind = hal::JournalKind::kAcknowledgement;
    line.origin = "operator";
    line.detail = detail_word("by", name) + " " + detail_word("words", reason) + " " +
                  detail_word("disagreement", std::to_string(*id));
    box_.journal->add(std::move(line));
  }
  listeners_.tell_all("disagreement", text({{"id", *id}}));
  return json_answer({{"acknowledged", true}});
}

PageDesk::Answer PageDesk::self_test_answer() {
  const std::lock_guard lock(mutex_);
  Json parts = Json::array();
  bool good = true;
  for (const SelfTestRow& row : self_test(report_)) {
    const bool bad = row.verdict == SelfTestRow::Verdict::kBad;
    good = good && !bad;
    parts.push_back({{"name", row.what},
                     {"verdict", bad                                            ? "bad"
                                 : row.verdict == SelfTestRow::Verdict::kAbsent ? "absent"
                                                                                : "good"},
                     {"words", row.words}});
  }
  return json_answer({{"good", good}, {"parts", std::move(parts)}});
}

PageDesk::Answer PageDesk::record(const Call& call) {
  const std::lock_guard lock(mutex_);
  return errands_.record(call);
}

PageDesk::Answer PageDesk::recordings() const {
  return json_answer(list_recordings(box_.settings->record.folder));
}

PageDesk::Answer PageDesk::recording(const Request& request) const {
  const std::string name = request.path.substr(std::string_view("/api/recordings/").size());
  auto answer = download_recording(box_.settings->record.folder, name);
  return answer ? answer : error_answer(404, "there is no such recording");
}

PageDesk::Answer PageDesk::settings(const Request& request) const {
  return settings_answer(box_.settings->page.file, request.path == "/api/backup");
}

PageDesk::Answer PageDesk::change_settings(const Request& request, const Call& call,
                                           const Json& body) {
  const auto found = body.find("text");
  if (found == body.end() || !found->is_string()) {
    return error_answer(400, "expected text");
  }
  const bool save = request.method == "PUT";
  std::string who = "engineer";
  {
    const std::lock_guard lock(mutex_);
    drivers::PageSessions& sessions = access_->sessions();
    if (sessions.operates(request.cookie)) {
      who = sessions.who_operates(monotonic_now()).name;
    }
  }
  const bool taken = jobs_.add([this, call, save, who, settings = found->get<std::string>()] {
    const std::string& file = box_.settings->page.file;
    const bool journal = save && box_.journal != nullptr;
    const std::string before = journal ? settings_digest(file) : std::string();
    call->answer(save ? save_settings(file, settings) : check_settings(file, settings));
    if (const std::string now = journal ? settings_digest(file) : before; now != before) {
      JournalLine line;
      line.kind = hal::JournalKind::kSetting;
      line.origin = "operator";
      line.detail = "what=saved " + detail_word("by", who) + " " + detail_word("settings", now) +
                    " " + detail_word("before", before);
      box_.journal->add(std::move(line));
    }
  });
  return taken ? Answer() : error_answer(503, "the box has too much to do, ask again");
}

// --- The thread of pictures and answers ----------------------------------------------------------

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
