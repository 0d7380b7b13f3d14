#include "core/rendering/sensor_noise.h"

#include <algorithm>
#include <cmath>

#include "core/rendering/random.h"

namespace tubesight::core::rendering {
namespace {

enum Use : std::uint32_t { kLine = 11, kInterference = 12, kDots = 13 };

constexpr double kTwoPi = 6.28318530717958647692;

struct Development {
  float gain = 1.0F;
  float offset = 0.0F;
  float shot2 = 0.0F;  // variance per grey level
  float read2 = 0.0F;
  float extra = 0.0F;  // sigma
  float scale = 1.0F;  // of a fault
  float shift = 0.0F;
  float saturation = 255.0F;
};

void develop_line(const float* __restrict signal, const float* __restrict glow,
                  const float* __restrict first_noise, const float* __restrict second_noise,
                  const Development& how, std::int32_t count, std::uint8_t* __restrict bytes) {
  const Development d = how;
  for (std::int32_t i = 0; i < count; ++i) {
    const float light = (signal[i] + glow[i]) * d.gain;
    const float level = light > 0.0F ? light : 0.0F;
    const float sigma = std::sqrt(d.shot2 * level + d.read2);
    // Two numbers of the table: their sum has the variance of two.
    const float noise = (first_noise[i] + second_noise[i]) * 0.70710678F;
    const float seen = (level + d.offset + sigma * noise) * d.scale + d.shift + d.extra * noise;
    const float low = seen < 0.0F ? 0.0F : seen;
    const float rounded = (low > d.saturation ? d.saturation : low) + 0.5F;  // never negative
    bytes[i] = static_cast<std::uint8_t>(static_cast<std::int32_t>(rounded));
  }
}

}  // namespace

void SensorNoise::make() {
  // Box and Muller's pairs, from counters.
  double sum = 0.0;
  double sum2 = 0.0;
  for (std::size_t i = 0; i < kTable; i += 2) {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - share_of(mixed(2 * i + 77))));
    const double angle = kTwoPi * share_of(mixed(2 * i + 78));
    normal_[i] = static_cast<float>(radius * std::cos(angle));
    normal_[i + 1] = static_cast<float>(radius * std::sin(angle));
  }
  for (std::size_t i = 0; i < kTable; ++i) {
    sum += static_cast<double>(normal_[i]);
    sum2 += static_cast<double>(normal_[i]) * static_cast<double>(normal_[i]);
  }
  const double mean = sum / kTable;
  const double sigma = std::sqrt(sum2 / kTable - mean * mean);
  for (std::size_t i = 0; i < kTable; ++i) {
    normal_[i] = static_cast<float>((static_cast<double>(normal_[i]) - mean) / sigma);
  }
  for (std::size_t i = kTable; i < normal_.size(); ++i) {
    normal_[i] = normal_[i - kTable];
  }
}

void SensorNoise::develop(const Row& row, const SensorLook& look, const Exposure& exposure,
                          std::int32_t v, std::int32_t first, std::int32_t last,
                          std::uint8_t* bytes) const {
  // One draw serves a line, whatever part of it is wanted: a window shows what the whole would.
  const std::uint64_t bits = mixed(exposure.noise_seed, v, 0, kLine);
  const std::size_t one = (bits & (kTable - 1)) + static_cast<std::size_t>(first);
  const std::size_t other = ((bits >> 32) & (kTable - 1)) + static_cast<std::size_t>(first);
  Development how;
  how.gain = static_cast<float>(look.gain);
  how.offset = static_cast<float>(look.offset);
  how.shot2 = static_cast<float>(look.shot_noise * look.shot_noise);
  how.read2 = static_cast<float>(look.read_noise * look.read_noise);
  how.extra = static_cast<float>(exposure.extra_noise);
  how.scale = static_cast<float>(exposure.gain);
  how.shift = static_cast<float>(exposure.offset);
  how.saturation = static_cast<float>(std::clamp(look.saturation, 0.0, 255.0));
  develop_line(row.signal.data() + first, row.glow.data() + first, &normal_[one], &normal_[other],
               how, last - first + 1, bytes + first);
  if (look.emi_share > 0.0 || look.salt_and_pepper > 0.0) {
    interfere(look, mixed(exposure.noise_seed, v, 0, kInterference), first, last, bytes);
  }
}

void SensorNoise::interfere(const SensorLook& look, std::uint64_t bits, std::int32_t first,
                            std::int32_t last, std::uint8_t* bytes) const {
  if (share_of(bits) < look.emi_share) {
    const double phase = kTwoPi * share_of(mixed(bits + 1));
    const double per_px = kTwoPi / (6.0 + 60.0 * share_of(mixed(bits + 2)));
    for (std::int32_t u = first; u <= last; ++u) {
      const double level = bytes[u] + look.emi_amplitude * std::sin(phase + per_px * u);
      bytes[u] = static_cast<std::uint8_t>(std::clamp(level + 0.5, 0.0, look.saturation));
    }
  }
  if (look.salt_and_pepper > 0.0) {
    // Distances between dots are exponential; they start at column 0 whatever the window.
    const double mean = 1.0 / std::min(look.salt_and_pepper, 1.0);
    double at = 0.0;
    for (std::uint64_t dot = 0; at <= last; ++dot) {
      const std::uint64_t draw = mixed(bits ^ (kDots + (dot << 8)));
      at += std::max(-mean * std::log(1.0 - share_of(draw)), 1.0);
      const auto u = static_cast<std::int32_t>(std::min(at, 1e6)) - 1;
      if (u >= first && u <= last) {
        bytes[u] = (draw & 1U) != 0 ? 255 : 0;
      }
    }
  }
}

}  // namespace tubesight::core::rendering
