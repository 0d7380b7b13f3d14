#pragma once

#include <cstdint>

#include "drivers/camera/picture_counters.h"

namespace tubesight::drivers {

/// What is the matter with a camera.
enum class CameraTrouble : std::uint8_t {
  kNone,
  kNotOpen,        ///< it was not opened yet, or could not be: messages() say why
  kNoSignal,       ///< it delivers, but its input says that no signal comes in
  kStandard,       ///< the signal is of another standard than the input is set to
  kNoise,          ///< pictures are snow
  kBlank,          ///< pictures are of one grey
  kDamaged,        ///< the driver marks its pictures as damaged, or they are cut short
  kStamps,         ///< stamps cannot be: of another clock, or going backwards
  kOrder,          ///< the driver does not say which lines a buffer holds
  kSilent,         ///< nothing came for too long
  kStream,         ///< the driver gave up the stream
  kSourceChanged,  ///< the signal's format became another one
  kSwitched,       ///< another program has chosen another input
  kAltered,        ///< another program has mirrored, turned, shifted or magnified the picture
  kGone,           ///< the device is not there any more
};

/// The trouble for a person: "no signal".
[[nodiscard]] const char* words_of(CameraTrouble trouble);

/// What a camera has come to since its first start; nothing is ever reset.
struct CameraCounters : PictureCounters {
  std::int64_t flagged = 0;         ///< buffers that the driver marked as damaged
  std::int64_t cut_short = 0;       ///< buffers with less than the picture
  std::int64_t unwritten = 0;       ///< fields with lines that the driver did not write
  std::int64_t without_signal = 0;  ///< buffers while the input said that none came in
  std::int64_t other_standard = 0;  ///< buffers of a signal of another standard
  std::int64_t wrong_stamps = 0;    ///< buffers whose stamp cannot be
  std::int64_t odd_order = 0;       ///< buffers with other fields than agreed
  std::int64_t queue_errors = 0;    ///< buffers that the driver did not take back
  std::int64_t dequeue_errors = 0;  ///< refusals to give one
  std::int64_t idle_wakes = 0;      ///< times that one was announced and none was there
  std::int64_t source_changes = 0;  ///< told by the driver, and what others switched or altered
  std::int64_t disconnects = 0;     ///< times that the device went
};

/// How a camera is doing.
struct CameraReport {
  CameraTrouble trouble = CameraTrouble::kNotOpen;
  bool counts = false;  ///< the driver's counter moves
  bool stamps = false;  ///< times are the driver's own
  CameraCounters counters;
};

}  // namespace tubesight::drivers
