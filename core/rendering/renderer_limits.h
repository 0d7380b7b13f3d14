#pragma once

#include <cstdint>

namespace tubesight::core::rendering {

/// The largest picture that a renderer draws.
inline constexpr std::int32_t kMaxPictureSide = 1024;

}  // namespace tubesight::core::rendering
