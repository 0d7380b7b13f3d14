// expect: no match for .operator\*
// Frames that do not meet in a product: T_sheet_tool * T_camera_tool.
#include "core/base/transform.h"

namespace core = tubesight::core;
namespace frames = tubesight::core::frames;
using SheetFromTool = core::Transform<frames::Sheet, frames::Tool>;
using ToolFromCamera = core::Transform<frames::Tool, frames::Camera>;
using CameraFromTool = core::Transform<frames::Camera, frames::Tool>;
using SheetFromCamera = core::Transform<frames::Sheet, frames::Camera>;

#ifdef TUBESIGHT_MUST_NOT_COMPILE
SheetFromCamera chain(const SheetFromTool& T_sheet_tool, const CameraFromTool& T_camera_tool) {
  return T_sheet_tool * T_camera_tool;
}
#else
SheetFromCamera chain(const SheetFromTool& T_sheet_tool, const ToolFromCamera& T_tool_camera) {
  return T_sheet_tool * T_tool_camera;
}
#endif
