#include "drivers/v4l2/camera_setup.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <span>
#include <vector>

#include <linux/videodev2.h>

#include "drivers/v4l2/camera_controls.h"
#include "drivers/v4l2/camera_finder.h"

namespace tubesight::drivers::v4l2 {
namespace {

using core::Error;
using core::Result;
using core::Unexpected;

/// Entries of one list that a driver is asked for: one that never ends must not hold us.
constexpr std::uint32_t kMostEntries = 64;
/// By how much a rate may differ from the one wanted; drivers round to their own clock.
constexpr double kRateTolerance = 0.01;

/// One try of a format: how V4L2 calls it, and what a buffer then holds.
struct Layout {
  std::uint32_t field;
  FieldLayout wanted;
  BufferKind kind;
};
constexpr std::array<Layout, 4> kInterlacedLayouts{{
    {V4L2_FIELD_INTERLACED, FieldLayout::kInterlaced, BufferKind::kPair},
    {V4L2_FIELD_ALTERNATE, FieldLayout::kAlternate, BufferKind::kOneField},
    {V4L2_FIELD_SEQ_TB, FieldLayout::kSequential, BufferKind::kPair},
    {V4L2_FIELD_SEQ_BT, FieldLayout::kSequential, BufferKind::kPair},
}};
constexpr std::array<Layout, 1> kProgressiveLayouts{
    {{V4L2_FIELD_NONE, FieldLayout::kAny, BufferKind::kFrame}}};

const char* words_of_field(std::uint32_t field) {
  switch (field) {
    case V4L2_FIELD_NONE: return "progressive";
    case V4L2_FIELD_TOP: return "the even field alone";
    case V4L2_FIELD_BOTTOM: return "the odd field alone";
    case V4L2_FIELD_INTERLACED:
    case V4L2_FIELD_INTERLACED_TB:
    case V4L2_FIELD_INTERLACED_BT: return "interlaced";
    case V4L2_FIELD_SEQ_TB:
    case V4L2_FIELD_SEQ_BT: return "sequential";
    case V4L2_FIELD_ALTERNATE: return "alternate";
    default: return "of no known order";
  }
}

/// Whether a driver that was asked for one answers with as good a one.
bool same_layout(std::uint32_t asked, std::uint32_t got) {
  return asked == got || (V4L2_FIELD_IS_INTERLACED(asked) && V4L2_FIELD_IS_INTERLACED(got)) ||
         (V4L2_FIELD_IS_SEQUENTIAL(asked) && V4L2_FIELD_IS_SEQUENTIAL(got));
}

class Setup {
 public:
  Setup(Kernel& kernel, int descriptor, const V4l2Settings& settings, StandardQuestion& question,
        AgreedFormat& agreed, std::string& message)
      : kernel_(kernel),
        descriptor_(descriptor),
        settings_(settings),
        question_(question),
        agreed_(agreed),
        message_(message) {}

  Result<void> choose_input();
  void listen();
  Result<void> choose_standard();
  Result<void> compare_signal();
  Result<void> choose_format();
  Result<void> choose_rate();

 private:
  int ask(unsigned long request, void* argument) {
    return kernel_.ioctl(descriptor_, request, argument);
  }
  Result<void> fail(Error error, std::string message) {
    message_ = std::move(message);
    return Unexpected(error);
  }
  std::vector<std::uint32_t> offered_formats();
  Result<bool> try_format(const PixelFormat& pixel, const Layout& layout);
  bool take_over(const PixelFormat& pixel, const Layout& layout, const v4l2_format& format);
  double told_frames_per_s();

  Kernel& kernel_;
  int descriptor_;
  const V4l2Settings& settings_;
  StandardQuestion& question_;
  AgreedFormat& agreed_;
  std::string& message_;
  double standard_frames_per_s_ = 0.0;
  std::string offers_;  ///< what came instead of what was wanted
};

Result<void> Setup::choose_input() {
  std::string offered;
  int chosen = -1;
  for (std::uint32_t i = 0; chosen < 0 && !settings_.input.empty(); ++i) {
    v4l2_input input{};
    input.index = i;
    if (i == kMostEntries || ask(VIDIOC_ENUMINPUT, &input) != 0) {
      return fail(Error::kUnsupported, "has no input '" + settings_.input + "', offers " +
                                           (offered.empty() ? "none by a name" : offered));
    }
    const std::string name = text_of(input.name, sizeof input.name);
    offered += (offered.empty() ? "'" : ", '") + name + "'";
    if (name == settings_.input) {
      int index = static_cast<int>(i);
      if (const int status = ask(VIDIOC_S_INPUT, &index); status != 0) {
        return fail(Error::kIo, "input '" + name + "': " + std::strerror(-status));
      }
      chosen = static_cast<int>(i);
    }
  }
  int index = 0;
  agreed_.input_status = ask(VIDIOC_G_INPUT, &index) == 0;
  agreed_.input = static_cast<std::uint32_t>(index);
  // Behind another input there is another camera.
  if (chosen >= 0 && agreed_.input_status && index != chosen) {
    return fail(Error::kIo, "does not keep its input '" + settings_.input + "'");
  }
  return {};
}

Result<void> Setup::choose_standard() {
  // Set where it is another alone: some chips look for their signal anew each time.
  v4l2_std_id now = 0;
  const bool told = ask(VIDIOC_G_STD, &now) == 0 && now != 0;
  v4l2_std_id wanted = settings_.standard == "PAL" ? V4L2_STD_PAL : V4L2_STD_NTSC;
  if (!settings_.standard.empty() && (now & wanted) == 0) {
    if (const int status = ask(VIDIOC_S_STD, &wanted); status != 0) {
      return fail(Error::kUnsupported, "standard " + settings_.standard + ": " +
                                           std::strerror(-status) + ", expected one that it has");
    }
    if (ask(VIDIOC_G_STD, &now) != 0 || now == 0) {
      return fail(Error::kUnsupported, "does not keep its standard");
    }
    if ((now & wanted) == 0) {
      return fail(Error::kUnsupported, "keeps another standard than " + settings_.standard);
    }
  } else if (!told) {
    return {};
  }
  standard_frames_per_s_ = (now & V4L2_STD_525_60) != 0 ? 30'000.0 / 1001.0 : 25.0;
  agreed_.standard = standard_of(now);
  return {};
}

/// A change of the source before this is seen by what is asked after it.
void Setup::listen() {
  // A driver that knows nothing of it never says that the source has changed.
  // Drivers name the input, as they should, or 0 whatever the input.
  for (const std::uint32_t id : {0U, agreed_.input}) {
    v4l2_event_subscription change{};
    change.type = V4L2_EVENT_SOURCE_CHANGE;
    change.id = id;
    static_cast<void>(ask(VIDIOC_SUBSCRIBE_EVENT, &change));
  }
}

Result<void> Setup::compare_signal() {
  // What was told so far may be of our own choice of a standard.
  for (std::uint32_t i = 0; i < kMostEntries; ++i) {
    v4l2_event event{};
    if (ask(VIDIOC_DQEVENT, &event) != 0) {
      break;
    }
  }
  const VideoStandard signal = question_.ask(descriptor_);
  if (agreed_.standard == VideoStandard::kNone || signal == VideoStandard::kNone ||
      signal == agreed_.standard) {
    return {};
  }
  return fail(Error::kUnsupported, std::string("gets a signal of ") + name_of(signal) +
                                       ", expected " + name_of(agreed_.standard) +
                                       (settings_.standard.empty() ? ", to which it is set" : ""));
}

std::vector<std::uint32_t> Setup::offered_formats() {
  std::vector<std::uint32_t> codes;
  for (std::uint32_t i = 0; i < kMostEntries; ++i) {
    v4l2_fmtdesc format{};
    format.index = i;
    format.type = buffer_type_of(agreed_.api);
    if (ask(VIDIOC_ENUM_FMT, &format) != 0) {
      break;
    }
    codes.push_back(format.pixelformat);
  }
  return codes;
}

/// A driver may have answered with anything; what does not hold the picture as wanted is refused.
bool Setup::take_over(const PixelFormat& pixel, const Layout& layout, const v4l2_format& format) {
  const v4l2_pix_format got = picture_of(agreed_.api, format);
  const bool one_field = layout.kind == BufferKind::kOneField;
  const std::int32_t lines = one_field ? settings_.height_px / 2 : settings_.height_px;
  offers_ = std::string(code_text(got.pixelformat).data()) + " " + std::to_string(got.width) +
            " x " + std::to_string(got.height) + " " + words_of_field(got.field);
  if (const std::uint32_t planes = planes_of(agreed_.api, format); planes != 1) {
    offers_ += " in " + std::to_string(planes) + " planes";
    return false;
  }
  if (got.pixelformat != pixel.code || std::cmp_not_equal(got.width, settings_.width_px) ||
      std::cmp_not_equal(got.height, lines) || !same_layout(layout.field, got.field)) {
    return false;
  }
  const std::int32_t least = settings_.width_px * pixel.bytes_a_pixel;
  const std::uint32_t stride =
      got.bytesperline == 0 ? static_cast<std::uint32_t>(least) : got.bytesperline;
  constexpr std::uint32_t kLongestLine = 1 << 20;
  if (std::cmp_less(stride, least) || stride > kLongestLine) {
    offers_ += " with lines of " + std::to_string(stride) + " bytes";
    return false;
  }
  agreed_.pixel = pixel;
  agreed_.kind = layout.kind;
  agreed_.sequential = V4L2_FIELD_IS_SEQUENTIAL(got.field);
  agreed_.odd_above = got.field == V4L2_FIELD_SEQ_BT;
  agreed_.lines = lines;
  agreed_.stride_bytes = static_cast<std::int32_t>(stride);
  agreed_.bytes = static_cast<std::size_t>(lines - 1) * stride + static_cast<std::size_t>(least);
  return true;
}

/// False: not this one.
Result<bool> Setup::try_format(const PixelFormat& pixel, const Layout& layout) {
  v4l2_pix_format picture{};
  picture.width = static_cast<std::uint32_t>(settings_.width_px);
  const std::int32_t height =
      layout.kind == BufferKind::kOneField ? settings_.height_px / 2 : settings_.height_px;
  picture.height = static_cast<std::uint32_t>(height);
  picture.pixelformat = pixel.code;
  picture.field = layout.field;
  v4l2_format format = format_of(agreed_.api, picture);
  const int status = ask(VIDIOC_S_FMT, &format);
  if (status == -EBUSY) {
    return Unexpected(
        fail(Error::kIo, "is busy: another program takes its pictures, expected it free").error());
  }
  if (status != 0) {
    return status == -EINVAL
               ? Result<bool>(false)
               : Result<bool>(Unexpected(
                     fail(Error::kIo, std::string("format: ") + std::strerror(-status)).error()));
  }
  if (!take_over(pixel, layout, format)) {
    return false;
  }
  // What a driver says when it is asked again is what it will do.
  v4l2_format kept{};
  kept.type = buffer_type_of(agreed_.api);
  return ask(VIDIOC_G_FMT, &kept) == 0 && take_over(pixel, layout, kept);
}

Result<void> Setup::choose_format() {
  // A rectangle that was left from another order of fields would mix lines. Many have none.
  for (const auto& [bounds, target] :
       {std::pair{V4L2_SEL_TGT_CROP_DEFAULT, V4L2_SEL_TGT_CROP},
        std::pair{V4L2_SEL_TGT_COMPOSE_DEFAULT, V4L2_SEL_TGT_COMPOSE}}) {
    v4l2_selection whole{};
    whole.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;  // of both sets of calls
    whole.target = static_cast<std::uint32_t>(bounds);
    if (ask(VIDIOC_G_SELECTION, &whole) == 0) {
      whole.target = static_cast<std::uint32_t>(target);
      static_cast<void>(ask(VIDIOC_S_SELECTION, &whole));
    }
  }
  const bool progressive = settings_.scan == core::Scan::kProgressive;
  const auto layouts = progressive ? std::span<const Layout>(kProgressiveLayouts)
                                   : std::span<const Layout>(kInterlacedLayouts);
  const std::vector<std::uint32_t> offered = offered_formats();
  for (const PixelFormat& pixel : pixel_formats()) {
    if ((!settings_.format.empty() && settings_.format != pixel.name) ||
        std::find(offered.begin(), offered.end(), pixel.code) == offered.end()) {
      continue;
    }
    for (const Layout& layout : layouts) {
      const bool halves = !progressive && layout.field != V4L2_FIELD_INTERLACED;
      if ((settings_.fields != FieldLayout::kAny && !progressive &&
           settings_.fields != layout.wanted) ||
          (halves && settings_.height_px % 2 != 0)) {
        continue;
      }
      const auto taken = try_format(pixel, layout);
      if (!taken) {
        return Unexpected(taken.error());
      }
      if (*taken) {
        return {};
      }
    }
  }
  std::string formats;
  for (const std::uint32_t code : offered) {
    formats += (formats.empty() ? "" : ", ") + std::string(code_text(code).data());
  }
  return fail(
      Error::kUnsupported,
      "offers " + (offers_.empty() ? "formats " + (formats.empty() ? "none" : formats) : offers_) +
          ", expected " +
          (settings_.format.empty() ? "GREY, NV12, YUYV, UYVY, Y10 or Y16" : settings_.format) +
          " " + std::to_string(settings_.width_px) + " x " + std::to_string(settings_.height_px) +
          (progressive ? " progressive" : " with two fields a frame"));
}

/// As the driver says, or the standard; 0: nobody does.
double Setup::told_frames_per_s() {
  v4l2_streamparm told{};
  told.type = buffer_type_of(agreed_.api);
  if (ask(VIDIOC_G_PARM, &told) == 0) {
    const v4l2_fract& frame = told.parm.capture.timeperframe;
    if (frame.numerator > 0 && frame.denominator > 0) {
      return static_cast<double>(frame.denominator) / static_cast<double>(frame.numerator);
    }
  }
  return standard_frames_per_s_;
}

Result<void> Setup::choose_rate() {
  const double fields = settings_.scan == core::Scan::kProgressive ? 1.0 : 2.0;
  const double wanted = settings_.fields_per_s / fields;
  if (wanted > 0.0) {
    constexpr double kParts = 1000.0;
    v4l2_streamparm asked{};
    asked.type = buffer_type_of(agreed_.api);
    asked.parm.capture.timeperframe.numerator = static_cast<std::uint32_t>(kParts);
    asked.parm.capture.timeperframe.denominator =
        static_cast<std::uint32_t>(std::lround(wanted * kParts));
    static_cast<void>(ask(VIDIOC_S_PARM, &asked));
  }
  const double told = told_frames_per_s();
  if (told <= 0.0 && wanted <= 0.0) {
    return fail(Error::kUnsupported, "does not say its rate, expected fields_per_s to say it");
  }
  if (told > 0.0 && wanted > 0.0 && std::abs(told - wanted) > kRateTolerance * wanted) {
    return fail(Error::kUnsupported, "gives " + std::to_string(told * fields) +
                                         " fields a second, expected " +
                                         std::to_string(settings_.fields_per_s));
  }
  const double fields_per_s = fields * (told > 0.0 ? told : wanted);
  constexpr double kSlowest = 1.0;
  constexpr double kFastest = 1000.0;
  if (fields_per_s < kSlowest || fields_per_s > kFastest) {
    return fail(Error::kUnsupported,
                "gives " + std::to_string(fields_per_s) + " fields a second, expected 1 to 1000");
  }
  agreed_.span = core::FieldTime{std::llround(1e9 / fields_per_s)};
  return {};
}

}  // namespace

FieldLines AgreedFormat::lines_of(bool odd, bool above_is_odd) const {
  if (kind != BufferKind::kPair) {
    return {0, 1, lines};
  }
  if (sequential) {
    return {odd == above_is_odd ? 0 : lines / 2, 1, lines / 2};
  }
  const std::int32_t first = odd ? 1 : 0;
  return {first, 2, (lines - first + 1) / 2};
}

Result<void> set_up(Kernel& kernel, int descriptor, const V4l2Settings& settings,
                    StandardQuestion& question, AgreedFormat& agreed, std::string& message) {
  Setup setup(kernel, descriptor, settings, question, agreed, message);
  TUBESIGHT_TRY(setup.choose_input());
  setup.listen();
  TUBESIGHT_TRY(setup.choose_standard());
  TUBESIGHT_TRY(setup.compare_signal());
  TUBESIGHT_TRY(setup.choose_format());
  TUBESIGHT_TRY(setup.choose_rate());
  return set_controls(kernel, descriptor, settings.controls, message);
}

bool says_no_signal(std::uint32_t status) {
  return (status & (V4L2_IN_ST_NO_POWER | V4L2_IN_ST_NO_SIGNAL | V4L2_IN_ST_NO_H_LOCK |
                    V4L2_IN_ST_NO_V_LOCK | V4L2_IN_ST_NO_SYNC | V4L2_IN_ST_NO_CARRIER)) != 0;
}

bool says_no_standard(std::uint32_t status) { return (status & V4L2_IN_ST_NO_STD_LOCK) != 0; }

}  // namespace tubesight::drivers::v4l2
