#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "core/base/field.h"
#include "core/base/image_view.h"
#include "core/base/sighting.h"
#include "core/lighting/brightness_trail.h"
#include "core/lighting/lamp_pattern.h"
#include "core/lighting/lamp_policy.h"
#include "core/lighting/level_control.h"
#include "core/lighting/light_fall.h"
#include "core/lighting/pattern_watch.h"
#include "core/lighting/tube_light.h"

namespace tubesight::core::lighting {

/// The lamp's closed loop: which level is wanted, whether the picture follows it, how the lamp is.
///
/// Integers alone; one thread; no heap, no clock. Without a policy it does and says nothing. Some
/// 10 KB, and 500 instructions a tube-end.
class Lighting {
 public:
  /// From now on by this policy, from the beginning.
  void take(const LampPolicy& policy);

  /// Whether the box decides on the lamp's level, wholly or by a swing.
  [[nodiscard]] bool rules() const { return policy_.pattern || policy_.follows_picture; }

  /// Whether there is a level of its own, which follows the picture.
  [[nodiscard]] bool follows_picture() const { return policy_.follows_picture; }

  /// What one field shows.
  struct Look {
    const Field* field = nullptr;
    std::span<const TubeSighting> tubes;  ///< measured in it
    PixelBox window;                      ///< to be looked at where none is known
    bool knows_place = false;             ///< the tube-ends' addresses can be relied on
    bool still = false;                   ///< the tool is known to rest
  };

  /// Takes a field. One without pixels tells nothing.
  void look(const Look& look);

  /// The level for the next field; `commanded` wins over the picture's.
  [[nodiscard]] std::int32_t wanted_permille(std::optional<std::int32_t> commanded, FieldTime now);

  [[nodiscard]] Liveness liveness() const { return watch_.liveness(); }
  /// Whether the picture that was seen to follow does so no more, though it is not certain yet:
  /// nothing in it is to be relied on.
  [[nodiscard]] bool doubts() const { return watch_.doubts(); }
  [[nodiscard]] LampCondition condition() const;
  [[nodiscard]] const PatternWatch& watch() const { return watch_; }

  /// The members of the state; see core/base/state_stream.h. The list is written before it is read.
  template <typename Self, typename Stream>
  static void transfer(Self& self, Stream& stream) {
    auto& [policy, pattern, control, trail, watch, lights, dark, weak, breakdown, fall] = self;
    stream(policy, pattern, control, trail, watch, dark, weak, breakdown, fall);
  }

 private:
  /// Something that counts when it has lasted.
  struct Lasting {
    FieldTime since{-1};  ///< below 0: it is not so
    bool long_enough = false;

    void follow(bool so, FieldTime now, FieldTime enough);
    template <typename Self, typename Stream>
    static void transfer(Self& self, Stream& stream) {
      auto& [from, lasts] = self;
      stream(from, lasts);
    }
  };

  /// Light that breaks down at once while the level stays.
  class Breakdown {
   public:
    void follow(const Field& field, std::optional<std::int32_t> change_q16);
    void clear() { broken_ = false; }
    [[nodiscard]] bool broken() const { return broken_; }

    template <typename Self, typename Stream>
    static void transfer(Self& self, Stream& stream) {
      auto& [fall, level, steady_since, is_broken] = self;
      stream.number(fall, -(1 << 24), 1 << 24);
      stream.number(level, 0, kFullLamp_permille);
      stream(steady_since, is_broken);
    }

   private:
    std::int32_t fall_q16_ = 0;  ///< of the last fifth of a second, about
    std::int32_t level_permille_ = 0;
    FieldTime steady_since_{0};  ///< the level is that one, but for its swing
    bool broken_ = false;
  };

  void watch_lamp(const Field& field, bool knows_place);

  LampPolicy policy_{};
  LampPattern pattern_{};
  LevelControl control_{};
  BrightnessTrail trail_{};
  PatternWatch watch_{};
  TubeLightList lights_{};  ///< of this field
  Lasting dark_{};
  Lasting weak_{};
  Breakdown breakdown_{};
  LightFall fall_{};
};

}  // namespace tubesight::core::lighting
