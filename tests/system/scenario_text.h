#pragma once

#include <string>

namespace tubesight::tests {

/// A scenario of a tenth of a second at rest, one entry a line; tests that spoil a line count on
/// it.
[[nodiscard]] inline std::string small_scenario_text() {
  return "[camera]\n"                                    // 1
         "width_px = 635\n"                              // 2
         "height_px = 480\n"                             // 3
         "scan = \"even-first\"\n"                       // 4
         "focal_length_mm = 5.06\n"                      // 5
         "cell_width_mm = 0.0084\n"                      // 6
         "cell_height_mm = 0.0098\n"                     // 7
         "sensor_columns = 768\n"                        // 8
         "frame_columns = 635\n"                         // 9
         "horizontal_scale = 1.021\n"                    // 10
         "center_px = [324.3, 233.8]\n"                  // 11
         "distortion_per_mm2 = 0.0092\n"                 // 12
         "[tool]\n"                                      // 13
         "position_mm = [-3.074, 31.629, 112.789]\n"     // 14
         "rotation_deg = [-0.0639, -0.8174, 47.9947]\n"  // 15
         "[tubesheet]\n"                                 // 16
         "row_step_mm = [0.0, 25.4]\n"                   // 17
         "column_step_mm = [25.4, 0.0]\n"                // 18
         "bore_mm = 18.6\n"                              // 19
         "rows = [0, 120]\n"                             // 20
         "columns = [0, 120]\n"                          // 21
         "[start]\n"                                     // 22
         "window_px = [40, 36, 595, 330]\n"              // 23
         "[path]\n"                                      // 24
         "tube = [40, 60]\n"                             // 25
         "height_mm = 60\n"                              // 26
         "[[step]]\n"                                    // 27
         "rest_s = 0.1\n"                                // 28
         "[[fault]]\n"                                   // 29
         "kind = \"black\"\n"                            // 30
         "at_s = 0.05\n"                                 // 31
         "for_s = 0.02\n";                               // 32
}

}  // namespace tubesight::tests
