#include "board/box/start_text.h"

#include <gtest/gtest.h>

namespace tubesight::board {
namespace {

TEST(RefusalText, NamesTheClickToBlame) {
  EXPECT_EQ(refusal_text({core::StartRefusal::kNoTubeThere, 2}),
            "no dark tube-end around a click: plate, or no light of the lamp (click 3)");
  EXPECT_EQ(refusal_text({core::StartRefusal::kTooFew}), "fewer than three clicks");
}

}  // namespace
}  // namespace tubesight::board
