#pragma once

#include <cstdint>

#include "core/base/result.h"
#include "core/base/settings.h"
#include "core/base/static_vector.h"
#include "core/base/tube_address.h"

namespace tubesight::core::tubesheet {

/// What stands where on one tubesheet: open tube-ends, known plugs, voids. About 260 KB.
class SheetMap {
 public:
  /// Takes the sheet's extent and lists over. kInvalidArgument when first exceeds last.
  [[nodiscard]] Result<void> assign(const TubesheetSettings& settings);

  /// What the settings say of an address; kAbsent outside the sheet. Costs two binary searches.
  [[nodiscard]] TubeState state(TubeAddress address) const;

 private:
  using List = StaticVector<TubeAddress, kMaxListedTubes>;

  TubeAddress first_{};
  TubeAddress last_{};
  AddressParity addresses_ = AddressParity::kAll;
  List missing_;  // sorted
  List plugged_;  // sorted
};

}  // namespace tubesight::core::tubesheet
