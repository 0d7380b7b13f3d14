#pragma once

#include <cstdint>
#include <string>

namespace tubesight::board {

/// What a run of the golden recording came to.
struct GoldenResult {
  bool ran = false;
  bool good = false;
  std::string words;  ///< for a person
};

/// What it has to come to: digests of all pictures and of all sightings.
struct GoldenDigests {
  std::uint64_t pictures = 0;
  std::uint64_t sightings = 0;
};

/// Of this version of the program; a change of the tracking that is meant changes `sightings`.
extern const GoldenDigests kGolden;

/// Tracks a recording whose answers are known, with the code that tracks the robot's tool: whether
/// this machine computes what all others do, to the bit.
///
/// Thirty-two fields of half the source's camera: the tool rests under one tube, goes to the next,
/// and rests there. They are drawn here, with + - x / and square roots alone, so that every machine
/// draws the same bytes; a digest holds them to it. Some tens of milliseconds, and 1 MB of heap.
[[nodiscard]] GoldenResult run_golden_recording(const GoldenDigests& expected = kGolden);

}  // namespace tubesight::board
