#include "board/bench/calibrate/residuals_file.h"

#include <cstdint>

#include "board/bench/output/text_output.h"
#include "drivers/files/atomic_file.h"
#include "drivers/files/decimal.h"

namespace tubesight::board {

bool write_residuals(const std::string& path, const core::calibration::CalibrationData& data) {
  std::string text = "view,x_mm,y_mm,z_mm,u_px,v_px,du_px,dv_px,used\n";
  for (std::int32_t v = 0; v < data.views.size(); ++v) {
    const core::calibration::CalibrationView& view = data.views[v];
    for (std::int32_t i = view.first; i < view.first + view.count; ++i) {
      const core::calibration::SeenDot& dot = data.dots[i];
      drivers::print(text, "%d,%.4f,%.4f,%.4f,%.4f,%.4f,%.4f,%.4f,%d\n", v, dot.place_mm.x(),
                     dot.place_mm.y(), dot.place_mm.z(), dot.seen_px.x(), dot.seen_px.y(),
                     dot.residual_px.x(), dot.residual_px.y(), dot.used ? 1 : 0);
    }
  }
  drivers::AtomicFile file;
  if (!file.open(path) || !file.write(text) || !file.commit()) {
    tell(file.message());
    return false;
  }
  return true;
}

}  // namespace tubesight::board
