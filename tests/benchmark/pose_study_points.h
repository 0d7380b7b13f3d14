#pragma once

#include "tests/benchmark/pose_study_scene.h"

namespace tubesight::benchmark {

/// Prints the table of ellipse fits: bias and scatter of the centre against noise and arc.
void print_ellipse_table(int fits);

/// Prints the table of centre constructions: bias and scatter of the image of a tube-end's centre,
/// against the synthetic sheet's own.
void print_center_table(StudyScene& scene, int pictures);

}  // namespace tubesight::benchmark
