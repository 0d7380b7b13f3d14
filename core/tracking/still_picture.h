#pragma once

#include <array>
#include <cstdint>

#include "core/base/field.h"
#include "core/base/image_view.h"

namespace tubesight::core::tracking {

/// Tells since which field the picture has been the same, but for noise.
///
/// For clicks into a picture that has gone by: they hold in the present one only if nothing moved
/// in between, and on a bare lattice a look at both ends does not tell, as a tool that went on by a
/// whole step shows the same picture again. So every field is compared with the one from which the
/// picture is taken to stand still: on the way to the next tube-end it must look different, and as
/// long as the tool cannot go a whole step between two fields that are compared, those of one
/// parity, one of them is seen there. A field that has none to be compared with tells nothing yet,
/// and one that is the last picture to the bit, from a camera that has noise, is no new picture.
///
/// Means of 16 pixels side by side on 16 lines over the window: some 15,000 instructions a field,
/// to be spent where no track tells more. A lamp that changes, a damaged field or one too late ends
/// the rest as well; a picture without contrast never rests. One thread; no heap.
class StillPicture {
 public:
  /// Where to look, and the longest time between two fields of one parity in which the
  /// tool cannot have gone from one tube-end to the next.
  struct Setup {
    PixelBox window;
    FieldTime longest_gap{0};
  };

  void configure(const Setup& setup) { setup_ = setup; }

  /// Begins anew with the next field.
  void forget() {
    compared_ = {};
    resting_ = false;
  }

  /// Compares a field with those before it.
  void look(const Field& field);

  /// Number of the first field from which on the picture has been that of the field looked at last;
  /// empty when that one shows nothing to compare.
  [[nodiscard]] const std::int64_t* since() const { return resting_ && told_ ? &since_ : nullptr; }

  /// The members of the state; see core/base/state_stream.h. The setup is the settings'.
  template <typename Self, typename Stream>
  static void transfer(Self& self, Stream& stream) {
    auto& [setup, reference, last, compared, last_time, since_field, sequence, noisy, resting,
           told] = self;
    stream(reference, last, compared, last_time);
    stream.number(since_field, -1, std::int64_t{1} << 62);
    stream.number(sequence, -(std::int64_t{1} << 62), std::int64_t{1} << 62);
    stream(noisy, resting, told);
  }

 private:
  static constexpr std::int32_t kLines = 16;
  static constexpr std::int32_t kBlocks = 24;
  static constexpr std::int32_t kBlock_px = 16;

  using Means = std::array<std::uint8_t, static_cast<std::size_t>(kLines* kBlocks)>;

  [[nodiscard]] bool mean_blocks(const FieldView& field, Means& means) const;
  [[nodiscard]] static bool has_contrast(const Means& means);
  [[nodiscard]] static bool alike(const Means& a, const Means& b);
  [[nodiscard]] static bool shows_noise(const Means& before, const Means& now);
  void begin(const Field& field, const Means& means);

  Setup setup_;
  std::array<Means, 3> reference_{};  ///< by parity
  std::array<Means, 3> last_{};       ///< of the last field
  std::array<bool, 3> compared_{};    ///< whether there is a reference
  std::array<FieldTime, 3> last_time_{};
  std::int64_t since_ = 0;
  std::int64_t last_sequence_ = 0;
  bool noisy_ = false;  ///< pictures at rest differ: equal ones are no new pictures
  bool resting_ = false;
  bool told_ = false;  ///< the field looked at last was compared, or began the rest
};

}  // namespace tubesight::core::tracking
