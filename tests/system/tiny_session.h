#pragma once

#include <string>

#include "tests/support/temporary_folder.h"

namespace tubesight::tests {

/// Settings of a small camera before an ordinary tubesheet, one entry a line.
///
/// Line 1 is `[camera]`, line 2 its width_px; tests that spoil a line count on it.
[[nodiscard]] inline std::string tiny_session() {
  return "[camera]\n"                                                 // 1
         "width_px = 96\n"                                            // 2
         "height_px = 80\n"                                           // 3
         "scan = \"even-first\"\n"                                    // 4
         "focal_length_mm = 5.06\n"                                   // 5
         "cell_width_mm = 0.0084\n"                                   // 6
         "cell_height_mm = 0.0098\n"                                  // 7
         "sensor_columns = 768\n"                                     // 8
         "frame_columns = 635\n"                                      // 9
         "horizontal_scale = 1.021\n"                                 // 10
         "center_px = [48, 40]\n"                                     // 11
         "distortion_per_mm2 = 0.0092\n"                              // 12
         "[tool]\n"                                                   // 13
         "position_mm = [-3.074, 31.629, 112.789]\n"                  // 14
         "rotation_deg = [-0.0639, -0.8174, 47.9947]\n"               // 15
         "[tubesheet]\n"                                              // 16
         "row_step_mm = [0.0, 25.4]\n"                                // 17
         "column_step_mm = [25.4, 0.0]\n"                             // 18
         "bore_mm = 18.6\n"                                           // 19
         "rows = [0, 120]\n"                                          // 20
         "columns = [0, 120]\n"                                       // 21
         "[start]\n"                                                  // 22
         "tubes = [ { row = 40, column = 60, at_px = [40, 30] },\n"   // 23
         "          { row = 41, column = 60, at_px = [40, 60] },\n"   // 24
         "          { row = 40, column = 61, at_px = [70, 30] } ]\n"  // 25
         "window_px = [10, 8, 85, 75]\n";                             // 26
}

/// Bytes of a frame of that camera.
inline constexpr int kTinyFrameBytes = 96 * 80;

/// First line of a recording by that camera.
inline constexpr const char* kTinyHeader = "YUV4MPEG2 W96 H80 F25:1 It Cmono";

}  // namespace tubesight::tests
