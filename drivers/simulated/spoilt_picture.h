#pragma once

#include "drivers/simulated/dice.h"
#include "drivers/simulated/fault_schedule.h"
#include "drivers/simulated/pixel_faults.h"

namespace tubesight::drivers {

// What dirt, reflections and electronics do to a field that a person would still read; the same
// dice leave the same bytes.

/// Dark discs, as drops and dirt on the window: `share` of the field's pixels thrown, each of 14 to
/// 26 pixels radius; where they overlap fewer are hit.
void blot(const FieldPixels& field, double share, Dice& dice);

/// Reflections of a lamp: discs of 10 to 26 pixels radius, white in the middle and fading outwards.
void reflect(const FieldPixels& field, double share, Dice& dice);

/// The picture a second time, a twentieth of its width to the right, with `share` of its light.
void add_ghost(const FieldPixels& field, double share);

/// Grey levels g become black + (1 - black / 255) `share` g: less contrast on a raised black.
void raise_black(const FieldPixels& field, double black, double share);

/// The lowest `share` of the lines become `grey`, or the left of the columns: a cloth, a glare.
void cover(const FieldPixels& field, double share, double grey, bool left);

/// All of these that `faults` say, from what is before the lens to what is behind it.
void spoil(const FieldPixels& field, const FieldFaults& faults, std::uint64_t seed);

}  // namespace tubesight::drivers
