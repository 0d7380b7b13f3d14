#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/settings.h"
#include "core/rendering/truth.h"
#include "drivers/scenario/tubes_in_view.h"
#include "drivers/simulated/simulated_world.h"

namespace tubesight::board {

/// First line of a `NAME.truth.csv`, without the line feed; docs/file-formats.md tells the columns.
inline constexpr std::string_view kTruthHeader =
    "t,frame,field,tool_x,tool_y,tool_z,tool_alpha,tool_beta,tool_gamma,speed,cs_x,cs_y,cs_z,"
    "cs_alpha,cs_beta,cs_gamma,cs_00,cs_01,cs_02,cs_03,cs_10,cs_11,cs_12,cs_13,cs_20,cs_21,cs_22,"
    "cs_23,axis_x,axis_y,near_row,near_col,near_state,offset_mm,off_x,off_y,aligned,"
    "lamp_permille,faults,undetectable";

/// First line of a `NAME.centers.csv`, without the line feed.
inline constexpr std::string_view kTrueCentersHeader =
    "frame,field,t,row,col,state,x_f,y_f,ell_x,ell_y,half_w,half_h,rim_in_frame,occluded,bore_mm,"
    "X,Y";

/// Where a field stands in a recording: its number in files is 2 * frame + field.
struct FieldPlace {
  std::int64_t frame = 0;
  std::int32_t field = 0;  ///< 0, or 1 for the later field of an interlaced frame
};

/// The words of the faults at work, joined by "+"; empty without any.
[[nodiscard]] std::string fault_words(const drivers::FieldFaults& faults);

/// Appends the field's row of the truth with its line feed. `told` has the focal length and the
/// gate of alignment.
void append_truth_row(std::string& out, const FieldPlace& place,
                      const drivers::SimulatedField& field, const core::CameraSettings& camera,
                      double aligned_within_mm);

/// Appends a row for each of the tube-ends whose centre is in the picture.
void append_true_center_rows(std::string& out, const FieldPlace& place,
                             const drivers::SimulatedField& field,
                             const core::CameraSettings& camera,
                             const std::vector<drivers::TubeInView>& tubes);

}  // namespace tubesight::board
