// Settings: the text is cut at lines "#---" into session.toml, 1.toml, 2.toml ..., so that includes
// are reached too. Whatever it holds, either settings within their limits, or messages. The same as
// the file of a calibration target.
#include "drivers/settings/session_settings.h"

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <string>
#include <string_view>

#include "drivers/settings/target_settings.h"
#include "tests/fuzz/cut_files.h"

namespace {

using namespace tubesight;

void require(bool holds) {
  if (!holds) {
    std::abort();
  }
}

void check(const core::SessionSettings& settings) {
  const auto& window = settings.start.window_px;
  require(window[0] >= 0 && window[0] < window[2] && window[2] < settings.camera.width_px);
  require(window[1] >= 0 && window[1] < window[3] && window[3] < settings.camera.height_px);
  require(settings.start.tubes.size() <= core::kMaxStartPoints);
  require(settings.camera.focal_length_mm > 0.0 && settings.tubesheet.bore_mm > 0.0);
  require(std::isfinite(settings.camera.distortion_per_mm2));
  require(settings.tubesheet.rows[0] <= settings.tubesheet.rows[1]);
}

void read_target(std::string_view text) {
  drivers::TargetFile target;
  drivers::Messages messages;
  fuzz::CutFiles files(text, "session.toml");
  const bool good = drivers::load_target(files, "session.toml", target, messages).has_value();
  require(good == messages.empty());
  if (good) {
    require(target.target.rows >= 2 && target.target.dot_mm < target.target.spacing_mm);
    require(target.target.row_spacing_mm > 0.0 && !target.views.empty());
    for (const drivers::ViewSettings& view : target.views) {
      require(view.points.empty() != view.images.empty());
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const auto session = std::make_unique<drivers::SessionFile>();
  drivers::Messages messages;
  fuzz::CutFiles files({reinterpret_cast<const char*>(data), size}, "session.toml");
  const bool good = drivers::load_session_settings(files, "session.toml", drivers::kReplayNeeds,
                                                   *session, messages)
                        .has_value();
  require(good == messages.empty());
  for (const std::string& message : messages) {
    require(message.find('\n') == std::string::npos);
  }
  if (good) {
    check(session->settings);
  }
  read_target({reinterpret_cast<const char*>(data), size});
  return 0;
}
