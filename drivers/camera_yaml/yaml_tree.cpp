#include "drivers/camera_yaml/yaml_tree.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <utility>

namespace tubesight::drivers {
namespace {

/// "%YAML:1.0" is what cv::FileStorage begins with; a directive has a space there, and another
/// version. Blanks keep the lines' numbers.
void blank_directive(std::string& text) {
  constexpr std::string_view kDirective = "%YAML:";
  if (text.starts_with(kDirective)) {
    std::fill_n(text.begin(), std::min(text.find('\n'), text.size()), ' ');
  }
}

const unsigned char* bytes_of(const std::string& text) {
  return reinterpret_cast<const unsigned char*>(text.data());
}

}  // namespace

YamlTree::~YamlTree() {
  if (loaded_) {
    yaml_document_delete(&document_);
  }
}

bool YamlTree::read(std::string text, Messages& messages) {
  blank_directive(text);
  yaml_parser_t parser;
  if (yaml_parser_initialize(&parser) == 0) {
    messages.push_back(name_ + ": no memory to read it");
    return false;
  }
  yaml_parser_set_input_string(&parser, bytes_of(text), text.size());
  loaded_ = yaml_parser_load(&parser, &document_) != 0;
  if (!loaded_) {
    const std::size_t line = parser.problem_mark.line + 1;
    messages.push_back(name_ + ":" + std::to_string(line) +
                       ": no YAML: " + (parser.problem == nullptr ? "unreadable" : parser.problem));
  }
  yaml_parser_delete(&parser);
  if (loaded_ && (root() == nullptr || root()->type != YAML_MAPPING_NODE)) {
    messages.push_back(name_ +
                       ": no keys with values, expected a camera as OpenCV or ROS write it");
    return false;
  }
  return loaded_;
}

yaml_node_t* YamlTree::find(yaml_node_t* mapping, std::initializer_list<std::string_view> keys) {
  if (mapping == nullptr || mapping->type != YAML_MAPPING_NODE) {
    return nullptr;
  }
  for (const std::string_view key : keys) {
    for (const yaml_node_pair_t* pair = mapping->data.mapping.pairs.start;
         pair < mapping->data.mapping.pairs.top; ++pair) {
      if (text_of(yaml_document_get_node(&document_, pair->key)) == key) {
        return yaml_document_get_node(&document_, pair->value);
      }
    }
  }
  return nullptr;
}

yaml_node_t* YamlTree::sequence_of(yaml_node_t* node) {
  if (node != nullptr && node->type == YAML_MAPPING_NODE) {
    node = find(node, {"data"});
  }
  return node != nullptr && node->type == YAML_SEQUENCE_NODE ? node : nullptr;
}

std::int32_t YamlTree::size_of(const yaml_node_t* sequence) {
  constexpr std::ptrdiff_t kMost = 1 << 20;
  return static_cast<std::int32_t>(
      std::min(kMost, sequence->data.sequence.items.top - sequence->data.sequence.items.start));
}

yaml_node_t* YamlTree::item(yaml_node_t* sequence, std::int32_t index) {
  return yaml_document_get_node(&document_, sequence->data.sequence.items.start[index]);
}

std::string_view YamlTree::text_of(const yaml_node_t* node) {
  if (node == nullptr || node->type != YAML_SCALAR_NODE) {
    return {};
  }
  return {reinterpret_cast<const char*>(node->data.scalar.value), node->data.scalar.length};
}

bool YamlTree::number_of(const yaml_node_t* node, double& value) {
  std::string_view text = text_of(node);
  if (text.starts_with('+')) {
    text.remove_prefix(1);
  }
  double number = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (text.empty() || error != std::errc() || end != text.data() + text.size() ||
      !std::isfinite(number)) {
    return false;
  }
  value = number;
  return true;
}

std::string YamlTree::place(const yaml_node_t* node, std::string_view key) const {
  std::string text = name_;
  if (node != nullptr) {
    text += ":" + std::to_string(node->start_mark.line + 1);
  }
  return text + ": " + std::string(key) + ": ";
}

}  // namespace tubesight::drivers
