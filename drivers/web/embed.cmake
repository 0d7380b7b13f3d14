# Writes OUT, a C++ source with the bytes of FILES (a list of names) of FOLDER:
#   cmake -D OUT=... -D FOLDER=... -D FILES=a,b -P embed.cmake
string(REPLACE "," ";" FILES "${FILES}")
set(arrays)
set(rows)
set(number 0)
foreach(name IN LISTS FILES)
  file(READ ${FOLDER}/${name} bytes HEX)
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${bytes}")
  string(APPEND arrays "constexpr unsigned char kFile${number}[] = {${bytes}0};\n")
  string(APPEND rows "    EmbeddedFile{\"${name}\", text_of(kFile${number}, sizeof(kFile${number}) - 1)},\n")
  math(EXPR number "${number} + 1")
endforeach()
file(WRITE ${OUT} "// Made by drivers/web/embed.cmake.
#include \"drivers/web/embedded_files.h\"

#include <array>
#include <cstddef>

namespace tubesight::drivers {
namespace {

${arrays}
std::string_view text_of(const unsigned char* bytes, std::size_t count) {
  return {reinterpret_cast<const char*>(bytes), count};
}

}  // namespace

std::span<const EmbeddedFile> embedded_files() {
  static const std::array<EmbeddedFile, ${number}> kFiles = {
${rows}  };
  return kFiles;
}

}  // namespace tubesight::drivers
")
