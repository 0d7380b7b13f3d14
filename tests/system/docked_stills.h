#pragma once

#include <cstddef>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/replaced_text.h"
#include "tests/system/pose_stills.h"

namespace tubesight::tests {

using TextChanges = std::vector<std::pair<std::string, std::string>>;

/// Draws the tool of the shipped example at rest on tube (40, 60) as `path` says, the first frame
/// into NAME.pgm, all of `length_s` into NAME.y4m; the clicks are in NAME.session.toml. `changes`
/// of the scenario: what, by what.
inline void draw_docked(const TemporaryFolder& folder, const std::string& name,
                        const std::string& path, const TextChanges& changes = {},
                        const std::string& length_s = "0.04") {
  std::string text =
      support::replaced(text_of(TUBESIGHT_SOURCE_DIR "/docs/examples/steam-generator.toml"),
                        "window_px = [40, 36, 595, 330]", "window_px = [8, 8, 627, 472]");
  for (const auto& [what, by] : changes) {
    text = support::replaced(text, what, by);
  }
  text.erase(text.find("[path]"));
  folder.write(name + ".toml", text + "[video]\nlength_s = " + length_s +
                                   "\n[path]\ntube = [40, 60]\n" + path +
                                   "\n[[step]]\nrest_s = 1\n");
  const ProgramRun run = run_tubesight(folder, {"simulate", name + ".toml", "--out", name});
  ASSERT_EQ(run.status, 0) << run.err;
  const std::string video = folder.read(name + ".y4m");
  const std::size_t frame = video.find("FRAME\n");
  ASSERT_NE(frame, std::string::npos);
  folder.write(name + ".pgm", "P5\n635 480\n255\n" + video.substr(frame + 6, 635 * 480));
}

/// The session of a drawing without a table, as "[tool]", which is not known yet.
inline void forget_table(const TemporaryFolder& folder, const std::string& name,
                         const std::string& table) {
  std::string text = folder.read(name + ".session.toml");
  const std::size_t at = text.find(table);
  ASSERT_NE(at, std::string::npos) << table;
  const std::size_t next = text.find("\n[", at);
  ASSERT_NE(next, std::string::npos);
  folder.write(name + ".session.toml", text.erase(at, next + 1 - at));
}

/// --start of a drawing's own clicks.
inline std::string clicks_of(const TemporaryFolder& folder, const std::string& name) {
  const std::string text = folder.read(name + ".session.toml");
  std::string clicks;
  for (std::size_t at = text.find("{ row = "); at != std::string::npos;
       at = text.find("{ row = ", at + 1)) {
    int row = 0;
    int column = 0;
    double u = 0.0;
    double v = 0.0;
    EXPECT_EQ(std::sscanf(text.c_str() + at, "{ row = %d, column = %d, at_px = [%lf, %lf]", &row,
                          &column, &u, &v),
              4);
    clicks += (clicks.empty() ? "" : ";") + std::to_string(row) + "," + std::to_string(column) +
              "," + std::to_string(u) + "," + std::to_string(v);
  }
  return clicks;
}

}  // namespace tubesight::tests
