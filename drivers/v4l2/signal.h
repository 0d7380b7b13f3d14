#pragma once

#include <cstdint>

namespace tubesight::drivers::v4l2 {

/// What a driver says of the signal at its input.
enum class Signal : std::uint8_t {
  kGood,           ///< or it says nothing
  kNone,           ///< none comes in
  kOtherStandard,  ///< it is of another standard than the input is set to
};

}  // namespace tubesight::drivers::v4l2
