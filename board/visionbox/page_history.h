#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "board/visionbox/page_json.h"
#include "board/visionbox/picture_hub.h"
#include "core/base/reply.h"
#include "core/base/settings.h"
#include "core/base/sighting.h"

namespace tubesight::board {

/// What the page remembers since the box was started: where the tool has been, which tubes it was
/// vouched under and what the robot said there, and every disagreement. Bounded, and no journal:
/// it ends with the program. One thread, or guarded by the caller.
class PageHistory {
 public:
  using Picture = PictureHub::Picture;

  /// The sheet, for where a tube is; once, before all others.
  void know_sheet(const core::TubesheetSettings& sheet);

  /// Takes what a field left; some times a second. `latest`: the picture shown last, or null.
  void take(const OverlaySnapshot& marks, const Picture& latest);

  /// Takes what the box said to a claim; the number of the disagreement that it is, 0: none.
  [[nodiscard]] std::int64_t take_claim(const core::ClaimReply& claim, double at_s,
                                        std::string wall);

  [[nodiscard]] Json visits() const;
  [[nodiscard]] Json disagreements() const;
  /// Of a disagreement, one of its last pictures from 0; null: there is none.
  [[nodiscard]] Picture picture(std::int64_t disagreement, std::size_t step) const;
  /// False: there is no such disagreement.
  [[nodiscard]] bool acknowledge(std::int64_t id, const std::string& name,
                                 const std::string& reason, double at_s);

 private:
  static constexpr std::size_t kMostVisits = 20'000;  ///< a whole sheet
  static constexpr std::size_t kMostPath = 5'000;
  static constexpr std::size_t kMostDisagreements = 100;
  static constexpr std::size_t kMostWithPictures = 4;
  static constexpr std::size_t kMostPictures = 15;
  static constexpr std::size_t kMostPictureBytes = std::size_t{8} * 1024 * 1024;

  enum class Told : std::uint8_t { kNothing, kVerified, kContradicted };
  struct Visit {
    Told told = Told::kNothing;
    std::int32_t count = 0;
    double last_s = 0.0;
  };
  struct Place {
    double x_mm = 0.0;
    double y_mm = 0.0;
    double at_s = 0.0;
  };
  struct Acknowledged {
    std::string name;
    std::string reason;
    double at_s = 0.0;
  };
  struct Disagreement {
    std::int64_t id = 0;
    double at_s = 0.0;
    std::string wall;
    core::ClaimReply claim;
    std::optional<Acknowledged> acknowledged;
    std::vector<Picture> pictures;
  };

  void follow(const core::Sighting& sighting);
  void keep(const Picture& latest);
  [[nodiscard]] Visit* visit(core::TubeAddress tube);

  std::map<core::TubeAddress, Visit> visits_;
  std::optional<core::TubeAddress> under_;
  std::deque<Place> path_;
  std::optional<Place> now_;
  std::deque<Picture> recent_;
  double kept_at_s_ = -1e9;
  std::deque<Disagreement> disagreements_;
  std::int64_t last_id_ = 0;
  core::TubesheetSettings sheet_;
};

}  // namespace tubesight::board
