#include "drivers/web/page_certificate.h"

#include <gtest/gtest.h>

namespace tubesight::drivers {
namespace {

constexpr std::int64_t kNow_s = 1'800'000'000;

TEST(PageCertificate, BelongsToItsKey) {
  PageCertificate made;
  std::string message;
  ASSERT_TRUE(make_certificate({"box1.plant", "10.1.2.3"}, kNow_s, made, message)) << message;
  EXPECT_EQ(made.fingerprint.size(), 32U * 3U - 1U);
  PageCertificate read{made.certificate, made.key, {}};
  EXPECT_TRUE(check_certificate(read, message)) << message;
  EXPECT_EQ(read.fingerprint, made.fingerprint);
}

TEST(PageCertificate, IsRefusedWithAnothersKey) {
  PageCertificate one;
  PageCertificate other;
  std::string message;
  ASSERT_TRUE(make_certificate({"box1"}, kNow_s, one, message));
  ASSERT_TRUE(make_certificate({"box1"}, kNow_s, other, message));
  EXPECT_NE(one.fingerprint, other.fingerprint);
  PageCertificate mixed{one.certificate, other.key, {}};
  EXPECT_FALSE(check_certificate(mixed, message));
  EXPECT_EQ(message, "the key is not the certificate's");
}

TEST(PageCertificate, IsRefusedWhenItIsNone) {
  PageCertificate none{"no certificate", "no key", {}};
  std::string message;
  EXPECT_FALSE(check_certificate(none, message));
  EXPECT_EQ(message, "the certificate is none in PEM form");
}

}  // namespace
}  // namespace tubesight::drivers
