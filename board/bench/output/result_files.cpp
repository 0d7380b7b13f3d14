#include "board/bench/output/result_files.h"

#include "board/bench/output/output_paths.h"
#include "drivers/files/result_csv.h"

namespace tubesight::board {

using core::Result;
using core::Unexpected;
using drivers::AtomicFile;

Result<void> ResultFiles::open(const std::string& fields, const std::string& centers) {
  TUBESIGHT_TRY(begin(fields_, fields, drivers::kFieldsHeader));
  return begin(centers_, centers, drivers::kCentersHeader);
}

Result<void> ResultFiles::add(std::int64_t field, core::Parity parity,
                              const core::Sighting& sighting,
                              const core::tracking::TubeSightingList& tubes) {
  if (fields_.is_open()) {
    rows_.clear();
    drivers::append_fields_row(rows_, field, parity, sighting);
    TUBESIGHT_TRY(append(fields_, rows_));
  }
  if (centers_.is_open()) {
    rows_.clear();
    for (const core::TubeSighting& tube : tubes) {
      if (!tube.plug) {
        drivers::append_centers_row(rows_, field, tube);
      }
    }
    TUBESIGHT_TRY(append(centers_, rows_));
  }
  return {};
}

Result<void> ResultFiles::commit() {
  TUBESIGHT_TRY(finish(fields_));
  return finish(centers_);
}

Result<void> ResultFiles::begin(AtomicFile& file, const std::string& path,
                                std::string_view header) {
  if (path.empty()) {
    return {};
  }
  if (const auto opened = open_output(file, path); !opened) {
    message_ = file.message();
    return opened;
  }
  return append(file, std::string(header) + '\n');
}

Result<void> ResultFiles::append(AtomicFile& file, const std::string& rows) {
  const auto written = file.write(std::string_view(rows));
  if (!written) {
    message_ = file.message();
  }
  return written;
}

Result<void> ResultFiles::finish(AtomicFile& file) {
  if (!file.is_open()) {
    return {};
  }
  const auto committed = file.commit();
  if (!committed) {
    message_ = file.message();
  }
  return committed;
}

}  // namespace tubesight::board
