#include "board/bench/calibrate/base_picture.h"

#include <cstddef>
#include <cstdint>

#include "board/bench/calibrate/plan_picture.h"
#include "drivers/files/decimal.h"

namespace tubesight::board {

bool write_base_picture(const std::string& path, const BaseReport& report,
                        std::span<const Eigen::Vector2d> places, std::string& message) {
  PlanPicture picture;
  for (const Eigen::Vector2d& place : places) {
    const double sigma_mm = core::calibration::deviation_at(report.base, place).across_mm;
    picture.places.push_back({place, sigma_mm});
  }
  for (std::int32_t i = 0; i < report.outcomes.size(); ++i) {
    const PlanMark mark = report.outcomes[i].outlier ? PlanMark::kLeftOut
                          : report.pairs[i].use      ? PlanMark::kPair
                                                     : PlanMark::kCompared;
    picture.marks.push_back({mark, report.pairs[i].T_sheet_tool.translation_mm().head<2>(),
                             report.outcomes[i].place_mm.head<2>(),
                             report.names[static_cast<std::size_t>(i)]});
  }
  const Eigen::Vector2d none = Eigen::Vector2d::Zero();
  picture.marks.push_back(
      {PlanMark::kBase, report.base.fit.pose.T_sheet_base.translation_mm().head<2>(), none, ""});
  picture.marks.push_back({PlanMark::kNext, report.next.at_mm, none, ""});
  std::string line;
  drivers::print(line, "tool across %.2f mm RMS (one sigma), %.2f at worst (green 0, red 1.25 mm)",
                 report.base.mean.across_mm, report.base.worst.across_mm);
  picture.caption = {line, "yellow: pairs, with their misses 200 times as long",
                     "red cross: left out", "blue: the base",
                     "ring: where the next pair would help most"};
  return write_plan(path, picture, message);
}

}  // namespace tubesight::board
