#include "drivers/journal/signing_key.h"

#include <string>

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "tests/support/temporary_folder.h"

namespace tubesight::drivers {
namespace {

TEST(SigningKey, VerifiesTheSignatureOfTheStandard) {
  // RFC 8032, 7.1, test 2: a message of one byte.
  const std::string key = "3d4017c3e843895a92b70aa74d1b7ebc9c982ccf2ec4968cc0cd55f12af4660c";
  const std::string signature =
      "92a009a9f0d4cab8720e820b5f642540a2b27b5416503f8fb3762223ebdb69da"
      "085ac1e43e15996e458f3613d0f11d8c387b2eaeb4302aeeb00d291612bb0c00";

  EXPECT_TRUE(is_signed_by(key, "\x72", signature));
  EXPECT_FALSE(is_signed_by(key, "\x73", signature));
  EXPECT_FALSE(is_signed_by(std::string(64, '1'), "\x72", signature));
  EXPECT_FALSE(is_signed_by("3d40", "\x72", signature));
  EXPECT_FALSE(is_signed_by(key, "\x72", "none"));
}

TEST(SigningKey, IsMadeOnceAndForItsOwnerAlone) {
  const support::TemporaryFolder folder;
  std::string message;
  SigningKey made;
  ASSERT_TRUE(made.load_or_make(folder.path("key"), message)) << message;
  struct stat found {};
  ASSERT_EQ(::stat(folder.path("key").c_str(), &found), 0);
  EXPECT_EQ(found.st_mode & 0777U, 0600U);

  SigningKey read;
  ASSERT_TRUE(read.load_or_make(folder.path("key"), message)) << message;

  EXPECT_EQ(read.public_hex(), made.public_hex());
  EXPECT_EQ(read_public_key(folder.path("key.pub"), message).value_or(message), made.public_hex());
  EXPECT_TRUE(is_signed_by(made.public_hex(), "text", read.sign("text")));
  EXPECT_EQ(folder.names().size(), 2u) << "nothing else is left";
}

TEST(SigningKey, DiffersFromBoxToBox) {
  const support::TemporaryFolder folder;
  std::string message;
  SigningKey one;
  SigningKey other;
  ASSERT_TRUE(one.load_or_make(folder.path("one"), message));
  ASSERT_TRUE(other.load_or_make(folder.path("other"), message));

  EXPECT_NE(one.public_hex(), other.public_hex());
}

TEST(SigningKey, IsRefusedWhereOthersMayReadIt) {
  const support::TemporaryFolder folder;
  std::string message;
  {
    SigningKey made;
    ASSERT_TRUE(made.load_or_make(folder.path("key"), message));
  }
  ASSERT_EQ(::chmod(folder.path("key").c_str(), 0640), 0);

  SigningKey read;
  const auto loaded = read.load_or_make(folder.path("key"), message);

  ASSERT_FALSE(loaded);
  EXPECT_EQ(loaded.error(), core::Error::kInvalidArgument);
  EXPECT_NE(message.find("0600"), std::string::npos);
  EXPECT_FALSE(read.is_loaded());
  EXPECT_EQ(read.sign("text"), "");
}

TEST(SigningKey, RefusesWhatIsNone) {
  const support::TemporaryFolder folder;
  std::string message;
  const std::string path = folder.write("key", "-----BEGIN PRIVATE KEY-----\n");
  ASSERT_EQ(::chmod(path.c_str(), 0600), 0);

  SigningKey key;
  const auto loaded = key.load_or_make(path, message);

  ASSERT_FALSE(loaded);
  EXPECT_EQ(loaded.error(), core::Error::kDataLoss);
  EXPECT_FALSE(read_public_key(path, message));
}

}  // namespace
}  // namespace tubesight::drivers
