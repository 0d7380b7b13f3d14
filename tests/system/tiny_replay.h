#pragma once

#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "tests/support/recording_text.h"
#include "tests/support/temporary_folder.h"
#include "tests/system/program.h"
#include "tests/system/tiny_session.h"

namespace tubesight::tests {

/// Frames of the recording below.
inline constexpr int kFrames = 4;

/// A recording by the camera of tiny_session(); it shows no tube-ends.
[[nodiscard]] inline std::string recording(const std::string& header = kTinyHeader,
                                           int chroma_bytes = 0) {
  return support::recording_text(header, kFrames, kTinyFrameBytes, chroma_bytes);
}

/// Replays a recording of the folder by its "s.toml" with every output asked for.
[[nodiscard]] inline ProgramRun replay(const support::TemporaryFolder& folder,
                                       const std::string& recording_name) {
  return run_tubesight(folder, {"replay", "s.toml", recording_name, "--fields", "f.csv",
                                "--centers", "c.csv", "--overlay", "pictures"});
}

/// Does so and expects the message (one line or more), status 2, and nothing new in the folder.
inline void expect_refused(const support::TemporaryFolder& folder,
                           const std::string& recording_name, const std::string& message) {
  auto before = folder.names();

  const ProgramRun run = replay(folder, recording_name);

  auto after = folder.names();
  std::sort(before.begin(), before.end());
  std::sort(after.begin(), after.end());
  EXPECT_EQ(run.status, 2);
  EXPECT_EQ(run.err, message + "\n");
  EXPECT_EQ(run.out, "");
  EXPECT_EQ(after, before);
}

[[nodiscard]] inline long lines_of(const std::string& text) {
  return std::count(text.begin(), text.end(), '\n');
}

}  // namespace tubesight::tests
