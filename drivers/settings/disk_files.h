#pragma once

#include <string>

#include "core/base/result.h"
#include "drivers/settings/text_files.h"

namespace tubesight::drivers {

/// Settings files of the file system, up to 16 MiB each.
class DiskFiles final : public TextFiles {
 public:
  [[nodiscard]] core::Result<void> read(const std::string& path, std::string& text,
                                        std::string& message) override;
};

}  // namespace tubesight::drivers
