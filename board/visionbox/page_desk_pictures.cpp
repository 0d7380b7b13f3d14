#include "board/visionbox/page_desk.h"

// Pictures: live, frozen, of a disagreement, and the lattice in one.

#include <algorithm>
#include <utility>

#include "board/visionbox/page_body.h"
#include "board/visionbox/page_lattice.h"
#include "board/visionbox/page_numbers.h"
#include "board/visionbox/report_words.h"

namespace tubesight::board {
namespace {

using drivers::PageAnswer;

constexpr int kUsualQuality = 75;

}  // namespace

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

}  // namespace tubesight::board
