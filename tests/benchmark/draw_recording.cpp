// Draws the scenes of ray-traced recordings anew and puts both side by side:
// docs/pictures/rendered.png.
//
// Each FOLDER holds recording.y4m.xz, session.toml, truth.csv and centers.csv; FRAME is one of the
// frames that centers.csv tells about (every tenth). Says how far the truth's images of tube-ends
// agree.

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include "core/rendering/renderer.h"
#include "core/rendering/truth.h"
#include "drivers/files/csv_reader.h"
#include "drivers/files/png_writer.h"
#include "drivers/files/y4m_reader.h"
#include "drivers/settings/session_settings.h"

namespace tubesight::benchmark {
namespace {

using core::Transform;
namespace frames = core::frames;
namespace rendering = core::rendering;

using Picture = std::vector<std::uint8_t>;

/// A table by the names of its columns.
struct Table {
  std::vector<std::string> names;
  std::vector<std::vector<std::string>> lines;

  [[nodiscard]] std::string cell(std::size_t line, const std::string& name) const {
    for (std::size_t column = 0; column < names.size(); ++column) {
      if (names[column] == name) {
        return lines[line][column];
      }
    }
    return {};
  }
  [[nodiscard]] double number(std::size_t line, const std::string& name) const {
    return std::atof(cell(line, name).c_str());
  }
};

Table read_table(const std::string& path) {
  Table table;
  drivers::Messages messages;
  std::ifstream file(path, std::ios::binary);
  const std::string text(std::istreambuf_iterator<char>(file), {});
  drivers::CsvReader reader(text, path);
  while (reader.next(messages)) {
    (table.names.empty() ? table.names : table.lines.emplace_back()) = reader.cells();
  }
  return table;
}

struct Recorded {
  std::unique_ptr<rendering::Scene> scene;
  std::array<rendering::Exposure, 2> exposures;  // even, odd lines
  Picture traced;
  Table centers;
  std::string frame;
};

Transform<frames::Sheet, frames::Tool> tool_pose(const Table& truth, std::size_t line) {
  constexpr double kDegrees = 57.295779513082320877;
  return {
      core::rotation_from_degrees({truth.number(line, "tool_alpha") * kDegrees,
                                   truth.number(line, "tool_beta") * kDegrees,
                                   truth.number(line, "tool_gamma") * kDegrees}),
      {truth.number(line, "tool_x"), truth.number(line, "tool_y"), truth.number(line, "tool_z")}};
}

void take_plugs(const Table& centers, rendering::Scene& scene) {
  for (std::size_t line = 0; line < centers.lines.size(); ++line) {
    const std::string state = centers.cell(line, "state");
    if (state != "plug_rolled" && state != "plug_flush") {
      continue;
    }
    const core::TubeAddress address{std::atoi(centers.cell(line, "row").c_str()),
                                    std::atoi(centers.cell(line, "col").c_str())};
    bool known = false;
    for (const rendering::Plug& plug : scene.plugs) {
      known = known || plug.address == address;
    }
    if (!known) {
      static_cast<void>(scene.plugs.try_push_back({address, state == "plug_rolled"
                                                                ? rendering::PlugKind::kRolled
                                                                : rendering::PlugKind::kFlush}));
    }
  }
}

bool read_frame(const std::string& path, int frame, Picture& picture, std::string& message) {
  drivers::Y4mReader reader;
  if (!reader.open(path).has_value()) {
    message = reader.message();
    return false;
  }
  picture.resize(static_cast<std::size_t>(reader.header().luma_bytes()));
  for (int i = 0; i <= frame; ++i) {
    if (!reader.read_frame(picture).has_value()) {
      message = reader.message();
      return false;
    }
  }
  return true;
}

/// What the tracer's scenes differ in that settings do not tell; guidetubes measured in the
/// pictures.
void adapt_look(const std::string& name, rendering::Scene& scene) {
  if (name == "tri_flush") {
    scene.guidetube.radius_mm = 8.0;
    scene.lamp.strength = 1.03;
  } else if (name == "sq_fillet") {
    scene.guidetube.radius_mm = 11.3;
    scene.guidetube.reflectance = 0.42;
    scene.lamp.strength = 1.35;
  }
}

bool load(const std::string& folder, int frame, Recorded& recorded, std::string& message) {
  const auto file = std::make_unique<drivers::SessionFile>();
  drivers::Messages messages;
  if (!drivers::load_session_settings(folder + "/session.toml", drivers::kReplayNeeds, *file,
                                      messages)) {
    message = messages.empty() ? folder : messages.front();
    return false;
  }
  recorded.scene = std::make_unique<rendering::Scene>();
  recorded.scene->camera = file->settings.camera;
  recorded.scene->tool = file->settings.tool;
  recorded.scene->sheet = file->settings.tubesheet;
  recorded.centers = read_table(folder + "/centers.csv");
  recorded.frame = std::to_string(frame);
  take_plugs(recorded.centers, *recorded.scene);
  adapt_look(std::filesystem::path(folder).filename().string(), *recorded.scene);
  const Table truth = read_table(folder + "/truth.csv");
  for (std::size_t line = 0; line < truth.lines.size(); ++line) {
    if (truth.cell(line, "frame") == recorded.frame) {
      const std::size_t field = truth.cell(line, "field") == "0" ? 0 : 1;
      rendering::Exposure& exposure = recorded.exposures[field];
      exposure.opened = exposure.closed = tool_pose(truth, line);
      exposure.parity = field == 0 ? core::Parity::kEven : core::Parity::kOdd;
      exposure.noise_seed = field;
    }
  }
  return read_frame(folder + "/recording.y4m.xz", frame, recorded.traced, message);
}

/// Largest differences between the truth's images and those that came with the recording.
void compare_truth(const std::string& folder, const Recorded& recorded) {
  const auto truth = std::make_unique<rendering::Truth>();
  if (!truth->configure(*recorded.scene).has_value()) {
    return;
  }
  double center = 0.0;
  double ellipse = 0.0;
  double half = 0.0;
  int count = 0;
  const Table& table = recorded.centers;
  for (std::size_t line = 0; line < table.lines.size(); ++line) {
    if (table.cell(line, "frame") != recorded.frame || table.cell(line, "state") == "void") {
      continue;
    }
    const core::TubeAddress address{std::atoi(table.cell(line, "row").c_str()),
                                    std::atoi(table.cell(line, "col").c_str())};
    const std::size_t field = table.cell(line, "field") == "0" ? 0 : 1;
    const auto image = truth->tube_image(recorded.exposures[field].opened, address);
    if (!image) {
      continue;
    }
    ++count;
    const auto off = [&](const char* x, const char* y, const std::array<double, 2>& point) {
      return std::hypot(table.number(line, x) - point[0], table.number(line, y) - point[1]);
    };
    center = std::max(center, off("x_f", "y_f", image->center_px));
    ellipse = std::max(ellipse, off("ell_x", "ell_y", image->ellipse_px));
    half = std::max(half, off("half_w", "half_h", image->half_px));
  }
  std::printf(
      "%s frame %s: %d tube-ends, largest difference of centres %.4f px, of ellipses' centres"
      " %.3f px, of half extents %.3f px\n",
      folder.c_str(), recorded.frame.c_str(), count, center, ellipse, half);
}

bool add_pair(const std::string& folder, int frame, int divisor, Picture& sheet, int& width,
              int& height, std::string& message) {
  Recorded recorded;
  if (!load(folder, frame, recorded, message)) {
    return false;
  }
  compare_truth(folder, recorded);
  const auto renderer = std::make_unique<rendering::Renderer>();
  if (!renderer->configure(*recorded.scene).has_value()) {
    message = folder + ": the scene cannot be drawn";
    return false;
  }
  const int w = recorded.scene->camera.width_px;
  const int h = recorded.scene->camera.height_px;
  Picture drawn(recorded.traced.size());
  for (const rendering::Exposure& exposure : recorded.exposures) {
    renderer->render(exposure, {drawn.data(), w, h, w});
  }
  width = 2 * (w / divisor);
  const bool coarse = divisor > 1;
  for (int v = 0; v + divisor <= h; v += divisor) {
    for (const Picture* picture : {&recorded.traced, &drawn}) {
      for (int u = 0; u + divisor <= w; u += divisor) {
        int sum = 0;
        for (int k = 0; k < divisor * divisor; ++k) {
          sum += (*picture)[static_cast<std::size_t>((v + k / divisor) * w + u + k % divisor)];
        }
        // Noise does not compress; a picture for the eye needs no more than 26 levels.
        const int level = sum / (divisor * divisor);
        sheet.push_back(static_cast<std::uint8_t>(coarse ? level / 10 * 10 : level));
      }
    }
    ++height;
  }
  return true;
}

int run(const std::string& out, int divisor, const std::vector<std::string>& words) {
  Picture sheet;
  int width = 0;
  int height = 0;
  std::string message;
  for (std::size_t i = 0; i + 1 < words.size(); i += 2) {
    if (!add_pair(words[i], std::atoi(words[i + 1].c_str()), divisor, sheet, width, height,
                  message)) {
      std::fprintf(stderr, "%s\n", message.c_str());
      return 1;
    }
  }
  const core::ImageView view{sheet.data(), width, height, width};
  if (!drivers::write_png(out, view, message).has_value()) {
    std::fprintf(stderr, "%s\n", message.c_str());
    return 1;
  }
  return 0;
}

}  // namespace
}  // namespace tubesight::benchmark

int main(int count, char** words) {
  const int divisor = count > 2 ? std::atoi(words[2]) : 0;
  if (count < 5 || count % 2 == 0 || divisor < 1) {
    std::fprintf(stderr, "usage: draw_recording OUT.png DIVISOR FOLDER FRAME [FOLDER FRAME ...]\n");
    return 2;
  }
  return tubesight::benchmark::run(words[1], divisor, {words + 3, words + count});
}
