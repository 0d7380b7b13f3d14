#include "drivers/web/page_files.h"

#include <algorithm>

#include "drivers/web/embedded_files.h"

namespace tubesight::drivers {
namespace {

std::string_view type_of(std::string_view name) {
  const std::string_view ending = name.substr(std::min(name.rfind('.'), name.size()));
  if (ending == ".html") {
    return "text/html; charset=utf-8";
  }
  if (ending == ".js") {
    return "text/javascript; charset=utf-8";
  }
  if (ending == ".css") {
    return "text/css; charset=utf-8";
  }
  return ending == ".svg" ? "image/svg+xml" : "application/octet-stream";
}

}  // namespace

std::optional<PageFile> page_file(std::string_view path) {
  constexpr std::string_view kFolder = "/page/";
  std::string_view name = "index.html";
  if (path != "/") {
    if (!path.starts_with(kFolder)) {
      return {};
    }
    name = path.substr(kFolder.size());
  }
  for (const EmbeddedFile& file : embedded_files()) {
    if (file.name == name) {
      return PageFile{type_of(name), file.bytes};
    }
  }
  return {};
}

}  // namespace tubesight::drivers
