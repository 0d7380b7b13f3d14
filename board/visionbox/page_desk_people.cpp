#include "board/visionbox/page_desk.h"

// Who asks: sessions, log-ins, and who has the controls.

#include <cmath>
#include <utility>

#include "board/box/version.h"
#include "board/visionbox/page_body.h"
#include "board/visionbox/page_numbers.h"

namespace tubesight::board {
namespace {

using drivers::PageAnswer;
using drivers::PageRole;

}  // namespace

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

}  // namespace tubesight::board
