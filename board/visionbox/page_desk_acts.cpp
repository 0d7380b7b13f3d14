#include "board/visionbox/page_desk.h"

// What a person does: starts, picks, lights, acknowledges, records, changes settings.

#include <utility>

#include "board/visionbox/journal_store.h"
#include "board/visionbox/page_body.h"
#include "board/visionbox/page_numbers.h"
#include "board/visionbox/page_recordings.h"
#include "board/visionbox/page_settings_text.h"
#include "core/base/words.h"
#include "hal/dimmer.h"

namespace tubesight::board {

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

}  // namespace tubesight::board
