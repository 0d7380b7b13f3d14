#include "board/bench/new/new_command.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <span>
#include <string_view>
#include <system_error>

#include <unistd.h>

#include "board/bench/calibrate/camera_exchange.h"
#include "board/bench/new/questions.h"
#include "board/bench/new/session_draft.h"
#include "board/bench/new/square_tool.h"
#include "board/bench/new/video_facts.h"
#include "board/bench/output/text_output.h"
#include "drivers/files/atomic_file.h"
#include "drivers/files/decimal.h"
#include "drivers/settings/session_keys.h"
#include "drivers/settings/session_settings.h"
#include "drivers/settings/text_files.h"

namespace tubesight::board {
namespace {

namespace fs = std::filesystem;

/// Numbers between commas, each in a range; blanks are passed over.
bool read_numbers(std::string text, std::span<double> values, double least, double most) {
  text.erase(std::remove_if(text.begin(), text.end(),
                            [](unsigned char letter) { return std::isspace(letter) != 0; }),
             text.end());
  const char* at = text.data();
  const char* const end = at + text.size();
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i > 0 && (at == end || *at++ != ',')) {
      return false;
    }
    const auto [next, error] = std::from_chars(at, end, values[i]);
    if (error != std::errc() || !(values[i] >= least && values[i] <= most)) {
      return false;
    }
    at = next;
  }
  return at == end;
}

/// A word's place in a list; -1: none.
int index_of(const std::string& word, std::span<const std::string_view> words) {
  const auto at = std::find(words.begin(), words.end(), word);
  return at == words.end() ? -1 : static_cast<int>(at - words.begin());
}

/// The files on the disk, and one that is not written yet.
class WithDraft final : public drivers::TextFiles {
 public:
  WithDraft(const std::string& path, const std::string& text) : path_(path), text_(text) {}

  [[nodiscard]] core::Result<void> read(const std::string& path, std::string& text,
                                        std::string& message) override {
    if (path == path_) {
      text = text_;
      return {};
    }
    return disk_.read(path, text, message);
  }

 private:
  drivers::DiskFiles disk_;
  const std::string& path_;
  const std::string& text_;
};

class NewRun {
 public:
  explicit NewRun(const NewOptions& options)
      : options_(options),
        questions_(::isatty(STDIN_FILENO) != 0 ? &std::cin : nullptr, std::cerr) {}

  ExitStatus run() {
    std::error_code why;
    if (fs::exists(options_.session, why)) {
      tell(options_.session + ": is there already, expected a new name: nothing is written over");
      return ExitStatus::kWrongInput;
    }
    const fs::path folder = fs::absolute(options_.session, why).parent_path();
    if (!fs::is_directory(folder, why)) {
      tell(options_.session + ": cannot be written: no such folder");
      return ExitStatus::kWrongInput;
    }
    std::string message;
    if (!read_video_facts(options_.video, draft_.facts, message)) {
      tell(message);
      return ExitStatus::kWrongInput;
    }
    draft_.video = options_.video;
    text_ += facts_text(options_.video, draft_.facts);
    if (const ExitStatus camera = take_camera(); camera != ExitStatus::kDone) {
      return camera;
    }
    take_sheet();
    take_tool();
    take_address();
    if (!questions_.missing().empty()) {
      for (const std::string& line : questions_.missing()) {
        tell("new: " + line);
      }
      return ExitStatus::kWrongInput;
    }
    return write();
  }

 private:
  ExitStatus take_camera() {
    core::CameraSettings& camera = draft_.camera;
    const bool given = !options_.camera.empty() || !options_.focal_mm.empty();
    std::string file = options_.camera;
    if (!given) {
      std::string answer;
      static_cast<void>(questions_.ask(
          "--camera or --efl-mm",
          "the camera's calibration file (.toml, or .yaml of OpenCV, ROS or Kalibr), or the "
          "lens' focal length in mm",
          "", [](const std::string&) { return true; }, answer));
      double focal_mm = 0.0;
      const bool number = read_numbers(answer, std::span(&focal_mm, 1), 0.1, 1000.0);
      (number ? focal_text_ : file) = answer;
    } else {
      focal_text_ = options_.focal_mm;
    }
    if (file.ends_with(".yaml") || file.ends_with(".yml")) {
      std::string report;
      const ExitStatus imported = import_camera(file, camera, report);
      text_ += report;
      draft_.camera_from = "from " + file + "; its cells stand for pixels of 0.01 mm";
      return imported == ExitStatus::kDone ? check_size(file) : imported;
    }
    if (!file.empty()) {
      return include_camera(file);
    }
    camera = {};
    camera.width_px = draft_.facts.width_px;
    camera.height_px = draft_.facts.height_px;
    take_scan();
    std::array<double, 2> cell_um{};
    std::string pixel = options_.pixel_um;
    const auto pixels = [&](const std::string& text) {
      if (read_numbers(text, std::span(cell_um.data(), 1), 0.5, 100.0)) {
        cell_um[1] = cell_um[0];
        return true;
      }
      return read_numbers(text, cell_um, 0.5, 100.0);
    };
    take_number("--efl-mm", "the lens' focal length (EFL), 0.1 to 1000 mm", 0.1, 1000.0,
                focal_text_, camera.focal_length_mm);
    questions_.ask(
        "--pixel-um",
        "the size of a pixel of the picture on the sensor, 0.5 to 100 um (or WIDTH,HEIGHT)", "",
        pixels, pixel);
    // To the nanometre, so that 9.8 um are 0.0098 mm.
    const auto mm_of = [](double um) { return std::round(um * 1e3) / 1e6; };
    camera.cell_width_mm = mm_of(cell_um[0]);
    camera.cell_height_mm = mm_of(cell_um[1]);
    camera.sensor_columns = camera.width_px;
    camera.frame_columns = camera.width_px;
    camera.horizontal_scale = 1.0;
    camera.center_px = {(camera.width_px - 1) / 2.0, (camera.height_px - 1) / 2.0};
    draft_.camera_from =
        "by data sheets alone, NOT CALIBRATED: `tubesight calibrate camera` finds the true values";
    return ExitStatus::kDone;
  }

  void take_scan() {
    const core::Scan seen = draft_.facts.scan.value_or(core::Scan::kProgressive);
    const std::string usual(drivers::kScanWords[static_cast<std::size_t>(seen)]);
    std::string scan = options_.scan;
    if (scan.empty() && draft_.facts.scan) {
      scan = usual;
    }
    questions_.ask(
        "--scan", "the order of the lines: even-first, odd-first or progressive", usual,
        [](const std::string& word) { return index_of(word, drivers::kScanWords) >= 0; }, scan);
    const int index = index_of(scan, drivers::kScanWords);
    draft_.camera.scan = index < 0 ? seen : static_cast<core::Scan>(index);
  }

  /// A file of calibrate camera stays what it is, with what it says of its own quality; of a
  /// session the camera is copied.
  ExitStatus include_camera(const std::string& file) {
    const auto session = std::make_unique<drivers::SessionFile>();
    drivers::Messages messages;
    drivers::NeededTables needed;
    needed.camera = true;
    if (!drivers::load_session_settings(file, needed, *session, messages)) {
      tell(messages);
      return ExitStatus::kWrongInput;
    }
    tell_files(session->files);
    draft_.camera = session->settings.camera;
    if (session->has_tool || session->has_start || session->settings.tubesheet.bore_mm > 0.0) {
      // A whole session: its other tables would stand twice.
      draft_.camera_from = "as in " + file;
      return check_size(file);
    }
    std::error_code why;
    const fs::path folder = fs::absolute(options_.session, why).parent_path();
    const fs::path relative =
        fs::path(file).is_absolute() ? fs::path(file) : fs::relative(file, folder, why);
    draft_.camera_file = relative.empty() ? file : relative.string();
    return check_size(file);
  }

  ExitStatus check_size(const std::string& file) {
    const auto& [width, height] = std::pair(draft_.facts.width_px, draft_.facts.height_px);
    if (draft_.camera.width_px != width || draft_.camera.height_px != height) {
      tell(file + ": of pictures of " + std::to_string(draft_.camera.width_px) + " x " +
           std::to_string(draft_.camera.height_px) + " px, and " + options_.video + " has " +
           std::to_string(width) + " x " + std::to_string(height) +
           ", expected the same: a calibration holds for its own size alone");
      return ExitStatus::kWrongInput;
    }
    if (draft_.camera_file.empty()) {
      take_scan();
    }
    return ExitStatus::kDone;
  }

  bool take_number(std::string_view option, const std::string& question, double least, double most,
                   std::string text, double& value) {
    return questions_.ask(
        option, question, "",
        [&](const std::string& answer) {
          return read_numbers(answer, std::span(&value, 1), least, most);
        },
        text);
  }

  void take_sheet() {
    constexpr std::array<std::string_view, 2> kLattices = {"square", "triangular"};
    constexpr double kBetween_deg = 15.0;  // of a right angle, either way, in perspective
    const auto& lattice = draft_.facts.lattice;
    std::string word = options_.lattice;
    std::string usual;
    if (lattice) {
      usual = std::abs(lattice->angle_deg - 90.0) < kBetween_deg ? "square" : "triangular";
    }
    questions_.ask(
        "--lattice", "how the tubes stand: square or triangular", usual,
        [&](const std::string& text) { return index_of(text, kLattices) >= 0; }, word);
    draft_.triangular = word == "triangular";
    if (!usual.empty() && index_of(word, kLattices) >= 0 && word != usual) {
      tell("new: told " + word + ", but in the first frame rows and columns stand " +
           drivers::rounded_text(lattice->angle_deg, 3) + " degrees apart, as of a " + usual +
           " lattice: look again");
    }
    take_number("--pitch-mm", "from centre to centre of neighbouring tubes, 2 to 500 mm", 2.0,
                500.0, options_.pitch_mm, draft_.pitch_mm);
    take_number("--bore-mm", "the inside diameter of a tube-end (the dark), 1 to 200 mm", 1.0,
                200.0, options_.bore_mm, draft_.bore_mm);
    warn_of_bore();
    std::string weld = options_.weld;
    questions_.ask(
        "--weld", "the tube-ends' welds: flush or fillet", "flush",
        [](const std::string& text) { return index_of(text, drivers::kWeldWords) >= 0; }, weld);
    draft_.weld = weld == "fillet" ? core::Weld::kFillet : core::Weld::kFlush;
  }

  /// Pitch and bore have one ratio in the plate and in the picture.
  void warn_of_bore() {
    constexpr double kUnlike = 0.25;
    if (!draft_.facts.lattice || draft_.pitch_mm <= 0.0 || draft_.bore_mm <= 0.0) {
      return;
    }
    const double told = draft_.bore_mm / draft_.pitch_mm;
    const double seen = draft_.facts.lattice->diameter_share;
    if (std::abs(told / seen - 1.0) > kUnlike) {
      tell("new: told a bore of " + drivers::rounded_text(told, 2) +
           " of the pitch, but in the first frame a tube-end's dark is " +
           drivers::rounded_text(seen, 2) + " of it: look again");
    }
  }

  void take_tool() {
    constexpr double kBefore_mm = 100.0;  // a tip in sight of an ordinary camera
    std::string place = options_.tool_mm;
    questions_.ask(
        "--tool-mm",
        "the guidetube's tip seen from the camera, X,Y,Z in mm (x right, y down, z "
        "forward)",
        "0,0,100",
        [&](const std::string& text) {
          return read_numbers(text, draft_.tool_mm, -1000.0, 1000.0);
        },
        place);
    if (options_.tool_mm.empty() && place == "0,0,100") {
      draft_.tool_mm = {0.0, 0.0, kBefore_mm};
    }
    draft_.tool_known = place != "0,0,100" || !options_.tool_deg.empty();
    std::string turn = options_.tool_deg.empty() ? "0,0,0" : options_.tool_deg;
    questions_.ask(
        "--tool-deg", "how it is turned, ALPHA,BETA,GAMMA in degrees, -360 to 360", "",
        [&](const std::string& text) { return read_numbers(text, draft_.tool_deg, -360.0, 360.0); },
        turn);
  }

  /// Without an address there are no clicks: they can be added by hand.
  void take_address() {
    std::string at = options_.at;
    if (!draft_.facts.lattice) {
      if (!at.empty()) {
        questions_.refuse(
            "--at: no tube-ends were found in the first frame, expected some to click on; without "
            "--at the session has no clicks");
      }
      return;
    }
    std::array<double, 2> address{};
    const auto& middle = draft_.facts.lattice->middle_px;
    questions_.ask(
        "--at",
        "the address of the tube-end at " + drivers::rounded_text(middle.x()) + ", " +
            drivers::rounded_text(middle.y()) +
            " px, ROW,COLUMN (none: - ), whole numbers from -9000 to 9000",
        "-",
        [&](const std::string& text) {
          return text == "-" ||
                 (read_numbers(text, address, -9000.0, 9000.0) &&
                  address[0] == std::floor(address[0]) && address[1] == std::floor(address[1]));
        },
        at);
    draft_.has_address = at != "-" && !at.empty();
    draft_.address = {static_cast<std::int32_t>(address[0]), static_cast<std::int32_t>(address[1])};
  }

  ExitStatus write() {
    std::string session = draft_text(draft_);
    WithDraft files(options_.session, session);
    drivers::Messages messages;
    const auto read = std::make_unique<drivers::SessionFile>();
    if (!drivers::load_session_settings(files, options_.session, drivers::kReplayNeeds, *read,
                                        messages)) {
      tell("new: with these answers the session contradicts itself, nothing was written:");
      tell(messages);
      return ExitStatus::kWrongInput;
    }
    fit_motion(read->settings.tubesheet, draft_);
    fit_tool(read->settings);
    session = draft_text(draft_);
    drivers::AtomicFile file;
    if (!file.open(options_.session) || !file.write(session) || !file.commit()) {
      tell(file.message());
      return ExitStatus::kJobFailed;
    }
    text_ += options_.session + ": written";
    text_ += draft_.has_address ? ", with three clicks to be checked"
                                : ", without clicks: a replay waits for a start";
    text_ += draft_.tool_known ? "\n" : "; where the guidetube is, is not known yet\n";
    return write_out(text_) ? ExitStatus::kDone : ExitStatus::kJobFailed;
  }

  /// The tracking must know from which side the camera sees the plate.
  void fit_tool(const core::SessionSettings& settings) {
    if (draft_.tool_known || !draft_.facts.lattice) {
      return;
    }
    if (const auto tool = square_tool(settings.camera, settings.tubesheet, *draft_.facts.lattice)) {
      draft_.tool_mm = tool->position_mm;
      draft_.tool_deg = tool->rotation_deg;
      draft_.tool_seen = true;
    }
  }

  const NewOptions& options_;
  Questions questions_;
  SessionDraft draft_;
  std::string focal_text_;
  std::string text_;
};

}  // namespace

ExitStatus run_new(const NewOptions& options) { return NewRun(options).run(); }

}  // namespace tubesight::board
