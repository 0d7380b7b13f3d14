#pragma once

#include <string>

#include "board/bench/replay/replay_statistics.h"
#include "board/bench/replay/summary_text.h"

namespace tubesight::board {

/// What summary_text() tells a person, for machines: one JSON object in UTF-8, a key a line, with a
/// line feed at its end. docs/file-formats.md has the keys and their units; keys are only added
/// while `format` stays 1. What is not known is null.
[[nodiscard]] std::string summary_json(const RecordingFacts& recording,
                                       const ReplayStatistics& statistics);

}  // namespace tubesight::board
