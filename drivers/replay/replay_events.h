#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/event.h"
#include "core/base/result.h"
#include "drivers/files/messages.h"

namespace tubesight::drivers {

/// The events of a `NAME.events.csv`; the grammar of its column `values` is in
/// docs/file-formats.md. An event without an id gets its place in the file, from 1.
class ReplayEvents {
 public:
  /// Reads the events beside a recording; none when there is no such file.
  ///
  /// Errors: kIo the file is there and cannot be read, kInvalidArgument rows are wrong (a message
  /// for each, the first 20).
  [[nodiscard]] core::Result<void> load_beside(std::string_view recording, Messages& messages);

  /// The same from text; `name` stands before every message. Errors: kInvalidArgument.
  [[nodiscard]] core::Result<void> parse(std::string_view text, const std::string& name,
                                         Messages& messages);

  /// Replaces `events` by those that are to be handed to step() before the field with this number:
  /// all rows up to it that were not taken yet, in the file's order. Call it for each field in
  /// turn. Allocates nothing.
  void take_before(std::int64_t field, core::EventList& events);

  /// The first row that was not taken yet, if it belongs before the field with this number or an
  /// earlier one; null: there is none. Valid until the next parse().
  [[nodiscard]] const core::Event* next_before(std::int64_t field) const;

  /// Takes the row that next_before() gave.
  void take_next() { ++taken_; }

  /// Whether the file tells what became of pose requests: then they are not computed again.
  [[nodiscard]] bool has_pose_results() const { return has_pose_results_; }

  /// Rows in the file.
  [[nodiscard]] std::size_t size() const { return rows_.size(); }

  /// Rows not taken yet: when the recording has ended, those that lie behind its end.
  [[nodiscard]] std::size_t left() const { return rows_.size() - taken_; }

 private:
  struct Row {
    std::int64_t field = 0;
    core::Event event;
  };

  std::vector<Row> rows_;
  std::size_t taken_ = 0;
  bool has_pose_results_ = false;
};

}  // namespace tubesight::drivers
