// States: whatever the bytes, they are refused, or a session goes on from them without harm. Head
// and check sum are made right, so that what lies behind them is reached.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <span>
#include <vector>

#include "core/base/state_stream.h"
#include "core/session/session.h"

namespace {

using namespace tubesight::core;
using FixedSession = session::Session<FixedPoint>;

constexpr std::size_t kHeadBytes = 40;
constexpr std::size_t kCheckBytes = 8;
constexpr std::int32_t kWidth_px = 128;
constexpr std::int32_t kHeight_px = 96;

void require(bool holds) {
  if (!holds) {
    std::abort();
  }
}

/// An ordinary camera of a fifth of the pixels, so that a step is fast.
std::unique_ptr<SessionSettings> make_settings() {
  auto settings = std::make_unique<SessionSettings>();
  CameraSettings& camera = settings->camera;
  camera.width_px = kWidth_px;
  camera.height_px = kHeight_px;
  camera.focal_length_mm = 5.06;
  camera.cell_width_mm = 0.042;
  camera.cell_height_mm = 0.049;
  camera.sensor_columns = 154;
  camera.frame_columns = kWidth_px;
  camera.horizontal_scale = 1.021;
  camera.center_px = {64.0, 47.0};
  camera.distortion_per_mm2 = 0.0092;
  settings->tool = {{-3.074, 31.629, 112.789}, {-0.0639, -0.8174, 47.9947}};
  TubesheetSettings& sheet = settings->tubesheet;
  sheet.row_step_mm = {0.0, 25.4};
  sheet.column_step_mm = {25.4, 0.0};
  sheet.bore_mm = 18.6;
  sheet.rows = {0, 120};
  sheet.columns = {0, 120};
  settings->start.window_px = {4, 4, 123, 70};
  settings->start.optimum_px = {64.0, 38.0};
  return settings;
}

const SessionSettings& settings() {
  static const auto made = make_settings();
  return *made;
}

void step_some(FixedSession& session) {
  static std::vector<std::uint8_t> picture = [] {
    std::vector<std::uint8_t> pixels(static_cast<std::size_t>(kWidth_px * kHeight_px));
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      pixels[i] = static_cast<std::uint8_t>((i * 7919) >> 4);
    }
    return pixels;
  }();
  const auto input = std::make_unique<session::Input>();
  const auto output = std::make_unique<session::Output>();
  Field& field = input->field;
  for (std::int64_t i = 0; i < 4; ++i) {
    field.number = 100 + i;
    field.sequence = 100 + i;
    field.mid_exposure = FieldTime(2'000'000'000 + 16'666'667 * i);
    field.parity = i % 2 == 0 ? Parity::kEven : Parity::kOdd;
    field.pixels = field_of({picture.data(), kWidth_px, kHeight_px, kWidth_px}, field.parity);
    input->events.clear();
    Event event;
    event.at = field.mid_exposure;
    event.content = Claim{{40, 60}};
    require(input->events.try_push_back(event));
    event.content = Pick{{60.0, 30.0}, {}};
    require(input->events.try_push_back(event));
    session.step(*input, *output);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto session = std::make_unique<FixedSession>();
  require(session->configure(settings()).has_value());
  // As it is, and with a head that is right.
  static_cast<void>(session->restore(std::as_bytes(std::span(data, size))));
  const auto whole = std::make_unique<FixedSession>();
  require(whole->configure(settings()).has_value());
  if (size < kHeadBytes + kCheckBytes) {
    return 0;
  }
  std::vector<std::byte> bytes(FixedSession::state_bytes());
  require(whole->save(bytes).has_value());
  bytes.resize(kHeadBytes - 8);
  const std::uint64_t length = size - kHeadBytes - kCheckBytes;
  for (int i = 0; i < 8; ++i) {
    bytes.push_back(static_cast<std::byte>(length >> (8 * i)));
  }
  for (std::size_t i = kHeadBytes; i < size - kCheckBytes; ++i) {
    bytes.push_back(static_cast<std::byte>(data[i]));
  }
  StateDigest digest;
  digest.add(bytes);
  for (int i = 0; i < 8; ++i) {
    bytes.push_back(static_cast<std::byte>(digest.value() >> (8 * i)));
  }
  const auto restored = whole->restore(bytes);
  if (restored) {
    step_some(*whole);
  } else {
    require(restored.error() == Error::kOutOfRange);
  }
  return 0;
}
