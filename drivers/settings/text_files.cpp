#include "drivers/settings/text_files.h"

#include <cstddef>

#include "drivers/files/byte_source.h"

namespace tubesight::drivers {

core::Result<void> DiskFiles::read(const std::string& path, std::string& text,
                                   std::string& message) {
  // The longest lists of tubes take some 300 KB.
  constexpr std::size_t kLargestFile = std::size_t{16} << 20;
  return read_whole_file(path, kLargestFile, text, message);
}

}  // namespace tubesight::drivers
