#include "board/bench/argument_files.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "board/bench/input/recording_input.h"
#include "drivers/files/small_letters.h"

namespace tubesight::board {
namespace {

constexpr std::size_t kMostBytes = 65536;

struct Beginning {
  std::string_view bytes;
  FileKind kind;
};
constexpr std::array kBeginnings = {
    Beginning{"YUV4MPEG2", FileKind::kRecording},
    Beginning{"\xFD"
              "7zXZ",
              FileKind::kRecording},
    Beginning{"\x1A\x45\xDF\xA3", FileKind::kRecording},  // Matroska, WebM
    Beginning{"RIFF", FileKind::kRecording},              // AVI
    Beginning{"\x89PNG", FileKind::kPicture},
    Beginning{"P5", FileKind::kPicture},
    Beginning{"\xFF\xD8\xFF", FileKind::kPicture},  // JPEG
    Beginning{"II*", FileKind::kPicture},           // TIFF
    Beginning{std::string_view("MM\0*", 4), FileKind::kPicture},
};

struct Ending {
  std::string_view text;
  FileKind kind;
};
constexpr std::array kEndings = {
    Ending{".png", FileKind::kPicture},     Ending{".pgm", FileKind::kPicture},
    Ending{".jpg", FileKind::kPicture},     Ending{".jpeg", FileKind::kPicture},
    Ending{".tif", FileKind::kPicture},     Ending{".tiff", FileKind::kPicture},
    Ending{".bmp", FileKind::kPicture},     Ending{".csv", FileKind::kTable},
    Ending{".yaml", FileKind::kCameraYaml}, Ending{".yml", FileKind::kCameraYaml},
    Ending{".toml", FileKind::kSettings},
};

FileKind kind_of_name(std::string_view file) {
  if (is_named_as_recording(file)) {
    return FileKind::kRecording;
  }
  const std::string name = drivers::small_letters(file);
  for (const Ending& ending : kEndings) {
    if (name.ends_with(ending.text)) {
      return ending.kind;
    }
  }
  return FileKind::kUnknown;
}

/// Which of the settings a TOML file holds, by its tables.
FileKind kind_of_settings(std::string_view text) {
  struct Table {
    std::string_view name;
    FileKind kind;
  };
  constexpr std::array kTables = {Table{"\n[path]", FileKind::kScenario},
                                  Table{"\n[target]", FileKind::kTarget},
                                  Table{"\n[source]", FileKind::kBox}};
  for (const Table& table : kTables) {
    if (text.starts_with(table.name.substr(1)) || text.find(table.name) != std::string_view::npos) {
      return table.kind;
    }
  }
  return FileKind::kSettings;
}

const char* words_of(FileKind kind) {
  switch (kind) {
    case FileKind::kRecording: return "a recording";
    case FileKind::kPicture: return "a picture";
    case FileKind::kTable: return "a table (CSV)";
    case FileKind::kCameraYaml: return "a camera's file (YAML)";
    case FileKind::kSettings: return "a settings file";
    case FileKind::kScenario: return "a scenario (simulate draws it)";
    case FileKind::kTarget: return "a calibration target's file (calibrate camera reads it)";
    case FileKind::kBox: return "a box's settings file (tubesightd reads it)";
    case FileKind::kUnknown: break;
  }
  return "a file";
}

bool is_toml(FileKind kind) { return kind >= FileKind::kSettings; }

/// Whether a file may stand where `wanted` is expected; what is not known may.
bool fits(FileKind kind, FileKind wanted) {
  // A scenario that includes its tables shows none of them.
  return kind == FileKind::kUnknown || kind == wanted ||
         (kind == FileKind::kSettings && is_toml(wanted));
}

}  // namespace

FileKind kind_of_file(const std::string& path) {
  const FileKind by_name = kind_of_name(path);
  std::error_code why;
  if (!std::filesystem::is_regular_file(path, why)) {
    return std::filesystem::exists(path, why) ? FileKind::kUnknown : by_name;
  }
  std::ifstream file(path, std::ios::binary);
  std::string text(kMostBytes, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(file.gcount()));
  for (const Beginning& beginning : kBeginnings) {
    if (text.starts_with(beginning.bytes)) {
      return beginning.kind;
    }
  }
  if (text.size() > 8 && std::string_view(text).substr(4, 4) == "ftyp") {  // MP4, MOV
    return FileKind::kRecording;
  }
  if (by_name == FileKind::kSettings) {
    return kind_of_settings(text);
  }
  // A picture or a recording by its name alone is told better by whoever reads it.
  return by_name == FileKind::kTable || by_name == FileKind::kCameraYaml ? by_name
                                                                         : FileKind::kUnknown;
}

std::string find_other_kind(const ArgumentFile& file, std::span<const FileKind> wanted) {
  const FileKind kind = kind_of_file(file.path);
  const bool good =
      std::any_of(wanted.begin(), wanted.end(), [kind](FileKind one) { return fits(kind, one); });
  if (good) {
    return {};
  }
  std::string expected;
  for (const FileKind one : wanted) {
    expected += (expected.empty() ? "" : " or ") + std::string(words_of(one));
  }
  return "'" + file.path + "' is " + words_of(kind) + ", expected " + expected + " as " + file.name;
}

std::string find_mixed_up(std::span<const ArgumentFile> files, FileKind first,
                          std::string_view usage) {
  if (files.empty()) {
    return {};
  }
  const FileKind leading = kind_of_file(files.front().path);
  const auto others = files.subspan(1);
  if (!fits(leading, first)) {
    const auto swapped = std::find_if(others.begin(), others.end(), [&](const ArgumentFile& file) {
      const FileKind kind = kind_of_file(file.path);
      return kind != FileKind::kUnknown && fits(kind, first);
    });
    return swapped == others.end()
               ? find_other_kind(files.front(), std::array{first})
               : "'" + files.front().path + "' is " + words_of(leading) + " and '" + swapped->path +
                     "' " + words_of(kind_of_file(swapped->path)) +
                     ": they are swapped, expected " + std::string(usage);
  }
  constexpr std::array kSeen = {FileKind::kPicture, FileKind::kRecording};
  for (const ArgumentFile& file : others) {
    const std::size_t pictures = file.name == "RECORDING" ? 1 : 0;  // which it may not be
    if (std::string wrong = find_other_kind(file, std::span(kSeen).subspan(pictures));
        !wrong.empty()) {
      return wrong;
    }
  }
  return {};
}

}  // namespace tubesight::board
