#include "drivers/web/site_names.h"

#include <gtest/gtest.h>

namespace tubesight::drivers {
namespace {

TEST(SiteNames, AreTheAddressAndThisMachine) {
  const SiteNames names("127.0.0.1", 8080, false, {});
  EXPECT_TRUE(names.is_host("127.0.0.1:8080"));
  EXPECT_TRUE(names.is_host("LocalHost:8080"));
  EXPECT_TRUE(names.is_host("[::1]:8080"));
  EXPECT_EQ(names.link(), "http://127.0.0.1:8080/");
}

TEST(SiteNames, AreNoOthers) {
  const SiteNames names("127.0.0.1", 8080, false, {"box1"});
  for (const char* const host : {"", "127.0.0.1", "127.0.0.1:80", "evil.example:8080",
                                 "box1.evil.example:8080", "box1:8081", "127.0.0.1:8080 "}) {
    EXPECT_FALSE(names.is_host(host)) << host;
  }
  EXPECT_TRUE(names.is_host("box1:8080"));
}

TEST(SiteNames, LeaveTheUsualPortOut) {
  const SiteNames names("0.0.0.0", 443, true, {"box1.plant"});
  EXPECT_TRUE(names.is_host("box1.plant"));
  EXPECT_TRUE(names.is_host("box1.plant:443"));
  EXPECT_FALSE(names.is_host("0.0.0.0"));
}

TEST(SiteNames, KnowTheirOwnOrigins) {
  const SiteNames names("10.1.2.3", 8443, true, {});
  EXPECT_TRUE(names.is_origin("https://10.1.2.3:8443"));
  for (const char* const origin :
       {"http://10.1.2.3:8443", "https://10.1.2.3", "null", "https://10.1.2.3:8443.evil.example"}) {
    EXPECT_FALSE(names.is_origin(origin)) << origin;
  }
}

TEST(Loopback, IsThisMachineAlone) {
  EXPECT_TRUE(is_loopback("127.0.0.1"));
  EXPECT_TRUE(is_loopback("127.1.2.3"));
  EXPECT_TRUE(is_loopback("::1"));
  for (const char* const address : {"", "0.0.0.0", "::", "10.0.0.1", "127.evil", "1270.0.0.1"}) {
    EXPECT_FALSE(is_loopback(address)) << address;
  }
}

}  // namespace
}  // namespace tubesight::drivers
