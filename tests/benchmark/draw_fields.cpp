// Draws fields of a plain scene, to be counted by callgrind: docs/performance.md, How fast:
// rendering.
//
//   valgrind --tool=callgrind --toggle-collect='*Renderer::render*' draw_fields FIELDS rest|move
//   whole|window

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "tests/support/drawn_sheet.h"

int main(int count, char** words) {
  using tubesight::core::Parity;
  const int fields = count == 4 ? std::atoi(words[1]) : 0;
  if (fields < 1) {
    std::fprintf(stderr, "usage: draw_fields FIELDS rest|move whole|window\n");
    return 2;
  }
  const double step_mm = std::string(words[2]) == "move" ? 1.5 : 0.0;
  const bool window = std::string(words[3]) == "window";
  tubesight::tests::DrawnSheet sheet;
  auto picture = sheet.picture();
  std::uint64_t sum = 0;
  for (int field = 0; field < fields; ++field) {
    tubesight::core::rendering::Exposure exposure = sheet.exposure(field * step_mm, step_mm);
    exposure.parity = field % 2 == 0 ? Parity::kEven : Parity::kOdd;
    exposure.noise_seed = static_cast<std::uint64_t>(field);
    if (window) {
      exposure.window = {40, 36, 595, 330};
    }
    sheet.renderer().render(exposure, sheet.view(picture));
    sum += picture[picture.size() / 2];
  }
  std::printf("%d fields, check sum %llu\n", fields, static_cast<unsigned long long>(sum));
  return 0;
}
