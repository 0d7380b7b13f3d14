// The fixed-point instance leaves the same bytes on every machine: x86-64 and arm64 must both give
// the digest frozen here. Whoever changes the path on purpose freezes the new one, after having
// seen the same number on both.

#include <cstdint>

#include <gtest/gtest.h>

#include "core/base/fnv1a.h"
#include "tests/core/session/sheet_run.h"

namespace tubesight::core::session {
namespace {

class Digest {
 public:
  void add(std::int64_t value) { digest_.add(value); }
  void add(TubeAddress tube) {
    add(tube.row);
    add(tube.column);
  }
  void add(ImagePoint point) {
    add(point.u_q16);
    add(point.v_q16);
  }
  void add(const Output& output) {
    const Sighting& s = output.sighting;
    add(s.time.count());
    add(static_cast<std::int64_t>(s.state));
    add(static_cast<std::int64_t>(s.reason));
    add(s.tracked);
    add(s.primary_known ? 1 : 0);
    add(s.primary);
    add(s.primary_px);
    add(s.axis_known ? 1 : 0);
    add(s.axis_px);
    add(s.height_um_q8);
    add(s.tool_known ? 1 : 0);
    add(s.tool);
    add(s.tool_px);
    add(s.offset_um_q8);
    add(s.aligned ? 1 : 0);
    add(s.velocity_known ? 1 : 0);
    add(s.velocity_um_s[0]);
    add(s.velocity_um_s[1]);
    add(s.margin_known ? 1 : 0);
    add(s.margin_permyriad);
    for (const tracking::TubeSightingList::value_type& tube : output.tubes) {
      add(tube.address);
      add(tube.center_px);
      add(tube.quality_permyriad);
      add(tube.plug ? 1 : 0);
    }
  }
  [[nodiscard]] std::uint64_t value() const { return digest_.value(); }

 private:
  Fnv1a digest_;
};

struct Digests {
  std::uint64_t pictures = 0;
  std::uint64_t answers = 0;
  int tracking = 0;
};

// A move with noise, lean, a plug and two black fields.
Digests digests_of_a_move(double nudge_mm, int fields) {
  SheetRun<FixedPoint> run;
  run.configure();
  run.sheet->look.noise = 2.0;
  run.sheet->look.rolled_plugs = {{21, 11}};
  run.add_start(kOverTube, {{20, 10}, {21, 10}, {20, 11}});
  Digest answers;
  Digest pictures;
  Digests digests;
  for (int field = 0; field < fields; ++field) {
    const bool black = field == 8 || field == 9;
    run.sheet->look.gain = black ? 0.0 : 1.0;
    // + - x / alone, so that the move is the same everywhere.
    const double t = field * kFieldSpan_s;
    ToolPlace place = moved(kOverTube, 600.0 * t * t + nudge_mm, -300.0 * t * t);
    place.beta_deg = 0.4;
    place.gamma_deg = -0.3;
    run.draw(place);
    for (const std::uint8_t pixel : run.frame()) {
      pictures.add(pixel);
    }
    answers.add(run.step_on_last_picture(place));
    digests.tracking += run.sighting().state == TrackState::kTracking ? 1 : 0;
  }
  digests.pictures = pictures.value();
  digests.answers = answers.value();
  return digests;
}

TEST(FixedPointDigest, IsTheSameOnEveryMachine) {
  const Digests digests = digests_of_a_move(0.0, 14);
  EXPECT_GE(digests.tracking, 11);
  EXPECT_EQ(digests.pictures, 0x9cb258811d91748fULL) << "the drawn pictures differ";
  EXPECT_EQ(digests.answers, 0x1a4d62658b478e97ULL) << "the answers differ";
}

TEST(FixedPointDigest, ChangesWithTheInput) {
  EXPECT_NE(digests_of_a_move(0.01, 3).answers, digests_of_a_move(0.0, 3).answers);
}

}  // namespace
}  // namespace tubesight::core::session
