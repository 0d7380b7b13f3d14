#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace tubesight::board {

/// What a file is, as far as its first bytes tell, or its name where it is not there.
enum class FileKind : std::uint8_t {
  kUnknown,    ///< also pipes and devices, which are not looked into
  kRecording,  ///< YUV4MPEG2, xz, and videos by their names
  kPicture,
  kTable,  ///< CSV
  kCameraYaml,
  kSettings,  ///< TOML of none of the following
  kScenario,  ///< TOML with [path]
  kTarget,    ///< TOML with [target]: of calibrate camera
  kBox,       ///< TOML with [source]: of tubesightd
};

/// Looks at a file; never fails, and reads 64 KiB at most.
[[nodiscard]] FileKind kind_of_file(const std::string& path);

/// A positional argument: its name in the usage, and the file given for it.
struct ArgumentFile {
  std::string name;
  std::string path;
};

/// Says in one line, without a full stop, which of a command's arguments are swapped or are files
/// of another kind: "'r.y4m' is a recording and 's.toml' a settings file: they are swapped,
/// expected SESSION.toml RECORDING". Empty when nothing is known to be wrong.
///
/// `usage` is the arguments' order as the help tells it, `first` what the first must be; of the
/// others pictures and recordings are expected, of RECORDING those alone.
[[nodiscard]] std::string find_mixed_up(std::span<const ArgumentFile> files, FileKind first,
                                        std::string_view usage);

/// The same of one file that is the value of an option: it must be of one of the kinds `wanted`, of
/// which there is one at least.
[[nodiscard]] std::string find_other_kind(const ArgumentFile& file,
                                          std::span<const FileKind> wanted);

}  // namespace tubesight::board
