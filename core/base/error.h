#pragma once

#include <cstdint>

namespace tubesight::core {

/// What can go wrong, shared by hal and core; each function says what its codes mean for it.
enum class Error : std::uint8_t {
  kTimeout,          ///< the time given ran out
  kNotReady,         ///< called in the wrong state
  kInvalidArgument,  ///< an argument contradicts the contract or another argument
  kOutOfRange,       ///< a value lies outside what can be represented or served
  kIo,               ///< the device or the file system reported an error
  kDisconnected,     ///< the peer or the device is gone
  kEndOfData,        ///< a finite source has no more
  kDataLoss,         ///< data arrived damaged or cut short
  kBufferTooSmall,   ///< the caller's buffer does not hold the result
  kUnsupported,      ///< a valid request that this implementation does not serve
  kIllConditioned,   ///< the geometry does not determine the answer
};

}  // namespace tubesight::core
