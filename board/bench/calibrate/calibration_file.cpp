#include "board/bench/calibrate/calibration_file.h"

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <system_error>
#include <utility>

#include "board/bench/output/text_output.h"
#include "core/base/fnv1a.h"
#include "core/math/covariance.h"
#include "drivers/files/atomic_file.h"
#include "drivers/files/decimal.h"
#include "drivers/settings/text_files.h"
#include "drivers/settings/toml_writer.h"

namespace tubesight::board {
namespace {

/// For an id that follows the parameters.
std::string digest_of(std::string_view text) {
  core::Fnv1a hash;
  hash.add(text);
  std::array<char, 17> hex{};
  std::snprintf(hex.data(), hex.size(), "%016llx", static_cast<unsigned long long>(hash.value()));
  return hex.data();
}

std::string now_in_words() {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm utc{};
  gmtime_r(&now, &utc);
  std::array<char, 32> text{};
  static_cast<void>(std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &utc));
  return text.data();
}

/// Whole, too, whatever happens: it is what a person goes back to.
bool keep_former(const std::string& path) {
  std::string former;
  std::string why;
  if (!drivers::DiskFiles().read(path, former, why)) {
    tell(path + ": cannot be kept as " + path + ".bak: " + why);
    return false;
  }
  drivers::AtomicFile kept;
  if (!kept.open(path + ".bak") || !kept.write(former) || !kept.commit_to_disk()) {
    tell(kept.message());
    return false;
  }
  return true;
}

}  // namespace

bool read_whole(const std::string& path, std::string& text, std::vector<std::string>& messages) {
  drivers::DiskFiles files;
  std::string message;
  if (!files.read(path, text, message)) {
    messages.push_back(path + ": cannot be read: " + message);
    return false;
  }
  return true;
}

std::string with_quality(const std::string& calibrated, const CalibrationQualityText& quality) {
  drivers::TomlWriter toml(drivers::TomlManner::kPlain);
  toml.table(quality.table);
  toml.text("id", digest_of(calibrated));
  toml.text("made_at", now_in_words());
  std::array<double, 6> sigma{};
  std::string correlation = "[";
  for (int i = 0; i < 6; ++i) {
    sigma[static_cast<std::size_t>(i)] = core::math::sigma_of(quality.covariance, i);
    correlation += i > 0 ? ", [" : "[";
    for (int k = 0; k < 6; ++k) {
      drivers::print(correlation, k > 0 ? ", %.6f" : "%.6f",
                     core::math::correlation_of(quality.covariance, i, k));
    }
    correlation += ']';
  }
  toml.numbers("sigma", sigma);
  toml.raw("correlation", correlation + "]");
  toml.text("verdict", quality.verdict);
  for (const auto& [key, value] :
       {std::pair{"serial", quality.serial}, std::pair{"model", quality.model}}) {
    if (!value.empty()) {
      toml.text(key, value);
    }
  }
  return calibrated + "\n" + toml.take();
}

bool write_settings(const std::string& path, const std::string& text) {
  drivers::AtomicFile file;
  if (!file.open(path) || !file.write(text) || !file.flush()) {
    tell(file.message());
    return false;
  }
  std::error_code error;
  if (std::filesystem::is_regular_file(path, error) && !keep_former(path)) {
    return false;
  }
  if (!file.commit_to_disk()) {
    tell(file.message());
    return false;
  }
  return true;
}

}  // namespace tubesight::board
