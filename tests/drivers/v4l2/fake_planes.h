#pragma once

#include <functional>

#include "tests/drivers/v4l2/fake_camera.h"

namespace tubesight::tests {

/// Whether a request's argument is of the set of calls that a camera knows: those with planes or
/// those without. The kernel gives EINVAL for the others.
[[nodiscard]] bool of_this_camera(const FakeCamera& camera, unsigned long request,
                                  const void* argument);

/// Serves a request of the set with planes by `answer`, which knows the set without alone. 0 or
/// -errno.
[[nodiscard]] int answer_in_planes(const FakeCamera& camera, unsigned long request, void* argument,
                                   const std::function<int(void* argument)>& answer);

}  // namespace tubesight::tests
