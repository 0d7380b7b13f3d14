#pragma once

#include <cstdint>

namespace tubesight::core::rendering {

/// The largest picture that a renderer draws, either side: what lies beyond is no tool camera's.
inline constexpr std::int32_t kMaxPictureSide = 2048;

}  // namespace tubesight::core::rendering
