#pragma once

#include <gtest/gtest.h>

#include "core/base/event.h"
#include "core/base/reply.h"

namespace tubesight::tests {

/// An event of the robot, unless told otherwise.
template <typename Content>
[[nodiscard]] core::Event event_of(const Content& content,
                                   core::EventOrigin origin = core::EventOrigin::kRobot) {
  core::Event event;
  event.origin = origin;
  event.content = content;
  return event;
}

/// The content of an event or reply of kind T; a failure of the test and a default when it is of
/// another kind.
template <typename T, typename Told>
[[nodiscard]] T content_of(const Told& told) {
  const T* const content = core::content_if<T>(told);
  EXPECT_NE(content, nullptr) << "of another kind: " << told.content.index();
  return content == nullptr ? T{} : *content;
}

/// Whether an event or reply is of kind T.
template <typename T, typename Told>
[[nodiscard]] bool is(const Told& told) {
  return core::content_if<T>(told) != nullptr;
}

}  // namespace tubesight::tests
