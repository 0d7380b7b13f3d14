#include "board/box/version.h"

#include "core/base/scalar.h"

namespace tubesight::board {
namespace {

template <typename Number>
std::string format_of(const char* quantity) {
  constexpr int kBits = 32;
  return std::string(quantity) + " " + std::to_string(kBits - Number::kFractionBits) + "." +
         std::to_string(Number::kFractionBits);
}

}  // namespace

const char* program_version() { return TUBESIGHT_VERSION; }

std::string program_arithmetic() {
  using core::FixedPoint;
  return "fixed point, bits before and after it: " + format_of<core::Px<FixedPoint>>("pixels") +
         ", " + format_of<core::Mm<FixedPoint>>("millimetres") + ", " +
         format_of<core::Unit<FixedPoint>>("rotations") + ", " +
         format_of<core::Ratio<FixedPoint>>("image plane");
}

std::string version_text(const std::string& name) {
  return name + " " + program_version() + "\ncommit " + program_commit() + "\narithmetic " +
         program_arithmetic();
}

}  // namespace tubesight::board
