#include "core/tubesheet/sheet_map.h"

#include <algorithm>

#include "core/tubesheet/addresses.h"

namespace tubesight::core::tubesheet {

Result<void> SheetMap::assign(const TubesheetSettings& settings) {
  if (settings.rows[0] > settings.rows[1] || settings.columns[0] > settings.columns[1]) {
    return Unexpected(Error::kInvalidArgument);
  }
  first_ = {settings.rows[0], settings.columns[0]};
  last_ = {settings.rows[1], settings.columns[1]};
  addresses_ = settings.addresses;
  missing_ = settings.missing;
  plugged_ = settings.plugged;
  std::sort(missing_.begin(), missing_.end());
  std::sort(plugged_.begin(), plugged_.end());
  return {};
}

TubeState SheetMap::state(TubeAddress address) const {
  if (address.row < first_.row || address.row > last_.row || address.column < first_.column ||
      address.column > last_.column) {
    return TubeState::kAbsent;
  }
  if (!exists(addresses_, address)) {
    return TubeState::kAbsent;
  }
  if (std::binary_search(missing_.begin(), missing_.end(), address)) {
    return TubeState::kAbsent;
  }
  return std::binary_search(plugged_.begin(), plugged_.end(), address) ? TubeState::kPlugged
                                                                       : TubeState::kOpen;
}

}  // namespace tubesight::core::tubesheet
