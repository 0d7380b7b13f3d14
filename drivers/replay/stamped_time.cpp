#include "drivers/replay/stamped_time.h"

#include <cmath>

#include "drivers/replay/field_time.h"

namespace tubesight::drivers {
namespace {

using core::FieldTime;

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr double kLargestTime_s = 4e9;
constexpr double kMostFrames = 4294967296.0;  // nominal_field_time() takes twice as many fields

/// The time between two stamps; none when it is beyond all recordings, or they have two units.
std::optional<FieldTime> between(const FrameStamp& from, const FrameStamp& to) {
  const double ticks = static_cast<double>(to.ticks) - static_cast<double>(from.ticks);
  const double product = ticks * static_cast<double>(to.numerator);
  constexpr double kLargestProduct = 9e18;
  if (from.numerator != to.numerator || from.denominator != to.denominator ||
      std::abs(product) > kLargestProduct ||
      std::abs(product) > kLargestTime_s * static_cast<double>(to.denominator)) {
    return std::nullopt;
  }
  const std::int64_t whole = (to.ticks - from.ticks) * to.numerator;
  const std::int64_t seconds = whole / to.denominator;
  // The rest is below 10^9, and its product below 10^18.
  const std::int64_t rest = whole % to.denominator * kSecond_ns;
  const std::int64_t half = rest < 0 ? -to.denominator / 2 : to.denominator / 2;
  return FieldTime(seconds * kSecond_ns + (rest + half) / to.denominator);
}

}  // namespace

void StampedTime::begin(std::int64_t rate_numerator, std::int64_t rate_denominator) {
  rate_numerator_ = rate_numerator;
  rate_denominator_ = rate_denominator;
  begun_ = false;
  first_.reset();
  time_ = FieldTime(0);
  multiple_.reset();
}

FieldTime StampedTime::period() const {
  return nominal_field_time(2, rate_numerator_, rate_denominator_);
}

void StampedTime::place(const std::optional<FrameStamp>& stamp) {
  if (!begun_) {
    begun_ = true;
    first_ = stamp;
    multiple_ = 0;
    return;
  }
  const auto passed = stamp && first_ ? between(*first_, *stamp) : std::nullopt;
  if (!passed) {
    time_ += period();
    multiple_.reset();
    return;
  }
  time_ = *passed;
  multiple_.reset();
  const double rate = static_cast<double>(rate_numerator_) / static_cast<double>(rate_denominator_);
  const double frames =
      std::round(static_cast<double>(passed->count()) * rate / static_cast<double>(kSecond_ns));
  if (frames < 0.0 || frames >= kMostFrames) {
    return;
  }
  const auto multiple = static_cast<std::int64_t>(frames);
  const FieldTime even = nominal_field_time(2 * multiple, rate_numerator_, rate_denominator_);
  const std::int64_t unit_ns = stamp->numerator * kSecond_ns / stamp->denominator + 1;
  if (std::abs((even - *passed).count()) <= unit_ns) {
    time_ = even;
    multiple_ = multiple;
  }
}

FieldTime StampedTime::time(bool later_field) const {
  if (!later_field) {
    return time_;
  }
  return multiple_ ? nominal_field_time(2 * *multiple_ + 1, rate_numerator_, rate_denominator_)
                   : time_ + nominal_field_time(1, rate_numerator_, rate_denominator_);
}

}  // namespace tubesight::drivers
