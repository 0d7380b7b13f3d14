#include "drivers/replay/scan_flag.h"

#include <gtest/gtest.h>

namespace tubesight::drivers {
namespace {

TEST(WhyOtherScan, IsEmptyWhereHeaderAndSettingsAgree) {
  EXPECT_EQ(why_other_scan(Y4mInterlacing::kProgressive, core::Scan::kProgressive), "");
  EXPECT_EQ(why_other_scan(Y4mInterlacing::kEvenFirst, core::Scan::kEvenFirst), "");
  EXPECT_EQ(why_other_scan(Y4mInterlacing::kOddFirst, core::Scan::kOddFirst), "");
  EXPECT_EQ(why_other_scan(Y4mInterlacing::kUnstated, core::Scan::kOddFirst), "");
}

TEST(WhyOtherScan, NamesBoth) {
  EXPECT_EQ(why_other_scan(Y4mInterlacing::kProgressive, core::Scan::kEvenFirst),
            "header says Ip (progressive), expected scan = \"even-first\" as [camera] of the "
            "settings says");
  EXPECT_EQ(why_other_scan(Y4mInterlacing::kOddFirst, core::Scan::kProgressive),
            "header says Ib (odd lines first), expected scan = \"progressive\" as [camera] of the "
            "settings says");
}

}  // namespace
}  // namespace tubesight::drivers
