#include "board/bench/look/look_command.h"

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "board/bench/look/look_overlay.h"
#include "board/bench/look/look_text.h"
#include "board/bench/output/output_paths.h"
#include "board/bench/output/progress_line.h"
#include "board/bench/output/still_reader.h"
#include "board/bench/output/text_output.h"
#include "core/detection/lattice_finder.h"
#include "core/picture/averaged_picture.h"
#include "drivers/files/atomic_file.h"
#include "drivers/files/picture_reader.h"
#include "drivers/files/png_writer.h"

namespace tubesight::board {
namespace {

using core::detection::FinderRefusal;

/// One run of the command; on the heap, as the finder is large.
class LookRun {
 public:
  explicit LookRun(const LookOptions& options) : options_(options) {}

  ExitStatus run() {
    if (const std::string wrong = why_outputs_wrong(); !wrong.empty()) {
      tell(wrong);
      return ExitStatus::kWrongInput;
    }
    ExitStatus status = ExitStatus::kDone;
    const std::vector<Still> stills = stills_of(options_.pictures, {});
    ProgressLine progress;
    for (const Still& still : stills) {
      progress.update(
          ProgressLine::Clock::now(), still.name(),
          static_cast<double>(&still - stills.data()) / static_cast<double>(stills.size()));
      const ExitStatus one = look_at(still);
      if (one == ExitStatus::kWrongInput) {
        return one;
      }
      status = one == ExitStatus::kDone ? status : one;
    }
    progress.erase();
    return (lattices_ > 0 && !write()) || !write_out(text_, goes_to_standard_output({options_.csv}))
               ? ExitStatus::kJobFailed
               : status;
  }

 private:
  [[nodiscard]] std::string why_outputs_wrong() const {
    if (!options_.overlay.empty() && options_.pictures.size() > 1) {
      return "--overlay: one picture for " + std::to_string(options_.pictures.size()) +
             ", expected one PICTURE";
    }
    if (std::string wrong = why_no_png("--overlay", options_.overlay); !wrong.empty()) {
      return wrong;
    }
    std::vector<NamedPath> inputs;
    for (const std::string& picture : options_.pictures) {
      inputs.push_back({"a picture", picture});
    }
    const std::vector<NamedPath> outputs = {{"--csv", options_.csv},
                                            {"--overlay", options_.overlay}};
    return find_clash(inputs, outputs);
  }

  ExitStatus look_at(const Still& still) {
    std::string message;
    if (!reader_.read(still, picture_, message)) {
      tell(message);
      return ExitStatus::kWrongInput;
    }
    FinderRefusal refusal = FinderRefusal::kSize;
    sums_.resize(picture_.pixels.size());
    scratch_.resize(picture_.pixels.size());
    if (const auto averaged = core::picture::average_of_one(picture_.view(), sums_)) {
      core::detection::FinderOptions finder;
      finder.with_faint = true;
      refusal = finder_->find(*averaged, finder, scratch_, *found_);
    }
    if (refusal != FinderRefusal::kNone) {
      tell(still.name() + ": no lattice found: " + std::string(explain(refusal)));
      return ExitStatus::kJobFailed;
    }
    ++lattices_;
    text_ += look_text(still.name(), *found_);
    append_look_rows(rows_, still.name(), *found_);
    if (!options_.overlay.empty()) {
      overlay_ = draw_lattice(picture_.view(), *found_, overlay_pixels_);
    }
    return ExitStatus::kDone;
  }

  bool write() {
    if (!options_.csv.empty()) {
      drivers::AtomicFile file;
      if (!open_output(file, options_.csv) ||
          !file.write(std::string(kLookHeader) + '\n' + rows_) || !file.commit()) {
        tell(file.message());
        return false;
      }
    }
    std::string message;
    if (overlay_.pixels != nullptr && !drivers::write_png(options_.overlay, overlay_, message)) {
      tell(message);
      return false;
    }
    return true;
  }

  const LookOptions& options_;
  StillReader reader_;
  drivers::GreyPicture picture_;
  std::vector<std::uint16_t> sums_;
  std::vector<std::uint16_t> scratch_;
  std::unique_ptr<core::detection::LatticeFinder> finder_ =
      std::make_unique<core::detection::LatticeFinder>();
  std::unique_ptr<core::detection::FoundLattice> found_ =
      std::make_unique<core::detection::FoundLattice>();
  std::string text_;
  std::string rows_;
  std::vector<std::uint8_t> overlay_pixels_;
  core::RgbImageView overlay_;
  std::int32_t lattices_ = 0;
};

}  // namespace

ExitStatus run_look(const LookOptions& options) {
  return std::make_unique<LookRun>(options)->run();
}

}  // namespace tubesight::board
