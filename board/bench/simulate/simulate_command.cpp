#include "board/bench/simulate/simulate_command.h"

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "board/bench/output/output_paths.h"
#include "board/bench/output/progress_line.h"
#include "board/bench/output/text_output.h"
#include "board/bench/simulate/recording_files.h"
#include "drivers/files/decimal.h"
#include "drivers/files/messages.h"
#include "drivers/scenario/scenario_file.h"
#include "drivers/settings/session_checks.h"
#include "drivers/settings/toml_writer.h"
#include "drivers/simulated/simulated_world.h"

namespace tubesight::board {
namespace {

/// Where an output cannot go; empty when all can.
std::string find_output_conflict(const SimulateOptions& options,
                                 const drivers::ScenarioFile& file) {
  if (options.out.empty() || options.out.ends_with('/')) {
    return "--out: '" + options.out + "' is no name, expected what the files' names begin with";
  }
  std::vector<NamedPath> inputs;
  for (const std::string& path : file.files) {
    inputs.push_back({"a file of the scenario", path});
  }
  std::vector<NamedPath> outputs;
  for (const char* const suffix : kRecordingSuffixes) {
    outputs.push_back({"--out", options.out + suffix});
  }
  return find_clash(inputs, outputs);
}

std::string summary(const SimulateOptions& options, const drivers::ScenarioFile& file,
                    const drivers::SimulatedWorld& world, std::int64_t frames,
                    std::int64_t delivered) {
  const core::CameraSettings& camera = file.scenario.scene.camera;
  std::string text = options.out + ".y4m: " + std::to_string(camera.width_px) + " x " +
                     std::to_string(camera.height_px) + ", " + std::to_string(frames) +
                     " frames, " + std::to_string(delivered) + " of " +
                     std::to_string(world.slots()) + " fields delivered, ";
  drivers::append_decimal(text, world.slot_time(world.slots()).count(), 1'000'000'000, 3);
  return text + " s\n";
}

/// Says in the session file what the recording is of.
std::string heading(const SimulateOptions& options, const drivers::ScenarioFile& file) {
  const std::string from = std::filesystem::path(options.scenario).filename().string() + ", seed " +
                           std::to_string(file.scenario.seed);
  return (file.title.empty() ? "" : drivers::toml_comment(file.title)) +
         drivers::toml_comment(from) + "\n";
}

}  // namespace

ExitStatus run_simulate(const SimulateOptions& options) {
  const auto file = std::make_unique<drivers::ScenarioFile>();
  drivers::Messages messages;
  const bool good =
      drivers::load_scenario(options.scenario, {options.seed, options.window_only}, *file, messages)
          .has_value();
  tell(messages);
  if (!good) {
    return ExitStatus::kWrongInput;
  }
  tell_files(file->files);
  if (const std::string conflict = find_output_conflict(options, *file); !conflict.empty()) {
    tell(conflict);
    return ExitStatus::kWrongInput;
  }
  const auto world = std::make_unique<drivers::SimulatedWorld>();
  if (!world->configure(file->scenario)) {
    tell(options.scenario + ": cannot be played, expected what drivers::load_scenario() checks");
    return ExitStatus::kWrongInput;
  }
  const std::chrono::duration<double> span = world->slot_time(1) - world->slot_time(0);
  if (const std::string why = drivers::why_fields_too_seldom(
          file->scenario.told.motion, file->scenario.told.tubesheet, span.count());
      !why.empty()) {
    tell(options.scenario + ": the recording can be drawn and not be tracked: " + why);
  }
  tell_more(options.scenario + ": seed " + std::to_string(file->scenario.seed) + ", " +
            std::to_string(world->slots()) + " fields to draw");
  RecordingFiles files;
  if (!files.open(options.out, file->scenario, heading(options, *file))) {
    tell(files.message());
    return ExitStatus::kWrongInput;
  }
  ProgressLine progress;
  drivers::SimulatedField field;
  std::int64_t delivered = 0;
  while (world->next_slot(field)) {
    delivered += field.lost ? 0 : 1;
    if (!files.add(*world, field)) {
      progress.erase();
      tell(files.message());
      return ExitStatus::kJobFailed;
    }
    progress.update(ProgressLine::Clock::now(), delivered, field.field.mid_exposure,
                    static_cast<double>(field.slot + 1) / static_cast<double>(world->slots()));
  }
  progress.erase();
  if (!files.commit()) {
    tell(files.message());
    return ExitStatus::kJobFailed;
  }
  const std::string text = summary(options, *file, *world, files.frames(), delivered);
  if (!write_out(text)) {
    return ExitStatus::kJobFailed;
  }
  return ExitStatus::kDone;
}

}  // namespace tubesight::board
