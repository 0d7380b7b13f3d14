#include "tests/drivers/aravis/fake_library.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/spsc_queue.h"
#include "tests/support/drawn_grey.h"

namespace tubesight::tests {

using core::Error;
using core::FieldTime;
using core::Result;
using core::Unexpected;
using drivers::aravis::Bounds;
using drivers::aravis::Picture;
using drivers::aravis::Quantity;
using drivers::aravis::Region;
using drivers::aravis::StreamCounts;
using drivers::aravis::StreamPlan;
using drivers::aravis::Taken;

/// An open camera of the fake library.
class FakeDevice final : public drivers::aravis::Device {
 public:
  FakeDevice(FakeLibrary& library, std::shared_ptr<FakeGigeCamera> camera)
      : library_(&library), camera_(std::move(camera)) {}

  std::string serial() override { return camera_->serial; }
  std::string maker_and_model() override { return "Fake Model"; }
  std::vector<std::string> formats() override { return camera_->formats; }
  bool set_format(const std::string& name, std::string& why) override {
    camera_->format = camera_->kept_format.empty() ? name : camera_->kept_format;
    why = "keeps " + camera_->format;
    return camera_->format == name;
  }
  bool set_binning(std::int32_t pixels, std::string& why) override {
    why.clear();
    camera_->binned = camera_->binning ? pixels : 1;
    return camera_->binning;
  }
  bool set_region(const Region& region, std::string& why) override {
    const Region whole = sensor();
    why = "out of range";
    camera_->region = region;
    camera_->region.width_px -= region.width_px % camera_->widths_of;
    return region.left_px + region.width_px <= whole.width_px &&
           region.top_px + region.height_px <= whole.height_px;
  }
  bool region(Region& region, std::string& /*why*/) override {
    region = camera_->region;
    return true;
  }
  Region sensor() override {
    return {0, 0, camera_->sensor.width_px / camera_->binned,
            camera_->sensor.height_px / camera_->binned};
  }
  std::vector<std::string> alterations() override { return camera_->alterations; }
  bool has(Quantity quantity) override { return camera_->numbers.contains(quantity); }
  void by_hand(Quantity quantity) override {
    if (has(quantity)) {
      camera_->numbers[quantity].by_hand = true;
    }
  }
  bool set(Quantity quantity, double value, std::string& why) override {
    FakeGigeCamera::Number& number = camera_->numbers[quantity];
    why = "out of range";
    if (value < number.bounds.least || value > number.bounds.most) {
      return false;
    }
    number.value = number.step > 0.0 ? std::round(value / number.step) * number.step : value;
    return true;
  }
  bool get(Quantity quantity, double& value, std::string& /*why*/) override {
    value = camera_->numbers[quantity].value;
    return true;
  }
  bool bounds(Quantity quantity, Bounds& bounds) override {
    if (has(quantity)) {
      bounds = camera_->numbers[quantity].bounds;
    }
    return has(quantity);
  }
  bool set_trigger(const std::string& line, std::string& why) override {
    why = "no such line";
    camera_->trigger = line;
    return line.empty() || std::ranges::find(camera_->triggers, line) != camera_->triggers.end();
  }
  bool has_packets() override { return camera_->packets; }
  bool set_packet_size(std::int32_t bytes, std::string& why) override {
    why = "refused";
    camera_->packet = std::max(bytes, camera_->least_packet);
    return !camera_->refuses_size;
  }
  bool negotiate_packet_size(std::string& /*why*/) override {
    camera_->packet = camera_->negotiated_packet;
    return true;
  }
  std::int32_t packet_size() override { return camera_->packet; }
  std::size_t payload() override {
    return line_bytes(camera_->format, camera_->region.width_px) *
               static_cast<std::size_t>(camera_->region.height_px) +
           camera_->bytes_beside;
  }
  void quieten() override {}

  bool begin(const StreamPlan& plan, const hal::Clock& /*clock*/, std::string& why) override {
    why = "no bandwidth";
    camera_->plan = plan;
    begin_ = library_->now();
    number_ = 0;
    id_ = camera_->first_id;
    code_ = code_of(camera_->format);
    line_.resize(static_cast<std::size_t>(camera_->region.width_px));
    for (std::int32_t i = 0; i < plan.buffers; ++i) {
      give_back(i);
    }
    return camera_->starts;
  }
  void end(bool gone) override { camera_->stopped = !gone; }
  void look_after() override {}
  StreamCounts counts() override { return camera_->counts; }

  Taken take(std::chrono::milliseconds timeout, Picture& picture) override {
    const FieldTime until = library_->now() + timeout;
    while (true) {
      if (camera_->taken) {
        return Taken::kControlLost;
      }
      while (camera_->every > FieldTime{0} && !camera_->absent && arrival() <= library_->now()) {
        expose();
      }
      if (filled_.try_pop(picture)) {
        return Taken::kPicture;
      }
      if (camera_->every <= FieldTime{0} || camera_->absent || arrival() > until) {
        library_->now_ = until;
        return Taken::kNothing;
      }
      library_->now_ = arrival();
    }
  }
  void give_back(std::int32_t buffer) override { static_cast<void>(free_.try_push(buffer)); }

 private:
  [[nodiscard]] FieldTime instant() const { return begin_ + (number_ + 1) * camera_->every; }
  [[nodiscard]] FieldTime arrival() const { return instant() + camera_->delay; }

  void expose() {
    Picture picture;
    picture.complete = camera_->packet <= camera_->path;
    picture.frame_id = id_;
    const std::int64_t at = instant().count();
    picture.stamp_ns = static_cast<std::uint64_t>(
        at + camera_->clock_ahead_ns + (at / 1000) * camera_->clock_fast_ppb / 1'000'000);
    picture.arrival = arrival();
    picture.width_px = camera_->region.width_px;
    picture.height_px = camera_->region.height_px;
    picture.format = code_;
    picture.bytes = payload() - camera_->bytes_beside;
    ++number_;
    id_ = id_ == camera_->last_id ? 1 : id_ + 1;
    if (!free_.try_pop(picture.buffer)) {
      ++camera_->counts.underruns;
      return;
    }
    const auto memory = camera_->plan.memory.subspan(
        static_cast<std::size_t>(picture.buffer) * camera_->plan.buffer_bytes,
        camera_->plan.buffer_bytes);
    draw(memory);
    if (camera_->tamper) {
      camera_->tamper(library_->pictures_, picture, memory);
    }
    ++library_->pictures_;
    static_cast<void>(filled_.try_push(picture));
  }

  void draw(std::span<std::byte> memory) {
    const auto width = static_cast<std::size_t>(camera_->region.width_px);
    for (std::int32_t v = 0; v < camera_->region.height_px; ++v) {
      for (std::size_t u = 0; u < width; ++u) {
        line_[u] = drawn_grey(static_cast<std::int32_t>(u), v);
      }
      lay_line(camera_->format, line_,
               memory.data() + static_cast<std::size_t>(v) *
                                   line_bytes(camera_->format, camera_->region.width_px));
    }
  }

  FakeLibrary* library_;
  std::shared_ptr<FakeGigeCamera> camera_;
  FieldTime begin_{0};
  std::int64_t number_ = 0;
  std::uint64_t id_ = 0;
  std::uint32_t code_ = 0;
  core::SpscQueue<std::int32_t, kMostBuffers> free_;
  core::SpscQueue<Picture, kMostBuffers> filled_;
  std::vector<std::uint8_t> line_;
};

FakeLibrary::FakeLibrary() = default;
FakeLibrary::~FakeLibrary() = default;

Result<drivers::aravis::Device*> FakeLibrary::open(const std::string& device, std::string& why) {
  for (const auto& camera : cameras_) {
    if (camera->device == device && !camera->absent) {
      why = "is busy: another program has its control, expected it free";
      if (camera->busy) {
        return Unexpected(Error::kIo);
      }
      camera->taken = false;
      open_.push_back(std::make_unique<FakeDevice>(*this, camera));
      return open_.back().get();
    }
  }
  advance(std::chrono::milliseconds(2500));  // as it was measured
  why = "does not answer";
  return Unexpected(Error::kDisconnected);
}

void FakeLibrary::close(drivers::aravis::Device& device) {
  std::erase_if(open_, [&](const auto& ours) { return ours.get() == &device; });
}

bool FakeLibrary::list(std::vector<drivers::aravis::CameraInfo>& cameras, std::string& /*why*/) {
  for (const auto& camera : cameras_) {
    cameras.push_back({camera->serial, camera->device, "Fake Model", "GigEVision"});
  }
  return true;
}

}  // namespace tubesight::tests
