#pragma once

#include <cstdint>

#include "core/base/field.h"
#include "core/base/image_view.h"
#include "core/tracking/motion.h"
#include "core/tracking/picture_memory.h"

namespace tubesight::core::tracking {

/// Finds pictures that were seen before: the frame store stopped, as a whole or in parts, or the
/// field is torn.
///
/// What a source does is learnt from the tool's own rests. Where each picture has noise of its own,
/// four blocks that are equal to the last bit are old ones, whatever the rest of the picture shows;
/// and a picture that comes again under noise that was added behind the store lacks what the sensor
/// adds, so its differences are quieter. Where blocks come again at rest (compressed, drawn or
/// averaged pictures) neither tells anything, and a store that stops at rest is not found. In
/// motion no edge of any source stands still. Until something is learnt no picture is called old
/// for its noise. Integers alone.
class OldPictureWatch {
 public:
  /// What a tool's rest shows of the source.
  enum class Source : std::uint8_t {
    kUnknown,    ///< there was no rest yet
    kNoisy,      ///< each picture has noise of its own
    kRepeating,  ///< a quarter of the blocks or more come again
  };

  /// A new start: nothing is remembered or learnt.
  void begin() { *this = {}; }

  /// Whether the picture, or a part of it, was seen before. Call once for each field with pixels;
  /// `moves`: the fields before show a motion of some pixels a field. The window lies in the
  /// picture.
  [[nodiscard]] bool shows_old(const Field& field, const PixelBox& window, bool moves);

  /// Whether pictures have been old, believed while their edges stood, and old again: a store that
  /// holds a field of each parity shows the tool going to and fro, which now and then looks like
  /// the end of its motion. A live picture shows fresh edges in between.
  [[nodiscard]] bool stays_old() const { return aged_ == Aged::kOldAgain; }

  /// The field looked at last was believed; `rest`: how far it shows the tool standing still.
  void believe(Rest rest);

  [[nodiscard]] Source source() const { return source_; }

  /// The members of the state; see core/base/state_stream.h.
  template <typename Self, typename Stream>
  static void transfer(Self& self, Stream& stream) {
    auto& [memory, source, quiet, likeness, rested, still, unequal, most_equal, learnt, noise, grey,
           contrast, aged] = self;
    stream(memory);
    stream.choice(source, Source::kRepeating);
    stream(quiet, likeness);
    stream.number(rested, 0, 1 << 30);
    stream.number(still, 0, 1 << 30);
    stream.number(unequal, 0, kMostUnequal);
    stream.number(most_equal, 0, 1 << 10);
    stream.number(learnt, 0, kMostLearnt);
    stream.number(noise, 0, 1 << 28);
    stream.number(grey, 0, 1 << 12);
    stream.number(contrast, 0, 1 << 24);
    stream.choice(aged, Aged::kOldAgain);
  }

 private:
  static constexpr std::int32_t kMostLearnt = 16;  ///< fields that the usual noise is the mean of
  static constexpr std::int32_t kMostUnequal = 256;

  /// What was seen since a picture was old.
  enum class Aged : std::uint8_t {
    kFresh,  ///< none was, or edges that do not stand
    kOld,    ///< nothing but old pictures
    kStood,  ///< pictures that were not taken to be old, though their edges stood
    kOldAgain,
  };

  [[nodiscard]] std::int32_t expected_noise() const;
  [[nodiscard]] bool is_quiet() const;
  void learn_source();
  void learn_noise();
  void age(bool old, bool standing);

  PictureMemory memory_{};
  Source source_ = Source::kUnknown;
  bool quiet_ = false;           ///< the last field had too little noise
  PictureLikeness likeness_{};   ///< of the last field that was looked at
  std::int32_t rested_ = 0;      ///< believed fields in a row with the tool at rest, or nearly
  std::int32_t still_ = 0;       ///< of those, the last ones that were no less than still
  std::int32_t unequal_ = 0;     ///< blocks looked at in this rest, as long as none was equal
  std::int32_t most_equal_ = 0;  ///< blocks of a noisy picture that were equal by chance
  std::int32_t learnt_ = 0;      ///< fields that the two below are learnt from
  std::int32_t noise_q4_ = 0;    ///< of a block at rest, as in PictureLikeness
  std::int32_t grey_q4_ = 0;     ///< of the blocks that showed it
  std::int32_t contrast_ = 0;    ///< of the pictures that showed it
  Aged aged_ = Aged::kFresh;
};

}  // namespace tubesight::core::tracking
