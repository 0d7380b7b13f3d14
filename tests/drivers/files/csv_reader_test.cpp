#include "drivers/files/csv_reader.h"

#include <gtest/gtest.h>

namespace tubesight::drivers {
namespace {

using Cells = std::vector<std::string>;

TEST(CsvReader, ReadsCellsAndQuotations) {
  CsvReader csv(
      "\xEF\xBB\xBF"
      "a,b\r\n\r\n1,\n\"x,\"\"y\"\"\",2\n",
      "f.csv");
  Messages messages;

  ASSERT_TRUE(csv.read_header({"a", "b"}, messages));
  ASSERT_TRUE(csv.next(messages));
  EXPECT_EQ(csv.cells(), (Cells{"1", ""}));
  EXPECT_EQ(csv.place(), "f.csv:3: ");
  ASSERT_TRUE(csv.next(messages));
  EXPECT_EQ(csv.cells(), (Cells{"x,\"y\"", "2"}));
  EXPECT_FALSE(csv.next(messages));
  EXPECT_EQ(messages, Messages{});
}

TEST(CsvReader, AcceptsAppendedColumnsOnly) {
  Messages messages;

  EXPECT_TRUE(CsvReader("a,b,c\n", "f").read_header({"a", "b"}, messages));
  EXPECT_FALSE(CsvReader("b,a\n", "f").read_header({"a", "b"}, messages));
  EXPECT_FALSE(CsvReader("a\n", "f").read_header({"a", "b"}, messages));
  EXPECT_FALSE(CsvReader("", "f").read_header({"a", "b"}, messages));

  EXPECT_EQ(messages,
            (Messages{"f:1: wrong header, expected a,b", "f:1: wrong header, expected a,b",
                      "f:1: the header is missing, expected a,b"}));
}

TEST(CsvReader, TellsLinesWithOtherCellsThanTheHeaderAndGoesOn) {
  CsvReader csv("a,b\n1\n1,2\n1,000,2\n\"1,000\",2\n,,\n3,4,\n", "f");
  Messages messages;

  ASSERT_TRUE(csv.read_header({"a"}, messages));
  ASSERT_TRUE(csv.next(messages));
  EXPECT_EQ(csv.cells(), (Cells{"1", "2"}));
  ASSERT_TRUE(csv.next(messages));
  EXPECT_EQ(csv.cells(), (Cells{"1,000", "2"}));
  EXPECT_FALSE(csv.next(messages));

  EXPECT_EQ(messages, (Messages{"f:2: 1 cells, expected 2", "f:4: 3 cells, expected 2",
                                "f:6: 3 cells, expected 2", "f:7: 3 cells, expected 2"}));
}

TEST(CsvReader, LetsTheLastColumnTakeTheRestWhereAskedFor) {
  Messages messages;
  CsvReader csv("a,b,c\n1,2,3,\"4,5\",\n1,2\n1\n", "f");

  ASSERT_TRUE(csv.read_header({"a", "b", "c"}, messages, CsvReader::LastColumn::kRest));
  ASSERT_TRUE(csv.next(messages));
  EXPECT_EQ(csv.cells(), (Cells{"1", "2", "3,4,5,"}));
  ASSERT_TRUE(csv.next(messages));
  EXPECT_EQ(csv.cells(), (Cells{"1", "2", ""}));
  EXPECT_FALSE(csv.next(messages));
  EXPECT_EQ(messages, Messages{"f:4: 1 cells, expected 3"});

  // With a column behind it only quotation marks keep them apart.
  messages.clear();
  CsvReader longer("a,b,c\n1,2\n1,2,3,4\n", "f");
  ASSERT_TRUE(longer.read_header({"a", "b"}, messages, CsvReader::LastColumn::kRest));
  EXPECT_FALSE(longer.next(messages));
  EXPECT_EQ(messages, (Messages{"f:2: 2 cells, expected 3", "f:3: 4 cells, expected 3"}));
}

TEST(CsvReader, FindsColumnsByName) {
  Messages messages;
  CsvReader csv("a,b,c\n", "f");

  ASSERT_TRUE(csv.read_header({"a"}, messages));

  EXPECT_EQ(csv.find_column("c"), 2U);
  EXPECT_FALSE(csv.find_column("d").has_value());
}

TEST(CsvReader, TellsBrokenQuotationsAndGoesOn) {
  CsvReader csv("\"a\n\"b\"c,d\ne\n", "f");
  Messages messages;

  ASSERT_TRUE(csv.next(messages));

  EXPECT_EQ(csv.cells(), Cells{"e"});
  EXPECT_EQ(messages,
            (Messages{"f:1: quotation marks do not pair, expected \"...\" around a cell",
                      "f:2: quotation marks do not pair, expected \"...\" around a cell"}));
}

TEST(InQuotes, KeepsATerminalClean) {
  EXPECT_EQ(in_quotes("a\x1B[2Jb"), "'a?[2Jb'");
  EXPECT_EQ(in_quotes(std::string(61, 'x')), "'" + std::string(60, 'x') + "...'");
}

TEST(ParseWhole, TakesNothingButTheWholeNumber) {
  std::int32_t value = 5;

  EXPECT_TRUE(parse_whole("-2147483648", value));
  EXPECT_EQ(value, -2147483648);
  for (const char* const text : {"", " 1", "1 ", "1.0", "+1", "2147483648", "0x1"}) {
    EXPECT_FALSE(parse_whole(text, value)) << text;
  }
}

}  // namespace
}  // namespace tubesight::drivers
