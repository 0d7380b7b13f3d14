#pragma once

#include "core/base/field.h"
#include "core/base/reply.h"
#include "drivers/modbus/link_state.h"
#include "drivers/modbus/register_image.h"
#include "drivers/modbus/zone_corrections.h"

namespace tubesight::drivers {

/// Age of a field at which the robot is told nothing of it any more.
inline constexpr core::FieldTime kSightingLasts = std::chrono::milliseconds(100);

// From what the box says to the registers that say it. Where a value is not known, its bit is off
// and the register holds "unknown". No heap; any thread.

/// The blocks identity and health, which depend on no instant.
void encode_identity(const LinkIdentity& identity, RegisterImage& image);
void encode_health(const LinkState& state, RegisterImage& image);

/// The block journal.
void encode_journal(const LinkJournal& journal, RegisterImage& image);

/// The block self_test.
void encode_self_test(const LinkSelfTest& self_test, RegisterImage& image);

/// The block sighting, as it is to be read at `now`.
void encode_sighting(const LinkState& state, core::FieldTime now, RegisterImage& image);

/// The block zone: the correction at a tube.
void encode_zone(const ZoneCorrections* zones, core::TubeAddress tube, RegisterImage& image);

/// What became of a pose request. `seen` is the sighting that the verdict speaks of, for the
/// correction; null: there is none.
void encode_pose(const core::PoseReply& reply, const core::Sighting* seen, RegisterImage& image);

/// The registers of the result of a pose request as long as there is none.
void clear_pose(RegisterImage& image);

}  // namespace tubesight::drivers
