#include "drivers/journal/journal_export.h"

#include <string>

#include <gtest/gtest.h>

#include "tests/drivers/journal/journal_bench.h"

namespace tubesight {
namespace {

std::string exported(const std::string& path, drivers::JournalFormat format) {
  std::string text;
  std::string message;
  const auto rows = drivers::export_journal(
      path, format,
      [&](std::string_view piece) {
        text += piece;
        return true;
      },
      message);
  EXPECT_TRUE(rows) << message;
  return text;
}

class JournalExportTest : public testing::Test {
 protected:
  void SetUp() override {
    drivers::SqliteJournal journal({path_, {}, 2000, {}});
    ASSERT_TRUE(journal.open(support::begin_row())) << journal.message();
    hal::JournalRow row;
    row.kind = hal::JournalKind::kAcknowledgement;
    row.origin = "operator";
    row.detail = R"(name="A, B" c\d)";
    ASSERT_TRUE(journal.append(std::span(&row, 1)));
    chain_ = journal.chain();
  }

  support::TemporaryFolder folder_;
  std::string path_ = folder_.path("J.db");
  std::string chain_;
};

TEST_F(JournalExportTest, WritesCsvWithQuotes) {
  const std::string text = exported(path_, drivers::JournalFormat::kCsv);

  EXPECT_TRUE(text.starts_with("n,kind,boot_id,monotonic_us,wall_us,"));
  EXPECT_NE(text.find(",detail,chain\n1,begin,6f1d,3000000,,,1.0,box,,"), std::string::npos);
  EXPECT_TRUE(
      text.ends_with("2,acknowledgement,,0,,,,operator,,,,,,,,,,,,,,,,,,,,1,,"
                     "\"name=\"\"A, B\"\" c\\d\"," +
                     chain_ + "\n"))
      << text;
}

TEST_F(JournalExportTest, WritesAnObjectALine) {
  const std::string text = exported(path_, drivers::JournalFormat::kJsonLines);

  const std::size_t second = text.find('\n') + 1;
  EXPECT_TRUE(text.substr(second).starts_with(
      R"({"n":2,"kind":"acknowledgement","boot_id":null,"monotonic_us":0,)"));
  EXPECT_TRUE(text.ends_with(R"("detail":"name=\"A, B\" c\\d","chain":")" + chain_ + "\"}\n"));
}

TEST_F(JournalExportTest, EndsWhereNobodyTakesIt) {
  std::string message;
  const auto rows = drivers::export_journal(
      path_, drivers::JournalFormat::kCsv, [](std::string_view) { return false; }, message);

  ASSERT_FALSE(rows);
  EXPECT_EQ(rows.error(), core::Error::kBufferTooSmall);
}

}  // namespace
}  // namespace tubesight
