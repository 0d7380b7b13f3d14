#pragma once

#include "core/base/instantiate.h"
#include "core/base/scalar.h"

namespace tubesight::core::tracking {

/// How a tracker treats the margin to the neighbouring tubes; a policy chosen at compile time.
///
/// The product's: an address is named only where reach, gate and margin allow no other.
struct MarginChecked {
  static constexpr bool kChecked = true;
};

/// The campaign's self-proof alone: the tracker rounds to the nearest tube without asking whether
/// the tool can be there, and must be found out. It is instantiated in board/bench/self_proof and
/// nowhere else, so that a box that asked for it would not link; the check `self_proof` holds the
/// libraries of a box to that.
struct MarginUnchecked {
  static constexpr bool kChecked = false;
};

}  // namespace tubesight::core::tracking

// How the source of a template on arithmetic and policy names what it is compiled for, as
// core/base/instantiate.h does: the checked policy, or, where board/bench/self_proof compiles the
// same source again (TUBESIGHT_SELF_PROOF), the unchecked one in the campaign's arithmetic.
#ifdef TUBESIGHT_SELF_PROOF
#define TUBESIGHT_INSTANTIATE_POLICY_CLASS(name) \
  template class name<::tubesight::core::FixedPoint, ::tubesight::core::tracking::MarginUnchecked>;
#define TUBESIGHT_FOR_EACH_POLICY(macro) \
  macro(::tubesight::core::FixedPoint, ::tubesight::core::tracking::MarginUnchecked)
#else
#define TUBESIGHT_INSTANTIATE_POLICY_CLASS(name) TUBESIGHT_INSTANTIATE_CLASS(name)
#define TUBESIGHT_CHECKED_POLICY(macro, S) macro(S, ::tubesight::core::tracking::MarginChecked)
#ifdef TUBESIGHT_FIXED_ONLY
#define TUBESIGHT_FOR_EACH_POLICY(macro) \
  TUBESIGHT_CHECKED_POLICY(macro, ::tubesight::core::FixedPoint)
#else
#define TUBESIGHT_FOR_EACH_POLICY(macro)                         \
  TUBESIGHT_CHECKED_POLICY(macro, ::tubesight::core::FixedPoint) \
  TUBESIGHT_CHECKED_POLICY(macro, float)                         \
  TUBESIGHT_CHECKED_POLICY(macro, double)
#endif
#endif
