#include <gtest/gtest.h>

#include "tests/core/overlay/scenes.h"

namespace tubesight::tests {
namespace {

// The same bytes on every machine: golden_test.cpp ties these digests to the pictures themselves.
TEST(OverlayDigest, EverySceneHasTheGoldenPicturesBytes) {
  ASSERT_EQ(scenes().size(), 5U);
  for (const Scene& scene : scenes()) {
    EXPECT_EQ(digest_of(scene.draw()), scene.digest) << scene.name;
  }
}

TEST(OverlayDigest, IsFnv1a) {
  // Test vectors of the algorithm's authors (draft-eastlake-fnv): "" and "foobar".
  EXPECT_EQ(digest_of({0, 0, {}}), 0xcbf29ce484222325U);
  EXPECT_EQ(digest_of({2, 1, {'f', 'o', 'o', 'b', 'a', 'r'}}), 0x85944171f73967e8U);
}

TEST(OverlayDigest, NoticesOneBitOfOnePixel) {
  for (const Scene& scene : scenes()) {
    Picture picture = scene.draw();
    picture.bytes[picture.bytes.size() / 2] ^= 1U;
    EXPECT_NE(digest_of(picture), scene.digest) << scene.name;
  }
}

}  // namespace
}  // namespace tubesight::tests
