#pragma once

#include <span>
#include <string>

#include "board/bench/pose_options.h"
#include "board/bench/replay_options.h"

namespace tubesight::board {

/// A file and what it is to the user, for messages.
struct NamedPath {
  std::string name;
  std::string path;
};

/// Says in one line why outputs cannot go where they are told to: two to one place, or onto a file
/// that is read. Empty when they can. Empty paths are passed over.
///
/// Pipes, terminals and devices may be named as often as one likes.
[[nodiscard]] std::string find_clash(std::span<const NamedPath> inputs,
                                     std::span<const NamedPath> outputs);

/// The same for the outputs of a replay; also a compressed video.
[[nodiscard]] std::string find_output_conflict(const ReplayOptions& options);

/// The same for the outputs of a pose.
[[nodiscard]] std::string find_output_conflict(const PoseCommandOptions& options);

}  // namespace tubesight::board
