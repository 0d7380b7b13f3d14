// The lines on a libgpiod of the test's own, as gpiod1_line_bank_test.cpp: its functions of 2.x, of
// which this program has others by the same names.

#include <array>
#include <cerrno>
#include <cstring>
#include <string>
#include <vector>

#include <gpiod.h>
#include <gtest/gtest.h>

#include "drivers/gpio/line_bank.h"

struct gpiod_chip {};
struct gpiod_chip_info {};
struct gpiod_line_info {
  const char* name = nullptr;
  const char* user = nullptr;
  bool used = false;
  int value = -1;
};
struct gpiod_line_settings {
  bool active_low = false;
  gpiod_line_direction direction = GPIOD_LINE_DIRECTION_INPUT;
  gpiod_line_value value = GPIOD_LINE_VALUE_ACTIVE;
};
struct gpiod_line_config {
  std::vector<unsigned int> offsets;
  gpiod_line_settings settings;
};
struct gpiod_request_config {};
struct gpiod_line_request {
  std::vector<unsigned int> offsets;
};

namespace {

struct Library {
  gpiod_chip chip;
  gpiod_chip_info info;
  std::array<gpiod_line_info, 4> lines;
  gpiod_line_settings settings;  ///< of the last request
  int alive = 0;                 ///< objects that were not given back
  int refuse_request = 0;
  int refuse_value = 0;
};
Library library;

template <typename T>
T* made(T* object) {
  ++library.alive;
  return object;
}

}  // namespace

extern "C" {
bool gpiod_is_gpiochip_device(const char*) { return true; }
gpiod_chip* gpiod_chip_open(const char* path) {
  if (std::strcmp(path, "/dev/lamp") != 0) {
    errno = ENOENT;
    return nullptr;
  }
  return made(&library.chip);
}
void gpiod_chip_close(gpiod_chip*) { --library.alive; }
gpiod_chip_info* gpiod_chip_get_info(gpiod_chip*) { return made(&library.info); }
void gpiod_chip_info_free(gpiod_chip_info*) { --library.alive; }
const char* gpiod_chip_info_get_name(gpiod_chip_info*) { return "gpiochip0"; }
const char* gpiod_chip_info_get_label(gpiod_chip_info*) { return "pinctrl"; }
size_t gpiod_chip_info_get_num_lines(gpiod_chip_info*) { return 4; }
int gpiod_chip_get_line_offset_from_name(gpiod_chip*, const char* name) {
  for (std::size_t i = 0; i < library.lines.size(); ++i) {
    const char* const own = library.lines[i].name;
    if (own != nullptr && std::strcmp(own, name) == 0) {
      return static_cast<int>(i);
    }
  }
  return -1;
}
gpiod_line_info* gpiod_chip_get_line_info(gpiod_chip*, unsigned int offset) {
  return offset < 4 ? made(&library.lines[offset]) : nullptr;
}
void gpiod_line_info_free(gpiod_line_info*) { --library.alive; }
const char* gpiod_line_info_get_name(gpiod_line_info* line) { return line->name; }
const char* gpiod_line_info_get_consumer(gpiod_line_info* line) { return line->user; }
bool gpiod_line_info_is_used(gpiod_line_info* line) { return line->used; }

gpiod_line_settings* gpiod_line_settings_new() { return made(new gpiod_line_settings); }
void gpiod_line_settings_free(gpiod_line_settings* settings) {
  --library.alive;
  delete settings;
}
int gpiod_line_settings_set_direction(gpiod_line_settings* settings, gpiod_line_direction way) {
  settings->direction = way;
  return 0;
}
int gpiod_line_settings_set_output_value(gpiod_line_settings* settings, gpiod_line_value value) {
  settings->value = value;
  return 0;
}
void gpiod_line_settings_set_active_low(gpiod_line_settings* settings, bool low) {
  settings->active_low = low;
}
gpiod_line_config* gpiod_line_config_new() { return made(new gpiod_line_config); }
void gpiod_line_config_free(gpiod_line_config* config) {
  --library.alive;
  delete config;
}
int gpiod_line_config_add_line_settings(gpiod_line_config* config, const unsigned int* offsets,
                                        size_t count, gpiod_line_settings* settings) {
  config->offsets.assign(offsets, offsets + count);
  config->settings = *settings;
  return 0;
}
gpiod_request_config* gpiod_request_config_new() { return made(new gpiod_request_config); }
void gpiod_request_config_free(gpiod_request_config* config) {
  --library.alive;
  delete config;
}
void gpiod_request_config_set_consumer(gpiod_request_config*, const char*) {}
gpiod_line_request* gpiod_chip_request_lines(gpiod_chip*, gpiod_request_config*,
                                             gpiod_line_config* config) {
  if (library.refuse_request != 0) {
    errno = library.refuse_request;
    return nullptr;
  }
  library.settings = config->settings;
  for (const unsigned int offset : config->offsets) {
    library.lines[offset].value = config->settings.value == GPIOD_LINE_VALUE_ACTIVE ? 1 : 0;
  }
  return made(new gpiod_line_request{config->offsets});
}
void gpiod_line_request_release(gpiod_line_request* request) {
  --library.alive;
  delete request;
}
int gpiod_line_request_set_values(gpiod_line_request* request, const gpiod_line_value* values) {
  if (library.refuse_value != 0) {
    errno = library.refuse_value;
    return -1;
  }
  for (std::size_t i = 0; i < request->offsets.size(); ++i) {
    library.lines[request->offsets[i]].value = values[i] == GPIOD_LINE_VALUE_ACTIVE ? 1 : 0;
  }
  return 0;
}
}

namespace tubesight::tests {
namespace {

class GpiodLineBank : public testing::Test {
 protected:
  void SetUp() override {
    library = {};
    library.lines[1].name = "GPIO18";
    library.lines[3].used = true;
    library.lines[3].user = "spi0";
  }
  std::string refused(const drivers::LineBankSettings& settings) {
    std::string message;
    EXPECT_FALSE(bank_->open(settings, message));
    EXPECT_EQ(library.alive, 0) << "nothing stays open";
    return message;
  }
  std::unique_ptr<drivers::LineBank> bank_ = drivers::make_gpiod_line_bank();
};

TEST_F(GpiodLineBank, TakesLinesByNumberAndByNameAndAllDark) {
  std::string message;
  ASSERT_TRUE(bank_->open({"/dev/lamp", {"2", "GPIO18"}, false}, message)) << message;
  EXPECT_EQ(library.lines[1].value, 0);
  EXPECT_EQ(library.lines[2].value, 0);
  EXPECT_FALSE(library.settings.active_low);
  EXPECT_EQ(library.settings.direction, GPIOD_LINE_DIRECTION_OUTPUT);
  EXPECT_EQ(library.alive, 1) << "the request alone";

  EXPECT_EQ(bank_->set(1), 0);
  EXPECT_EQ(library.lines[2].value, 1) << "the first of the list";
  EXPECT_EQ(library.lines[1].value, 0);
  EXPECT_EQ(bank_->set(2), 0);
  EXPECT_EQ(library.lines[2].value, 0);
  EXPECT_EQ(library.lines[1].value, 1);

  bank_->close();
  EXPECT_EQ(library.alive, 0);
}

TEST_F(GpiodLineBank, ALampThatShinesWhileLowIsTheLibrarysToInvert) {
  std::string message;
  ASSERT_TRUE(bank_->open({"/dev/lamp", {"0"}, true}, message));

  EXPECT_TRUE(library.settings.active_low);
  EXPECT_EQ(library.settings.value, GPIOD_LINE_VALUE_INACTIVE);
}

TEST_F(GpiodLineBank, SaysWhatIsWrong) {
  EXPECT_EQ(refused({"/dev/other", {"0"}, false}),
            "there is no such chip, or it is not ours: No such file or directory");
  EXPECT_EQ(refused({"/dev/lamp", {"4"}, false}), "has no line '4', expected one of its 4");
  EXPECT_EQ(refused({"/dev/lamp", {"LAMP"}, false}), "has no line 'LAMP', expected one of its 4");
  EXPECT_EQ(refused({"/dev/lamp", {"3"}, false}), "line '3' is used by 'spi0', expected it free");
  library.refuse_request = EPERM;
  EXPECT_EQ(refused({"/dev/lamp", {"0"}, false}),
            "does not give its lines: Operation not permitted");
}

TEST_F(GpiodLineBank, ARefusedValueIsTold) {
  std::string message;
  ASSERT_TRUE(bank_->open({"/dev/lamp", {"0"}, false}, message));
  library.refuse_value = ENODEV;

  EXPECT_EQ(bank_->set(1), -ENODEV);
}

}  // namespace
}  // namespace tubesight::tests
