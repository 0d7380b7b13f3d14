#pragma once

#include "tests/benchmark/pose_study_scene.h"

namespace tubesight::benchmark {

/// Three, four and n points [Fallon 5.2.1-5.2.3] against the truth.
void print_point_table(StudyScene& scene, int poses);

}  // namespace tubesight::benchmark
