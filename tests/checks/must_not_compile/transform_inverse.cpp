// expect: could not convert|cannot convert
// An inverse has its frames swapped, so it cannot stand where the transform itself is wanted.
#include "core/base/transform.h"

namespace core = tubesight::core;
namespace frames = tubesight::core::frames;
using SheetFromTool = core::Transform<frames::Sheet, frames::Tool>;
using ToolFromSheet = core::Transform<frames::Tool, frames::Sheet>;

#ifdef TUBESIGHT_MUST_NOT_COMPILE
SheetFromTool swapped(const SheetFromTool& T_sheet_tool) { return T_sheet_tool.inverse(); }
#else
ToolFromSheet swapped(const SheetFromTool& T_sheet_tool) { return T_sheet_tool.inverse(); }
#endif
