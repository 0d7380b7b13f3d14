#include "board/visionbox/lamp_device.h"

#include "board/visionbox/panic_dimmer.h"

namespace tubesight::board {
namespace {

template <typename Driver>
class DrivenLamp final : public LampDevice {
 public:
  template <typename Settings>
  explicit DrivenLamp(const Settings& settings) : dimmer_(settings) {}

  [[nodiscard]] hal::Dimmer& dimmer() override { return panic_; }
  [[nodiscard]] const std::string& message() const override { return dimmer_.message(); }

 private:
  Driver dimmer_;
  PanicDimmer panic_{dimmer_};  // between keeper and device: a keeper's level takes a thread's turn
};

}  // namespace

std::unique_ptr<LampDevice> make_lamp(const LampSettings& settings) {
  switch (settings.kind) {
    case LampKind::kNone: break;
    case LampKind::kPwm: return std::make_unique<DrivenLamp<drivers::PwmDimmer>>(settings.pwm);
    case LampKind::kGpio: return std::make_unique<DrivenLamp<drivers::GpioDimmer>>(settings.gpio);
  }
  return nullptr;
}

std::string make_dark(LampDevice& lamp) {
  // A dimmer is dark from its start on.
  if (!lamp.dimmer().start()) {
    return lamp.message();
  }
  lamp.dimmer().stop();
  return {};
}

}  // namespace tubesight::board
