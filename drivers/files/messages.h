#pragma once

#include <string>
#include <vector>

namespace tubesight::drivers {

/// Lines for a person, each naming the place ("file:line: key"), what is wrong there and what was
/// expected. They go to standard error as they are; the core::Error beside them tells the program.
using Messages = std::vector<std::string>;

}  // namespace tubesight::drivers
