#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>

#include <yaml.h>

#include "drivers/files/messages.h"

namespace tubesight::drivers {

/// A file in YAML as a tree, by libyaml; the first line of cv::FileStorage, which is no YAML, is
/// passed over.
class YamlTree {
 public:
  explicit YamlTree(std::string name) : name_(std::move(name)) {}
  YamlTree(const YamlTree&) = delete;
  YamlTree& operator=(const YamlTree&) = delete;
  ~YamlTree();

  /// False: it is no YAML, or not keys with values; `messages` say where.
  [[nodiscard]] bool read(std::string text, Messages& messages);

  /// What stands behind the first of these keys of a mapping; null where none of them does, or
  /// where `mapping` is none.
  [[nodiscard]] yaml_node_t* find(yaml_node_t* mapping,
                                  std::initializer_list<std::string_view> keys);
  [[nodiscard]] yaml_node_t* root() { return yaml_document_get_root_node(&document_); }

  /// The items of a sequence; those of the key `data` where it is a mapping; null where there are
  /// none.
  [[nodiscard]] yaml_node_t* sequence_of(yaml_node_t* node);
  [[nodiscard]] static std::int32_t size_of(const yaml_node_t* sequence);
  [[nodiscard]] yaml_node_t* item(yaml_node_t* sequence, std::int32_t index);

  /// The text of a scalar; empty of anything else.
  [[nodiscard]] static std::string_view text_of(const yaml_node_t* node);

  /// A finite number of a scalar; false where it is none.
  [[nodiscard]] static bool number_of(const yaml_node_t* node, double& value);

  /// "file:line: key: " of what stands there.
  [[nodiscard]] std::string place(const yaml_node_t* node, std::string_view key) const;

 private:
  std::string name_;
  yaml_document_t document_{};
  bool loaded_ = false;
};

}  // namespace tubesight::drivers
