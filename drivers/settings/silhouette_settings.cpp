#include "drivers/settings/silhouette_settings.h"

#include <algorithm>
#include <optional>

#include "drivers/files/decimal.h"
#include "drivers/settings/session_keys.h"
#include "drivers/settings/tomlplusplus.h"

namespace tubesight::drivers {
namespace {

constexpr NumberRange kDiameter{1.0, 200.0, " mm"};
constexpr NumberRange kLength{1.0, 2000.0, " mm"};
constexpr NumberRange kSigma{0.0, 100.0, " px"};

std::string key_of(std::size_t edge) { return std::string(kSilhouetteEdges[edge]) + "_px"; }

/// Two numbers in the largest picture; empty for anything else.
std::optional<std::array<double, 2>> point_of(const toml::node& node) {
  const toml::array* const pair = node.as_array();
  if (pair == nullptr || pair->size() != 2) {
    return std::nullopt;
  }
  std::array<double, 2> point{};
  for (std::size_t i = 0; i < point.size(); ++i) {
    const auto value = (*pair)[i].value<double>();
    if (!value || !(*value >= kPicturePlace.least && *value <= kPicturePlace.most)) {
      return std::nullopt;
    }
    point[i] = *value;
  }
  return point;
}

void read_points(TableReader& table, const std::string& key, SilhouetteEdgeSettings& edge) {
  const toml::array* const list = table.list(key, false, "[[u, v], ...]");
  if (list == nullptr) {
    return;
  }
  if (list->size() > kMostSilhouettePoints) {
    table.complain(key, std::to_string(list->size()) + " points, expected at most " +
                            std::to_string(kMostSilhouettePoints));
    return;
  }
  for (std::size_t i = 0; i < list->size(); ++i) {
    const auto point = point_of((*list)[i]);
    if (!point) {
      table.complain_entry(key, i, (*list)[i],
                           describe((*list)[i]) + ", expected [u, v], each from 0 to " +
                               std::to_string(kSide_px.most) + " px");
      return;
    }
    edge.points_px.push_back(*point);
  }
}

}  // namespace

void read_silhouette(TableReader& table, SilhouetteSettings& silhouette) {
  silhouette = {};
  table.number("diameter_mm", kDiameter, silhouette.diameter_mm);
  table.number("length_mm", kLength, silhouette.length_mm);
  std::array<double, kSilhouetteEdges.size()> sigma_px{};
  table.numbers("sigma_px", kSigma, sigma_px);
  std::vector<std::string> measured;
  table.optional_texts("measured", measured);
  for (std::size_t i = 0; i < kSilhouetteEdges.size(); ++i) {
    SilhouetteEdgeSettings& edge = silhouette.edges[i];
    edge.sigma_px = sigma_px[i];
    read_points(table, key_of(i), edge);
    edge.measured =
        std::find(measured.begin(), measured.end(), kSilhouetteEdges[i]) != measured.end();
  }
  for (const std::string& word : measured) {
    if (std::find(kSilhouetteEdges.begin(), kSilhouetteEdges.end(), word) ==
        kSilhouetteEdges.end()) {
      table.complain("measured",
                     "the text '" + word + "', expected \"left\", \"tip\" or \"right\"");
    }
  }
}

std::string silhouette_text(const SilhouetteSettings& silhouette) {
  TomlWriter toml(TomlManner::kPlain);
  toml.table("silhouette");
  toml.number("diameter_mm", silhouette.diameter_mm);
  toml.number("length_mm", silhouette.length_mm);
  std::string measured;
  std::string sigma;
  for (std::size_t i = 0; i < kSilhouetteEdges.size(); ++i) {
    const SilhouetteEdgeSettings& edge = silhouette.edges[i];
    std::string points;
    for (const std::array<double, 2>& point : edge.points_px) {
      print(points, points.empty() ? "[%.3f, %.3f]" : ", [%.3f, %.3f]", point[0], point[1]);
    }
    toml.raw(key_of(i), "[" + points + "]");
    print(sigma, i == 0 ? "%.3f" : ", %.3f", edge.sigma_px);
    if (edge.measured) {
      measured += (measured.empty() ? "\"" : ", \"") + std::string(kSilhouetteEdges[i]) + "\"";
    }
  }
  toml.raw("measured", "[" + measured + "]");
  toml.raw("sigma_px", "[" + sigma + "]");
  return toml.take();
}

}  // namespace tubesight::drivers
