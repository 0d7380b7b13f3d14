#include "board/bench/campaign/stratum.h"

#include <array>
#include <string_view>

namespace tubesight::board::campaign {
namespace {

using Names = std::string_view;

constexpr std::array<Names, 2> kPitches = {"square", "triangular"};
constexpr std::array<Names, 2> kMountings = {"upright", "turned"};
constexpr std::array<Names, 2> kWelds = {"flush", "fillet"};
constexpr std::array<Names, kFaultGroups> kFaults = {"none", "stream",    "picture",
                                                     "lamp", "mechanics", "jump"};
constexpr std::array<Names, kSpeedBands> kSpeeds = {"slow", "fast"};

template <typename Kind>
Kind take(std::int32_t& rest, std::int32_t count) {
  const auto kind = static_cast<Kind>(rest % count);
  rest /= count;
  return kind;
}

template <typename Kind, std::size_t Count>
std::string_view word(const std::array<Names, Count>& names, Kind kind) {
  return names[static_cast<std::size_t>(kind)];
}

}  // namespace

Stratum stratum_at(std::int32_t index) {
  Stratum stratum;
  stratum.pitch = take<Pitch>(index, 2);
  stratum.mounting = take<Mounting>(index, 2);
  stratum.weld = take<WeldKind>(index, 2);
  stratum.fault = take<FaultGroup>(index, kFaultGroups);
  stratum.speed = take<SpeedBand>(index, kSpeedBands);
  return stratum;
}

std::int32_t stratum_of_move(std::int64_t move) {
  return static_cast<std::int32_t>(move % kStrata);
}

std::string name_of(const Stratum& stratum) {
  std::string name(word(kPitches, stratum.pitch));
  for (const std::string_view part :
       {word(kMountings, stratum.mounting), word(kWelds, stratum.weld),
        word(kFaults, stratum.fault), word(kSpeeds, stratum.speed)}) {
    name += '/';
    name += part;
  }
  return name;
}

std::int32_t find_stratum(const std::string& name) {
  for (std::int32_t index = 0; index < kStrata; ++index) {
    if (name_of(stratum_at(index)) == name) {
      return index;
    }
  }
  return -1;
}

}  // namespace tubesight::board::campaign
