#include "drivers/files/pairs_file.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "drivers/files/atomic_file.h"
#include "drivers/files/csv_reader.h"
#include "drivers/files/decimal.h"
#include "drivers/files/messages.h"

namespace tubesight::drivers {
namespace {

using core::Error;
using core::Result;
using core::Unexpected;

constexpr std::int64_t kMillimetre_nm = 1'000'000;
constexpr std::int64_t kDegree_ndeg = 1'000'000'000;

/// Far above 256 rows of a person's longest names; a file of another kind is not read whole.
constexpr std::int64_t kMostBytes = 1 << 20;

std::string joint_column(std::int32_t joint) { return "joint_" + std::to_string(joint) + "_deg"; }

void append_three(std::string& out, const std::array<std::int64_t, 3>& values, std::int64_t scale,
                  std::int32_t digits, bool told = true) {
  for (const std::int64_t value : values) {
    out += ',';
    if (told) {
      append_decimal(out, value, scale, digits);
    }
  }
}

std::string header(std::int32_t joints) {
  std::string text;
  for (const std::string_view column : pair_columns()) {
    text += text.empty() ? "" : ",";
    text += column;
  }
  for (std::int32_t i = 1; i <= joints; ++i) {
    text += "," + joint_column(i);
  }
  return text + '\n';
}

/// N of "pN"; 0 of any other name.
std::int64_t number_of(std::string_view name) {
  std::int64_t number = 0;
  constexpr std::int64_t kMost = 1'000'000'000;
  const bool counted = name.starts_with('p') && parse_whole(name.substr(1), number);
  return counted && number > 0 && number < kMost ? number : 0;
}

/// Empty where there is none. False: it is there and cannot be read.
bool read_whole(const std::string& path, std::string& text, std::string& message) {
  text.clear();
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (file < 0) {
    if (errno == ENOENT) {
      return true;
    }
    message = path + ": " + std::strerror(errno);
    return false;
  }
  struct stat about {};
  const bool regular = fstat(file, &about) == 0 && S_ISREG(about.st_mode);
  if (!regular || about.st_size > kMostBytes) {
    close(file);
    message = path + (regular ? ": of more than 1 MB" : ": no file") + ", expected pairs";
    return false;
  }
  std::array<char, 4096> piece{};
  ssize_t got = 0;
  while ((got = read(file, piece.data(), piece.size())) > 0) {
    text.append(piece.data(), static_cast<std::size_t>(got));
  }
  if (got < 0) {
    message = path + ": " + std::strerror(errno);
  }
  close(file);
  return got == 0;
}

}  // namespace

const std::vector<std::string_view>& pair_columns() {
  static const std::vector<std::string_view> columns = {"name",
                                                        "robot_x_mm",
                                                        "robot_y_mm",
                                                        "robot_z_mm",
                                                        "robot_alpha_deg",
                                                        "robot_beta_deg",
                                                        "robot_gamma_deg",
                                                        "tool_x_mm",
                                                        "tool_y_mm",
                                                        "tool_z_mm",
                                                        "tool_alpha_deg",
                                                        "tool_beta_deg",
                                                        "tool_gamma_deg",
                                                        "sigma_x_mm",
                                                        "sigma_y_mm",
                                                        "sigma_z_mm",
                                                        "use"};
  return columns;
}

bool PairsText::begin(std::string text, const std::string& name, std::string& message) {
  *this = {};
  name_ = name;
  text_ = std::move(text);
  if (text_.empty()) {
    return true;
  }
  Messages messages;
  CsvReader reader(text_, name);
  if (!reader.read_header(pair_columns(), messages)) {
    message = messages.front();
    return false;
  }
  joints_ = 0;
  while (joints_ < core::kMaxToldJoints && reader.find_column(joint_column(joints_ + 1))) {
    ++joints_;
  }
  // A column of which nothing is known cannot be filled.
  if (reader.columns() != pair_columns().size() + static_cast<std::size_t>(joints_)) {
    message = reader.place() + "further columns, expected none but joint_1_deg and so on";
    return false;
  }
  while (reader.next(messages)) {
    ++rows_;
    last_ = std::max(last_, number_of(reader.cells()[0]));
  }
  if (!messages.empty()) {
    message = messages.front();
    return false;
  }
  if (text_.back() != '\n') {
    text_ += '\n';
  }
  return true;
}

bool PairsText::append(const core::PosePair& pair, std::string& message) {
  if (rows_ >= kMostRows) {
    message = name_ + ": has " + std::to_string(rows_) + " pairs, expected at most " +
              std::to_string(kMostRows) + ": move it away, and another begins";
    return false;
  }
  if (joints_ < 0) {
    joints_ = pair.robot.joints;
    text_ = header(joints_);
  }
  if (joints_ != pair.robot.joints) {
    message = name_ + ": has " + std::to_string(joints_) +
              " joints' angles a row, the robot told " + std::to_string(pair.robot.joints) +
              ", expected the same: move it away, and another begins";
    return false;
  }
  text_ += 'p';
  append_whole(text_, ++last_);
  append_three(text_, pair.robot.position_nm, kMillimetre_nm, 4);
  append_three(text_, pair.robot.angles_ndeg, kDegree_ndeg, 5, pair.robot.turned);
  append_three(text_, pair.seen.position_nm, kMillimetre_nm, 4);
  append_three(text_, pair.seen.angles_ndeg, kDegree_ndeg, 5);
  append_three(text_, pair.seen.position_sigma_nm, kMillimetre_nm, 4);
  text_ += ",1";
  for (std::int32_t i = 0; i < joints_; ++i) {
    text_ += ',';
    append_decimal(text_, pair.robot.joints_ndeg[static_cast<std::size_t>(i)], kDegree_ndeg, 5);
  }
  text_ += '\n';
  ++rows_;
  return true;
}

std::string PairsText::text() const { return joints_ < 0 ? header(0) : text_; }

std::string why_no_pairs(const std::string& path) {
  std::string text;
  std::string message;
  PairsText pairs;
  static_cast<void>(read_whole(path, text, message) && pairs.begin(std::move(text), path, message));
  return message;
}

Result<void> append_pair(const std::string& path, const core::PosePair& pair,
                         std::string& message) {
  std::string text;
  if (!read_whole(path, text, message)) {
    return Unexpected(Error::kIo);
  }
  PairsText pairs;
  if (!pairs.begin(std::move(text), path, message) || !pairs.append(pair, message)) {
    return Unexpected(Error::kInvalidArgument);
  }
  AtomicFile file;
  if (!file.open(path) || !file.write(pairs.text()) || !file.commit_to_disk()) {
    message = file.message();
    return Unexpected(Error::kIo);
  }
  return {};
}

}  // namespace tubesight::drivers
