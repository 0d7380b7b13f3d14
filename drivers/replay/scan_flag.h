#pragma once

#include <string>

#include "core/base/settings.h"
#include "drivers/files/y4m_header.h"

namespace tubesight::drivers {

/// What to say where a recording's header and the settings disagree about the order of lines:
/// "header says Ip (progressive), expected scan = ...". Empty where they agree, or the header says
/// nothing of it.
[[nodiscard]] std::string why_other_scan(Y4mInterlacing interlacing, core::Scan scan);

}  // namespace tubesight::drivers
