#pragma once

#include <cstdint>

#include "core/base/event.h"
#include "core/base/pose_result.h"
#include "core/base/reply.h"
#include "core/base/sighting.h"
#include "core/base/static_vector.h"
#include "core/tracking/tracker.h"

namespace tubesight::core::verification {

/// Fields that a pose request waits for its result; then another one is taken. Ten seconds of 60
/// fields: averaging and fitting take well below one.
inline constexpr std::int32_t kPoseRequestLasts = 600;

/// Takes pose requests, one at a time, and compares what comes of them with what the box sees.
///
/// Whoever computes poses does it beside the path and hands the result back as an event: the answer
/// to a request is whether one will come. One thread; no heap.
class PoseRequests {
 public:
  /// A field passed.
  void age() { awaited_ = awaited_ > 0 ? awaited_ - 1 : 0; }

  /// Answers a request made with the field of `sighting`; one that is taken leaves an order with
  /// the tube-ends used in that field. Refused while the tool moves, as an average would show it.
  [[nodiscard]] PoseRequestReply take(const Event& request, const Sighting& sighting,
                                      const tracking::TubeSightingList& tubes, PoseOrder& order);

  /// Answers the result of the request that was taken.
  [[nodiscard]] PoseReply judge(const PoseResult& pose, const Sighting& sighting);

  /// The members of the state; see core/base/state_stream.h.
  template <typename Self, typename Stream>
  static void transfer(Self& self, Stream& stream) {
    auto& [awaited] = self;
    stream.number(awaited, 0, kPoseRequestLasts);
  }

 private:
  std::int32_t awaited_ = 0;  ///< fields that the pending request has left
};

}  // namespace tubesight::core::verification
