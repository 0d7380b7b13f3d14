#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/base/field.h"
#include "core/base/settings.h"
#include "core/session/session.h"
#include "drivers/files/messages.h"

namespace tubesight::tests {

/// A recording with its settings, wholly in memory, so that nothing but the path is measured.
class RecordedSession {
 public:
  /// Reads `folder`/session.toml and recording.y4m.xz (or .y4m) beside it. False, with messages,
  /// when they cannot be used.
  [[nodiscard]] bool load(const std::string& folder, drivers::Messages& messages);

  [[nodiscard]] const core::SessionSettings& settings() const { return *settings_; }

  /// The fields in time order; their pixels live as long as this object.
  [[nodiscard]] const std::vector<core::Field>& fields() const { return fields_; }

  /// Numbers of the fields, as in files.
  [[nodiscard]] const std::vector<std::int64_t>& numbers() const { return numbers_; }

 private:
  std::unique_ptr<core::SessionSettings> settings_;
  std::vector<std::vector<std::uint8_t>> frames_;
  std::vector<core::Field> fields_;
  std::vector<std::int64_t> numbers_;
};

/// A session that is given the fields of a recording, the settings' start before the first.
template <core::Scalar S>
class SessionRun {
 public:
  /// False when the settings are refused.
  [[nodiscard]] bool configure(const core::SessionSettings& settings) {
    core::Event start;
    start.content = core::Start{settings.start.tubes, {}, false};
    return session_->configure(settings).has_value() && input_->events.try_push_back(start);
  }

  /// Lays a field ready; all that is not the path's own work happens here.
  void give(const core::Field& field) {
    if (given_) {
      input_->events.clear();
    }
    given_ = true;
    input_->field = field;
  }

  /// The path: processes the field that was given.
  void step() { session_->step(*input_, *output_); }

  [[nodiscard]] const core::session::Output& output() const { return *output_; }
  [[nodiscard]] const core::session::Session<S>& session() const { return *session_; }

 private:
  std::unique_ptr<core::session::Session<S>> session_ =
      std::make_unique<core::session::Session<S>>();
  std::unique_ptr<core::session::Input> input_ = std::make_unique<core::session::Input>();
  std::unique_ptr<core::session::Output> output_ = std::make_unique<core::session::Output>();
  bool given_ = false;
};

}  // namespace tubesight::tests
