#include "drivers/camera_yaml/camera_yaml.h"

#include <cmath>
#include <cstddef>
#include <span>

#include "drivers/camera_yaml/yaml_tree.h"
#include "drivers/files/decimal.h"

namespace tubesight::drivers {
namespace {

constexpr std::size_t kMostBytes = std::size_t{1} << 20U;
constexpr double kLongest_px = 1e6;  // of a focal length

/// A text of the file between quotation marks, without what would break a line.
std::string quoted(std::string_view text) {
  constexpr std::size_t kMost = 60;
  std::string words = "'";
  for (const char character : text.substr(0, kMost)) {
    words += static_cast<unsigned char>(character) < 0x20 || character == 0x7F ? '?' : character;
  }
  return words + "'";
}

class Reader {
 public:
  Reader(YamlTree& tree, Messages& messages) : tree_(tree), messages_(messages) {}

  [[nodiscard]] bool read(CameraYaml& camera) {
    if (yaml_node_t* const chain = tree_.find(tree_.root(), {"cam0"}); chain != nullptr) {
      return read_kalibr(chain, camera);
    }
    return model_is_served() && read_side({"image_width", "width"}, camera.width_px) &&
           read_side({"image_height", "height"}, camera.height_px) && read_matrix(camera) &&
           read_distortion(camera) && read_name(camera);
  }

 private:
  bool complain(const yaml_node_t* node, std::string_view key, const std::string& what) {
    messages_.push_back(tree_.place(node, key) + what);
    return false;
  }

  /// A camera chain of Kalibr, of one camera: pinhole with radial and tangential distortion.
  bool read_kalibr(yaml_node_t* chain, CameraYaml& camera) {
    if (yaml_node_t* const other = tree_.find(tree_.root(), {"cam1"}); other != nullptr) {
      return complain(other, "cam1",
                      "a second camera, expected one: leave the one that sees the tubesheet, as "
                      "cam0");
    }
    yaml_node_t* const kind = tree_.find(chain, {"camera_model"});
    if (YamlTree::text_of(kind) != "pinhole") {
      const bool omni = YamlTree::text_of(kind) == "omni";
      return complain(
          kind, "camera_model",
          quoted(YamlTree::text_of(kind)) + (omni ? ", a fisheye's" : "") + ", expected pinhole");
    }
    yaml_node_t* const model = tree_.find(chain, {"distortion_model"});
    const std::string_view name = YamlTree::text_of(model);
    if (name != "radtan" && name != "none") {
      const bool fisheye = name == "equidistant" || name == "fov";
      return complain(model, "distortion_model",
                      quoted(name) + (fisheye ? ", a fisheye's" : "") + ", expected radtan");
    }
    std::array<double, 2> resolution{};
    std::array<double, 4> intrinsics{};
    std::array<double, 4> distortion{};
    if (!read_exactly(chain, "resolution", resolution) ||
        !read_exactly(chain, "intrinsics", intrinsics) ||
        (name == "radtan" && !read_exactly(chain, "distortion_coeffs", distortion))) {
      return false;
    }
    constexpr double kMost = 16384.0;
    for (const double side : resolution) {
      if (side != std::floor(side) || side < 1.0 || side > kMost) {
        return complain(tree_.find(chain, {"resolution"}), "resolution",
                        "expected width and height, whole pixels from 1 to 16384");
      }
    }
    const auto& [fu, fv, pu, pv] = intrinsics;
    if (!(fu > 0.0) || !(fv > 0.0) || fu > kLongest_px || fv > kLongest_px) {
      return complain(tree_.find(chain, {"intrinsics"}), "intrinsics",
                      "expected fu, fv, pu, pv with fu and fv above 0");
    }
    camera.width_px = static_cast<std::int32_t>(resolution[0]);
    camera.height_px = static_cast<std::int32_t>(resolution[1]);
    camera.fx_px = fu;
    camera.fy_px = fv;
    camera.cx_px = pu;
    camera.cy_px = pv;
    for (std::size_t i = 0; i < distortion.size(); ++i) {  // k1, k2, r1, r2 as OpenCV's first four
      camera.distortion[i] = distortion[i];
    }
    camera.name.clear();
    return true;
  }

  bool read_exactly(yaml_node_t* mapping, std::string_view key, std::span<double> values) {
    yaml_node_t* const node = tree_.find(mapping, {key});
    const std::int32_t count = read_numbers(node, key, values);
    if (count >= 0 && static_cast<std::size_t>(count) != values.size()) {
      return complain(
          node, key, std::to_string(count) + " numbers, expected " + std::to_string(values.size()));
    }
    return count >= 0;
  }

  /// A fisheye's coefficients look like others, so that its name is all that tells.
  bool model_is_served() {
    yaml_node_t* const node = tree_.find(tree_.root(), {"distortion_model"});
    const std::string_view model = YamlTree::text_of(node);
    if (node != nullptr && model != "plumb_bob" && model != "rational_polynomial" &&
        model != "none") {
      const bool fisheye = model == "equidistant" || model == "fisheye" ||
                           model.starts_with("kannala") || model == "equi";
      return complain(node, "distortion_model",
                      quoted(model) + (fisheye ? ", a fisheye's" : "") +
                          ", expected plumb_bob or rational_polynomial");
    }
    // OpenCV's own calibration program says it so.
    yaml_node_t* const flag = tree_.find(tree_.root(), {"fisheye_model"});
    double value = 0.0;
    if (flag != nullptr && (!YamlTree::number_of(flag, value) || value != 0.0)) {
      return complain(flag, "fisheye_model",
                      quoted(YamlTree::text_of(flag)) + ", a fisheye's, expected 0");
    }
    return true;
  }

  bool read_side(std::initializer_list<std::string_view> keys, std::int32_t& side) {
    constexpr double kMost = 16384.0;
    yaml_node_t* const node = tree_.find(tree_.root(), keys);
    double value = 0.0;
    if (!YamlTree::number_of(node, value) || value != std::floor(value) || value < 1.0 ||
        value > kMost) {
      return complain(node, *keys.begin(),
                      (node == nullptr ? "missing" : quoted(YamlTree::text_of(node))) +
                          ", expected whole pixels from 1 to 16384");
    }
    side = static_cast<std::int32_t>(value);
    return true;
  }

  /// All numbers of a sequence, at most `values`; how many, or -1 after a complaint.
  std::int32_t read_numbers(yaml_node_t* node, std::string_view key, std::span<double> values) {
    yaml_node_t* const sequence = tree_.sequence_of(node);
    if (sequence == nullptr) {
      complain(node, key, "missing, expected numbers, or a matrix with its data");
      return -1;
    }
    const std::int32_t count = YamlTree::size_of(sequence);
    for (std::int32_t i = 0; i < count; ++i) {
      yaml_node_t* const item = tree_.item(sequence, i);
      double value = 0.0;
      if (!YamlTree::number_of(item, value)) {
        complain(item, key, quoted(YamlTree::text_of(item)) + ", expected a number");
        return -1;
      }
      if (static_cast<std::size_t>(i) < values.size()) {
        values[static_cast<std::size_t>(i)] = value;
      } else if (value != 0.0) {
        complain(item, key, "a term beyond k6 that is not 0, expected at most 8 numbers");
        return -1;
      }
    }
    return count;
  }

  bool read_matrix(CameraYaml& camera) {
    yaml_node_t* const node = tree_.find(tree_.root(), {"camera_matrix", "K", "cameraMatrix"});
    std::array<double, 9> matrix{};
    const std::int32_t count = read_numbers(node, "camera_matrix", matrix);
    if (count < 0) {
      return false;
    }
    const auto& [fx, skew, cx, zero, fy, cy, left, middle, one] = matrix;
    if (count != 9 || skew != 0.0 || zero != 0.0 || left != 0.0 || middle != 0.0 || one != 1.0 ||
        !(fx > 0.0) || !(fy > 0.0) || fx > kLongest_px || fy > kLongest_px) {
      return complain(node, "camera_matrix",
                      "expected fx, 0, cx, 0, fy, cy, 0, 0, 1 with fx and "
                      "fy above 0 and no skew");
    }
    camera.fx_px = fx;
    camera.fy_px = fy;
    camera.cx_px = cx;
    camera.cy_px = cy;
    return true;
  }

  bool read_distortion(CameraYaml& camera) {
    yaml_node_t* const node =
        tree_.find(tree_.root(), {"distortion_coefficients", "D", "distCoeffs"});
    const std::int32_t count = read_numbers(node, "distortion_coefficients", camera.distortion);
    if (count < 0) {
      return false;
    }
    if (count != 0 && count != 4 && count != 5 && count < 8) {
      return complain(node, "distortion_coefficients",
                      std::to_string(count) + " numbers, expected 4, 5 or 8");
    }
    return true;
  }

  bool read_name(CameraYaml& camera) {
    camera.name = YamlTree::text_of(tree_.find(tree_.root(), {"camera_name"}));
    return true;
  }

  YamlTree& tree_;
  Messages& messages_;
};

/// A matrix with its rows and columns.
void append_matrix(std::string& text, const char* name, std::int32_t rows, std::int32_t columns,
                   std::span<const double> values, YamlManner manner) {
  const bool opencv = manner == YamlManner::kOpencv;
  const char* const indent = opencv ? "   " : "  ";
  print(text, "%s:%s\n%srows: %d\n%scols: %d\n", name, opencv ? " !!opencv-matrix" : "", indent,
        rows, indent, columns);
  if (opencv) {
    print(text, "%sdt: d\n", indent);
  }
  text += std::string(indent) + "data: [";
  for (std::size_t i = 0; i < values.size(); ++i) {
    print(text, "%s%.17g%s", i == 0 ? "" : ", ", values[i],
          values[i] == std::floor(values[i]) && std::abs(values[i]) < 1e15 ? "." : "");
  }
  text += "]\n";
}

}  // namespace

core::Result<void> read_camera_yaml(std::string_view text, const std::string& name,
                                    CameraYaml& camera, Messages& messages) {
  if (text.size() > kMostBytes) {
    messages.push_back(name + ": more than 1 MiB, expected a camera's file");
    return core::Unexpected(core::Error::kInvalidArgument);
  }
  YamlTree tree(name);
  if (!tree.read(std::string(text), messages) || !Reader(tree, messages).read(camera)) {
    return core::Unexpected(core::Error::kInvalidArgument);
  }
  return {};
}

std::string camera_yaml_text(const CameraYaml& camera, YamlManner manner) {
  const bool opencv = manner == YamlManner::kOpencv;
  std::string text = opencv ? "%YAML:1.0\n---\n" : "";
  print(text, "image_width: %d\nimage_height: %d\n", camera.width_px, camera.height_px);
  if (!camera.name.empty()) {
    text += "camera_name: \"";
    for (const char character : camera.name) {
      text += character == '"' || character == '\\' ? std::string("\\") + character
                                                    : std::string(1, character);
    }
    text += "\"\n";
  }
  const std::array<double, 9> matrix = {camera.fx_px, 0.0, camera.cx_px, 0.0, camera.fy_px,
                                        camera.cy_px, 0.0, 0.0,          1.0};
  append_matrix(text, "camera_matrix", 3, 3, matrix, manner);
  const bool rational =
      camera.distortion[5] != 0.0 || camera.distortion[6] != 0.0 || camera.distortion[7] != 0.0;
  print(text, "distortion_model: %s\n", rational ? "rational_polynomial" : "plumb_bob");
  const std::span<const double> distortion(camera.distortion.data(), rational ? 8 : 5);
  append_matrix(text, "distortion_coefficients", 1, static_cast<std::int32_t>(distortion.size()),
                distortion, manner);
  if (!opencv) {
    const std::array<double, 9> same = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
    append_matrix(text, "rectification_matrix", 3, 3, same, manner);
    const std::array<double, 12> projection = {camera.fx_px, 0.0,          camera.cx_px, 0.0,
                                               0.0,          camera.fy_px, camera.cy_px, 0.0,
                                               0.0,          0.0,          1.0,          0.0};
    append_matrix(text, "projection_matrix", 3, 4, projection, manner);
  }
  return text;
}

}  // namespace tubesight::drivers
