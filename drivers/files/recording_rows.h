#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/base/event.h"
#include "core/base/field.h"

namespace tubesight::drivers {

// How the files beside a recording are written: see docs/file-formats.md. drivers/replay reads
// them.

/// First line of a `NAME.events.csv`, without the line feed.
inline constexpr std::string_view kEventsHeader = "field,time_s,kind,values,id,seen_field,confirm";

/// The same with the column that the box's recorder appends.
inline constexpr std::string_view kRecordedEventsHeader =
    "field,time_s,kind,values,id,seen_field,confirm,origin";

/// First line of a `NAME.meta.csv`, without the line feed.
inline constexpr std::string_view kMetaHeader = "field,sequence,time_s,status,lamp_permille";

/// Appends the row of an event that is handed over before the field of that number, so that
/// ReplayEvents reads the same event; places are kept to 0.001 px.
void append_event_row(std::string& out, std::int64_t field, const core::Event& event);

/// The same for kRecordedEventsHeader: everything exactly as it was handed over.
void append_recorded_event_row(std::string& out, std::int64_t field, const core::Event& event);

/// Appends the row of a field.
void append_meta_row(std::string& out, const core::Field& field);

}  // namespace tubesight::drivers
