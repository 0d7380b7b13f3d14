#pragma once

#include <string>

namespace tubesight::tests {

/// Puts this process, and those that it starts from now on, into a network of its own, where there
/// is nothing but the loopback: a camera that is looked for by broadcast is looked for nowhere
/// else. As root, or where users may have namespaces of their own; no other thread may run. Empty:
/// it is so; else what is in the way.
[[nodiscard]] std::string enter_network_of_its_own();

}  // namespace tubesight::tests
