#pragma once

#include <string>

#include "board/bench/output/exit_status.h"

namespace tubesight::board {

/// The arguments of `tubesight new`, as text; an empty one was not given.
struct NewOptions {
  std::string session;
  std::string video;
  std::string camera;    ///< a file with [camera], or YAML of OpenCV, ROS or Kalibr
  std::string focal_mm;  ///< EFL, in place of `camera`
  std::string pixel_um;  ///< "P" or "W,H", with `focal_mm`
  std::string scan;
  std::string lattice;  ///< "square" or "triangular"
  std::string pitch_mm;
  std::string bore_mm;
  std::string weld;
  std::string tool_mm;   ///< "X,Y,Z", the guidetube's tip in the camera frame
  std::string tool_deg;  ///< "ALPHA,BETA,GAMMA"
  std::string at;        ///< "R,C": the address of the tube-end in the picture's middle
};

/// `tubesight new`: writes a commented session for a video.
///
/// What the options do not tell is asked for where standard input is a terminal; else it is a
/// mistake, all of them told at once. The session is read back before it is written. A file that
/// is there is not written over.
[[nodiscard]] ExitStatus run_new(const NewOptions& options);

}  // namespace tubesight::board
