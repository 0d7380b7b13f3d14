#pragma once

#include <cstdlib>
#include <string>

#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"

namespace tubesight::support {

/// Runs ffmpeg in a folder with these arguments, which the shell reads; a test that has none fails.
inline void run_ffmpeg(const TemporaryFolder& folder, const std::string& arguments) {
  const std::string command =
      "cd '" + folder.path("") + "' && ffmpeg -nostdin -v error -y " + arguments;
  ASSERT_EQ(std::system(command.c_str()), 0) << command;
}

}  // namespace tubesight::support
