#pragma once

#include "core/overlay/pixels.h"

/// The colours of the operator's display.
///
/// Row, column and tool keep the colours of the source's display [Fallon 6.4]; its "dark blue" is
/// lightened until it can be read on black. No two marks that carry a meaning share a colour, and
/// no two are told apart by colour alone: they differ in shape, or a letter or word says which it
/// is.
namespace tubesight::core::overlay::palette {

inline constexpr Rgb kBlack{0, 0, 0};
inline constexpr Rgb kWhite{255, 255, 255};
inline constexpr Rgb kCaption{170, 170, 170};  ///< words that explain a number
inline constexpr Rgb kUnknown{110, 110, 110};  ///< dashes in place of a number

inline constexpr Rgb kRow{255, 64, 56};      ///< row axis and row number
inline constexpr Rgb kColumn{255, 224, 32};  ///< column axis and column number
inline constexpr Rgb kTool{72, 136, 255};    ///< the tube above the guidetube
inline constexpr Rgb kAxis{224, 240, 255};   ///< where the guidetube's axis meets the sheet

inline constexpr Rgb kUsed{48, 232, 96};       ///< tube-end measured and used
inline constexpr Rgb kRejected{255, 120, 24};  ///< tube-end measured, but not believed
inline constexpr Rgb kPlug{255, 72, 255};      ///< tube-end recognised as a plug

inline constexpr Rgb kClick{255, 240, 200};       ///< a click whose start was taken
inline constexpr Rgb kClickRefused{255, 88, 72};  ///< a click whose start was refused
inline constexpr Rgb kClaim{255, 48, 88};         ///< a claim that the box contradicts

inline constexpr Rgb kWindow{0, 176, 176};  ///< search window and optimum point

inline constexpr Rgb kEstimateOpen{200, 216, 232};     ///< an open tube-end is expected here
inline constexpr Rgb kEstimatePlugged{216, 136, 216};  ///< a listed plug is expected here
inline constexpr Rgb kEstimateAbsent{144, 144, 144};   ///< no tube is expected here

inline constexpr Rgb kStateTracking{64, 216, 80};
inline constexpr Rgb kStateDegraded{255, 184, 0};
inline constexpr Rgb kStateLost{255, 40, 40};
inline constexpr Rgb kStateWaiting{255, 255, 255};

}  // namespace tubesight::core::overlay::palette
