#pragma once

#include <string>

#include "core/base/result.h"

namespace tubesight::drivers {

/// Where settings files are read from: the file system, or memory in tests and fuzzing.
class TextFiles {
 public:
  virtual ~TextFiles() = default;

  /// Reads all of a file. Errors: kIo, kOutOfRange too long; `message` says why without the name.
  [[nodiscard]] virtual core::Result<void> read(const std::string& path, std::string& text,
                                                std::string& message) = 0;
};

/// Settings files of the file system, up to 16 MiB each.
class DiskFiles final : public TextFiles {
 public:
  [[nodiscard]] core::Result<void> read(const std::string& path, std::string& text,
                                        std::string& message) override;
};

}  // namespace tubesight::drivers
