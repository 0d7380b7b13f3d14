#include "core/calibration/base_pairs.h"

namespace tubesight::core::calibration {

bool comes_before(const BasePair& a, const BasePair& b) {
  const auto decide = [](const auto& x, const auto& y) {
    for (Eigen::Index i = 0; i < x.size(); ++i) {
      if (x.data()[i] != y.data()[i]) {
        return x.data()[i] < y.data()[i] ? -1 : 1;
      }
    }
    return 0;
  };
  int order = decide(a.T_sheet_tool.translation_mm(), b.T_sheet_tool.translation_mm());
  order =
      order != 0 ? order : decide(a.T_base_tool.translation_mm(), b.T_base_tool.translation_mm());
  order = order != 0 ? order : decide(a.T_sheet_tool.rotation(), b.T_sheet_tool.rotation());
  order = order != 0 ? order : decide(a.T_base_tool.rotation(), b.T_base_tool.rotation());
  order = order != 0 ? order : decide(a.sigma_mm, b.sigma_mm);
  return order != 0 ? order < 0 : a.turned && !b.turned;
}

}  // namespace tubesight::core::calibration
