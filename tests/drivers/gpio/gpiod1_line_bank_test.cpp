// The lines on a libgpiod of the test's own: its functions, of which this program has others by the
// same names.

#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

#include <gpiod.h>
#include <gtest/gtest.h>

#include "drivers/gpio/line_bank.h"

struct gpiod_line {
  const char* name = nullptr;
  const char* user = nullptr;
  bool used = false;
  int value = -1;
};
struct gpiod_chip {
  std::array<gpiod_line, 4> lines;
};
struct gpiod_chip_iter {
  bool given = false;
};

namespace {

struct Library {
  gpiod_chip chip;
  int open_chips = 0;
  bool taken = false;
  int flags = 0;
  int refuse_request = 0;
  int refuse_value = 0;
};
Library library;
gpiod_chip_iter all_chips;

}  // namespace

extern "C" {
gpiod_chip* gpiod_chip_open_lookup(const char* wanted) {
  if (std::strcmp(wanted, "pinctrl") != 0) {
    errno = ENOENT;
    return nullptr;
  }
  ++library.open_chips;
  return &library.chip;
}
void gpiod_chip_close(gpiod_chip*) { --library.open_chips; }
const char* gpiod_chip_name(gpiod_chip*) { return "gpiochip0"; }
const char* gpiod_chip_label(gpiod_chip*) { return "pinctrl"; }
unsigned int gpiod_chip_num_lines(gpiod_chip*) { return 4; }
gpiod_line* gpiod_chip_get_line(gpiod_chip* chip, unsigned int offset) {
  return offset < 4 ? &chip->lines[offset] : nullptr;
}
gpiod_line* gpiod_chip_find_line(gpiod_chip* chip, const char* name) {
  for (gpiod_line& line : chip->lines) {
    if (line.name != nullptr && std::strcmp(line.name, name) == 0) {
      return &line;
    }
  }
  return nullptr;
}
const char* gpiod_line_name(gpiod_line* line) { return line->name; }
const char* gpiod_line_consumer(gpiod_line* line) { return line->user; }
bool gpiod_line_is_used(gpiod_line* line) { return line->used; }
int gpiod_line_request_bulk_output_flags(gpiod_line_bulk* bulk, const char*, int flags,
                                         const int* values) {
  if (library.refuse_request != 0) {
    errno = library.refuse_request;
    return -1;
  }
  library.taken = true;
  library.flags = flags;
  for (unsigned int i = 0; i < bulk->num_lines; ++i) {
    bulk->lines[i]->value = values[i];
  }
  return 0;
}
int gpiod_line_set_value_bulk(gpiod_line_bulk* bulk, const int* values) {
  if (library.refuse_value != 0) {
    errno = library.refuse_value;
    return -1;
  }
  for (unsigned int i = 0; i < bulk->num_lines; ++i) {
    bulk->lines[i]->value = values[i];
  }
  return 0;
}
void gpiod_line_release_bulk(gpiod_line_bulk*) { library.taken = false; }
gpiod_chip_iter* gpiod_chip_iter_new() {
  all_chips.given = false;
  return &all_chips;
}
gpiod_chip* gpiod_chip_iter_next(gpiod_chip_iter* iter) {
  return std::exchange(iter->given, true) ? nullptr : &library.chip;
}
void gpiod_chip_iter_free(gpiod_chip_iter*) {}
}

namespace tubesight::tests {
namespace {

class GpiodLineBank : public testing::Test {
 protected:
  void SetUp() override {
    library = {};
    library.chip.lines[1].name = "GPIO18";
    library.chip.lines[3].used = true;
    library.chip.lines[3].user = "spi0";
  }
  std::string refused(const drivers::LineBankSettings& settings) {
    std::string message;
    EXPECT_FALSE(bank_->open(settings, message));
    EXPECT_EQ(library.open_chips, 0) << "nothing stays open";
    return message;
  }
  std::unique_ptr<drivers::LineBank> bank_ = drivers::make_gpiod_line_bank();
};

TEST_F(GpiodLineBank, TakesLinesByNumberAndByNameAndAllDark) {
  std::string message;
  ASSERT_TRUE(bank_->open({"pinctrl", {"2", "GPIO18"}, false}, message)) << message;
  EXPECT_EQ(library.chip.lines[1].value, 0);
  EXPECT_EQ(library.chip.lines[2].value, 0);
  EXPECT_EQ(library.flags, 0);

  EXPECT_EQ(bank_->set(1), 0);
  EXPECT_EQ(library.chip.lines[2].value, 1) << "the first of the list";
  EXPECT_EQ(library.chip.lines[1].value, 0);
  EXPECT_EQ(bank_->set(2), 0);
  EXPECT_EQ(library.chip.lines[2].value, 0);
  EXPECT_EQ(library.chip.lines[1].value, 1);

  bank_->close();
  EXPECT_FALSE(library.taken);
  EXPECT_EQ(library.open_chips, 0);
}

TEST_F(GpiodLineBank, ALampThatShinesWhileLowIsTheLibrarysToInvert) {
  std::string message;
  ASSERT_TRUE(bank_->open({"pinctrl", {"0"}, true}, message));

  EXPECT_EQ(library.flags, GPIOD_LINE_REQUEST_FLAG_ACTIVE_LOW);
}

TEST_F(GpiodLineBank, SaysWhatIsWrong) {
  EXPECT_EQ(refused({"other", {"0"}, false}),
            "there is no such chip, or it is not ours: No such file or directory");
  EXPECT_EQ(refused({"pinctrl", {"4"}, false}), "has no line '4', expected one of its 4");
  EXPECT_EQ(refused({"pinctrl", {"LAMP"}, false}), "has no line 'LAMP', expected one of its 4");
  EXPECT_EQ(refused({"pinctrl", {"3"}, false}), "line '3' is used by 'spi0', expected it free");
  library.refuse_request = EPERM;
  EXPECT_EQ(refused({"pinctrl", {"0"}, false}), "does not give its lines: Operation not permitted");
}

TEST_F(GpiodLineBank, ARefusedValueIsTold) {
  std::string message;
  ASSERT_TRUE(bank_->open({"pinctrl", {"0"}, false}, message));
  library.refuse_value = ENODEV;

  EXPECT_EQ(bank_->set(1), -ENODEV);
}

TEST_F(GpiodLineBank, ListsChipsWithTheirLinesAndUsers) {
  const auto chips = drivers::list_gpio_chips();

  ASSERT_EQ(chips.size(), 1u);
  EXPECT_EQ(chips[0].name, "gpiochip0");
  EXPECT_EQ(chips[0].label, "pinctrl");
  ASSERT_EQ(chips[0].lines.size(), 4u);
  EXPECT_EQ(chips[0].lines[1].name, "GPIO18");
  EXPECT_EQ(chips[0].lines[1].user, "");
  EXPECT_EQ(chips[0].lines[3].user, "spi0");
}

}  // namespace
}  // namespace tubesight::tests
