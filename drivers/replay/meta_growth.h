#pragma once

#include <string>
#include <vector>

#include "drivers/files/messages.h"
#include "drivers/replay/replay_meta.h"

namespace tubesight::drivers {

/// Checks that time and sequence grow from row to row, and unwraps a sequence that is counted in 8,
/// 16 or 32 bits, so that it grows by as many as fields came.
///
/// Such a counter goes on at 0 behind its largest value, or at 1 when 0 stands for "none" (GigE
/// Vision); the times tell which, and how many fields were lost over it. Where they tell neither,
/// the counter went back: it was begun anew, and what was lost nobody knows. Rows of missing fields
/// have no number of their own and get that of the row before.
///
/// One message for each row that does not grow, one in all for what is the same in all rows or
/// frames; `name` stands before each.
void check_growth(std::vector<FieldMeta>& rows, const std::string& name, Messages& messages);

}  // namespace tubesight::drivers
