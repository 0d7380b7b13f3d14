#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/base/image_view.h"
#include "core/base/sighting.h"

namespace tubesight::drivers {

/// First line of a `--fields` file, without the line feed.
inline constexpr std::string_view kFieldsHeader =
    "field,frame,parity,time_s,state,tracked,primary_row,primary_column,primary_u_px,primary_v_px,"
    "tool_row,tool_column,tool_offset_mm,tool_height_mm,aligned,margin,reason,"
    "tool_dx_mm,tool_dy_mm,residual_px,liveness";

/// First line of a `--centers` file, without the line feed.
inline constexpr std::string_view kCentersHeader = "field,row,column,u_px,v_px,quality";

/// Appends one line of `--fields` with its line feed. `field` is the number in files: twice the
/// frame's, plus 1 for the later field of an interlaced frame. Integers alone are used, so that
/// equal sightings give equal bytes on every machine; cells that are not known stay empty.
void append_fields_row(std::string& out, std::int64_t field, core::Parity parity,
                       const core::Sighting& sighting);

/// Appends one line of `--centers` with its line feed.
void append_centers_row(std::string& out, std::int64_t field, const core::TubeSighting& tube);

}  // namespace tubesight::drivers
