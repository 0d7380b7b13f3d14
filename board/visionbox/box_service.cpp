#include "board/visionbox/box_service.h"

#include <chrono>

#include "board/box/version.h"

namespace tubesight::board {
namespace {

std::string origin(const BootCount& boots) {
  return "recorded by " + std::string(program_version()) + ", " + boots.words();
}

auto say_to(Log& log) {
  return [&log](const std::string& line) { log.say(line); };
}

}  // namespace

BoxService::BoxService(const BoxSettings& settings, const Found& found, Log& log)
    : settings_(&settings),
      log_(&log),
      found_(found),
      box_(settings, say_to(log), origin(found.boots)),
      manager_(found.environment, say_to(log)),
      supervisor_([this] { return box_.beats(); }, settings.watchdog, manager_, say_to(log)),
      watch_(say_to(log)),
      self_test_(say_to(log)),
      faults_([this](JournalLine line) { box_.journal()->add(std::move(line)); }),
      desk_([this] { return report(); }, box_, settings.told().start),
      server_(desk_),
      page_(settings.page.wanted ? std::make_unique<PageDesk>(box_.page_box(), say_to(log))
                                 : nullptr) {}

bool BoxService::start() {
  log_->say(found_.boots.words());
  if (!found_.golden.good) {
    log_->say("self-test: " + found_.golden.words +
              "; the box judges no picture and vouches for nothing: this machine or its program is "
              "faulty");
    box_.judge_nothing();
  }
  if (!settings_->control_socket.empty() && !server_.start(settings_->control_socket)) {
    log_->say(server_.message());
    return false;
  }
  journal_boot("started");  // before all that follows from it
  if (!box_.start()) {
    log_->say("cannot be started");
    return false;
  }
  log_->say("started, " + std::string(program_version()));
  if (page_ != nullptr && !page_->start()) {
    log_->say("the page is not served, the box goes on without");
  }
  supervisor_.start();
  manager_.say_ready();
  return true;
}

void BoxService::serve(int end) {
  constexpr std::chrono::milliseconds kIdle{100};
  constexpr std::chrono::milliseconds kBusy{4};  // an answer comes with the next field
  bool ended = false;
  while (!ended) {
    supervisor_.beat();
    ended = server_.serve(desk_.busy() ? kBusy : kIdle, end);
    desk_.serve_replies(server_, monotonic_now());
    box_.look_after();
    look_round();
  }
}

void BoxService::look_round() {
  log_->tell_repeats(monotonic_now());
  const BoxReport now = report();
  watch_.look(now);
  if (page_ != nullptr) {
    page_->look(now);
  }
  self_test_.look(now);
  if (box_.journal() != nullptr) {
    faults_.look(now);
  }
  tell_robot(now);
  if (watch_.headline() != told_manager_) {
    told_manager_ = watch_.headline();
    manager_.say_status(told_manager_);
  }
}

void BoxService::tell_robot(const BoxReport& now) {
  drivers::LinkJournal journal;
  switch (now.journal.state) {
    case JournalReport::State::kNone: journal.state = drivers::kJournalNone; break;
    case JournalReport::State::kWriting: journal.state = drivers::kJournalWriting; break;
    case JournalReport::State::kStanding: journal.state = drivers::kJournalStanding; break;
  }
  journal.safe = now.journal.safe;
  journal.waiting = now.journal.waiting;
  journal.lost = now.journal.lost;
  box_.tell_robot(self_test_.told(), journal);
}

/// The program's start and end, with what it is started with.
void BoxService::journal_boot(std::string_view what) {
  if (box_.journal() == nullptr) {
    return;
  }
  JournalLine line;
  line.kind = hal::JournalKind::kBoot;
  line.detail = detail_word("what", what);
  if (found_.boots.known()) {
    line.detail += " " + detail_word("boot", std::to_string(found_.boots.boot)) + " " +
                   detail_word("start", std::to_string(found_.boots.start));
  }
  line.detail += " " + detail_word("settings", box_.journal()->settings_digest());
  line.detail += " " + detail_word("golden", found_.golden.good ? "good" : "bad");
  box_.journal()->add(std::move(line));
}

void BoxService::stop() {
  manager_.say_stopping();
  supervisor_.begin_to_stop();
  if (page_ != nullptr) {
    page_->stop();
  }
  journal_boot("ended");
  box_.stop();
  desk_.serve_replies(server_, monotonic_now());  // what stop() wrote, somebody may wait for
  server_.stop();
  supervisor_.stop();
  log_->say("stopped");
}

BoxReport BoxService::report() const {
  BoxReport report = box_.report();
  report.fields_per_s = watch_.fields_per_s();
  report.supervision = supervisor_.report();
  report.golden = found_.golden;
  report.boots = found_.boots;
  report.self_test_finished = self_test_.finished();
  return report;
}

}  // namespace tubesight::board
