#include "board/bench/pose/pose_options.h"

#include <array>
#include <vector>

#include "board/bench/output/output_paths.h"

namespace tubesight::board {

std::string find_output_conflict(const PoseCommandOptions& options) {
  std::vector<NamedPath> inputs = {{"the session", options.session}};
  for (const std::string& image : options.images) {
    inputs.push_back({"a picture", image});
  }
  const std::array outputs = {
      NamedPath{"--csv", options.csv},
      NamedPath{"--covariance", options.covariance},
      NamedPath{"--overlay", options.overlay},
  };
  return find_clash(inputs, outputs);
}

}  // namespace tubesight::board
