#include "drivers/aravis/functions.h"

#include <dlfcn.h>

namespace tubesight::drivers::aravis {
namespace {

/// Its version of the interface, which Debian 12 and 13 have.
constexpr const char* kLibrary = "libaravis-0.8.so.0";

Functions* load(std::string& why) {
  static Functions functions;
  void* const library = dlopen(kLibrary, RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) {
    why = std::string("needs the library ") + kLibrary +
          " (Debian's package libaravis-0.8-0), which is not there: " + dlerror();
    return nullptr;
  }
  for (Place& place : functions.all.all()) {
    place.at = dlsym(library, place.name);
    if (place.at == nullptr) {
      why = std::string("the library ") + kLibrary + " has no " + place.name +
            ", expected version 0.8.26 or later";
      return nullptr;
    }
  }
  return &functions;
}

}  // namespace

const Functions* load_functions(std::string& why) {
  static const Functions* loaded = nullptr;  // one that is not there may be installed meanwhile
  if (loaded == nullptr) {
    loaded = load(why);
  }
  return loaded;
}

}  // namespace tubesight::drivers::aravis
