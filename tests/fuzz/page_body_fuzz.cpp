// Bodies of the page's questions: whatever the bytes, what is read of them keeps the promises that
// the session relies on, or it is not that.
#include "board/visionbox/page_body.h"

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string_view>

namespace {

using namespace tubesight;

void require(bool holds) {
  if (!holds) {
    std::abort();
  }
}

void read(const board::Json& body) {
  constexpr std::int64_t kFull_permille = 1000;
  if (const auto permille = board::whole_of(body, "permille", 0, kFull_permille)) {
    require(*permille >= 0 && *permille <= kFull_permille);
  }
  if (const auto u = board::px_of(body, "u")) {
    require(std::isfinite(*u));
  }
  if (const auto field = board::field_of(body)) {
    require(*field >= 0);
  }
  core::Start start;
  if (board::read_tubes(body, start)) {
    require(!start.tubes.empty());
    for (const core::StartPoint& point : start.tubes) {
      require(std::isfinite(point.at_px[0]) && std::isfinite(point.at_px[1]));
    }
  }
  static_cast<void>(board::flag_of(body, "confirmed"));
  // A string goes back to browsers as JSON, whatever stands in it.
  const board::Json told = {{"name", board::text_of(body, "name")}};
  const board::Json again = board::Json::parse(board::text(told), nullptr, false);
  require(again.is_object());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  // As PageDesk does it.
  const board::Json body = board::Json::parse(bytes, nullptr, false);
  if (body.is_object()) {
    read(body);
  }
  static_cast<void>(board::number_of(bytes));
  return 0;
}
