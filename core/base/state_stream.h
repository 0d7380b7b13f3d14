#pragma once

#include <array>
#include <bit>
#include <chrono>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <span>
#include <type_traits>

#include "core/base/fixed.h"
#include "core/base/static_vector.h"
#include "core/base/tube_address.h"
#include "core/base/vector3.h"

namespace tubesight::core {

/// One walk over an object's state, in bytes: writes it, reads it back, or takes its digest.
///
/// A class hands over its members by one function that serves all three, and names every one of
/// them in a structured binding, so that a member which is added does not compile until somebody
/// has said whether it belongs to the state:
///
///     template <typename Self, typename Stream>
///     static void transfer(Self& self, Stream& stream) {
///       auto& [model, place, count] = self;  // a model is the settings', not the state's
///       stream(place);
///       stream.number(count, 0, kMost);
///     }
///
/// A plain struct has a free transfer(Self&, Stream&) beside it or where the walk starts. Numbers
/// are little endian whatever the machine, in their own size. What is read is believed by nobody:
/// a value outside the bounds given ends the reading. Derived has
/// `template <int kBytes> void exchange(std::uint64_t& bits)`, kReads and kShape.
template <typename Derived>
class StateStream {
 public:
  template <typename... T>
  void operator()(T&... values) {
    (one(values), ...);
  }

  /// A whole number within bounds.
  template <typename T>
  void number(T& value, std::remove_const_t<T> least, std::remove_const_t<T> most) {
    using Bare = std::remove_const_t<T>;
    static_assert(std::integral<Bare> && !std::same_as<Bare, bool>);
    using Bits = std::make_unsigned_t<Bare>;
    auto bits = static_cast<std::uint64_t>(static_cast<Bits>(value));
    exchange<static_cast<int>(sizeof(Bare))>(bits);
    if constexpr (Derived::kReads) {
      const auto read = static_cast<Bare>(static_cast<Bits>(bits));
      if (read < least || read > most) {
        derived().refuse();
        return;
      }
      value = read;
    }
  }

  /// An enumeration that counts from 0 to `last`.
  template <typename E>
  void choice(E& value, std::remove_const_t<E> last) {
    using Number = std::underlying_type_t<std::remove_const_t<E>>;
    static_assert(std::unsigned_integral<Number>);
    auto which = static_cast<Number>(value);
    number(which, Number{0}, static_cast<Number>(last));
    if constexpr (Derived::kReads) {
      value = static_cast<std::remove_const_t<E>>(which);
    }
  }

 private:
  static constexpr std::int64_t kFarthest_ns = 4'000'000'000'000'000'000;  // differences fit

  [[nodiscard]] Derived& derived() { return static_cast<Derived&>(*this); }
  template <int kBytes>
  void exchange(std::uint64_t& bits) {
    derived().template exchange<kBytes>(bits);
  }

  /// A digest of shapes sees an element in place of those that a list happens to hold.
  template <typename T>
  bool shows_shape() {
    if constexpr (Derived::kShape) {
      const T sample{};
      one(sample);
    }
    return Derived::kShape;
  }

  void one(bool& value) {
    std::uint8_t bit = value ? 1 : 0;
    number(bit, std::uint8_t{0}, std::uint8_t{1});
    value = bit != 0;
  }
  void one(const bool& value) {
    std::uint8_t bit = value ? 1 : 0;
    number(bit, std::uint8_t{0}, std::uint8_t{1});
  }

  template <typename T>
  void one(T& value) {
    using Bare = std::remove_const_t<T>;
    if constexpr (requires { Bare::transfer(value, derived()); }) {
      Bare::transfer(value, derived());
    } else if constexpr (std::integral<Bare>) {
      number(value, std::numeric_limits<Bare>::min(), std::numeric_limits<Bare>::max());
    } else if constexpr (std::floating_point<Bare>) {
      floating(value);
    } else {
      transfer(value, derived());
    }
  }

  template <typename T>
  void floating(T& value) {
    using Bare = std::remove_const_t<T>;
    using Bits = std::conditional_t<sizeof(Bare) == 4, std::uint32_t, std::uint64_t>;
    auto bits = std::bit_cast<Bits>(value);
    (*this)(bits);
    if constexpr (Derived::kReads) {
      value = std::bit_cast<Bare>(bits);
    }
  }

  template <typename T>
  void raw(T& value) {
    auto bits = value.raw();
    (*this)(bits);
    if constexpr (Derived::kReads) {
      value = std::remove_const_t<T>::from_raw(bits);
    }
  }
  template <int I, int F, typename O>
  void one(Fixed<I, F, O>& value) {
    raw(value);
  }
  template <int I, int F, typename O>
  void one(const Fixed<I, F, O>& value) {
    raw(value);
  }

  template <typename T>
  void duration(T& value) {
    std::int64_t count = value.count();
    number(count, -kFarthest_ns, kFarthest_ns);
    if constexpr (Derived::kReads) {
      value = std::remove_const_t<T>(count);
    }
  }
  void one(std::chrono::nanoseconds& value) { duration(value); }
  void one(const std::chrono::nanoseconds& value) { duration(value); }

  template <typename T, std::size_t N>
  void one(std::array<T, N>& values) {
    for (T& value : values) {
      one(value);
    }
  }
  template <typename T, std::size_t N>
  void one(const std::array<T, N>& values) {
    for (const T& value : values) {
      one(value);
    }
  }

  template <typename T, std::int32_t N>
  void one(const StaticVector<T, N>& list) {
    std::int32_t size = list.size();
    number(size, 0, N);
    if (shows_shape<T>()) {
      return;
    }
    for (const T& value : list) {
      one(value);
    }
  }
  template <typename T, std::int32_t N>
  void one(StaticVector<T, N>& list) {
    static_assert(!Derived::kShape, "shapes are of constant objects");
    std::int32_t size = list.size();
    number(size, 0, N);
    if constexpr (Derived::kReads) {
      list.clear();
      for (std::int32_t i = 0; i < size && derived().good(); ++i) {
        static_cast<void>(list.try_push_back(T{}));
      }
    }
    for (T& value : list) {
      one(value);
    }
  }

  template <typename T>
  void one(const std::optional<T>& value) {
    bool there = value.has_value();
    one(there);
    if (!shows_shape<T>() && there) {
      one(*value);
    }
  }
  template <typename T>
  void one(std::optional<T>& value) {
    static_assert(!Derived::kShape, "shapes are of constant objects");
    bool there = value.has_value();
    one(there);
    if constexpr (Derived::kReads) {
      value.reset();
      if (there) {
        value.emplace();
      }
    }
    if (value) {
      one(*value);
    }
  }
};

/// Writes into a caller's buffer. One that is too small is told by good().
class StateWriter final : public StateStream<StateWriter> {
 public:
  static constexpr bool kReads = false;
  static constexpr bool kShape = false;

  explicit StateWriter(std::span<std::byte> into) : into_(into) {}

  template <int kBytes>
  void exchange(std::uint64_t& bits) {
    if (into_.size() - used_ < static_cast<std::size_t>(kBytes)) {
      good_ = false;
      return;
    }
    if constexpr (std::endian::native == std::endian::little) {
      std::memcpy(into_.data() + used_, &bits, kBytes);
    } else {
      for (int i = 0; i < kBytes; ++i) {
        into_[used_ + static_cast<std::size_t>(i)] = static_cast<std::byte>(bits >> (8 * i));
      }
    }
    used_ += static_cast<std::size_t>(kBytes);
  }
  void refuse() { good_ = false; }

  [[nodiscard]] bool good() const { return good_; }
  [[nodiscard]] std::size_t size() const { return used_; }

 private:
  std::span<std::byte> into_;
  std::size_t used_ = 0;
  bool good_ = true;
};

/// Reads what a StateWriter wrote, or whatever else the bytes are. After the first value that is
/// not to be believed, or the end of the bytes, good() is false and nothing further is read.
class StateReader final : public StateStream<StateReader> {
 public:
  static constexpr bool kReads = true;
  static constexpr bool kShape = false;

  explicit StateReader(std::span<const std::byte> from) : rest_(from) {}

  template <int kBytes>
  void exchange(std::uint64_t& bits) {
    if (!good_ || rest_.size() < static_cast<std::size_t>(kBytes)) {
      good_ = false;
      return;
    }
    bits = 0;
    for (int i = 0; i < kBytes; ++i) {
      bits |= std::to_integer<std::uint64_t>(rest_[static_cast<std::size_t>(i)]) << (8 * i);
    }
    rest_ = rest_.subspan(static_cast<std::size_t>(kBytes));
  }
  void refuse() { good_ = false; }

  [[nodiscard]] bool good() const { return good_; }
  /// Bytes not read yet.
  [[nodiscard]] std::size_t left() const { return rest_.size(); }

 private:
  std::span<const std::byte> rest_;
  bool good_ = true;
};

/// A digest of values and of their order: FNV-1a over 64-bit words. Damage of any one word changes
/// it; it is no protection against a forger.
class StateDigest final : public StateStream<StateDigest> {
 public:
  static constexpr bool kReads = false;
  static constexpr bool kShape = false;

  template <int kBytes>
  void exchange(std::uint64_t& bits) {
    value_ = (value_ ^ bits) * 1099511628211ULL;
    value_ ^= value_ >> 32;
  }
  void refuse() {}
  [[nodiscard]] static bool good() { return true; }

  /// Takes bytes, eight at a time.
  void add(std::span<const std::byte> bytes) {
    while (std::endian::native == std::endian::little && bytes.size() >= 8) {
      std::uint64_t word = 0;
      std::memcpy(&word, bytes.data(), sizeof(word));
      exchange<8>(word);
      bytes = bytes.subspan(8);
    }
    while (!bytes.empty()) {
      std::uint64_t word = 0;
      const std::size_t count = bytes.size() < 8 ? bytes.size() : 8;
      for (std::size_t i = 0; i < count; ++i) {
        word |= std::to_integer<std::uint64_t>(bytes[i]) << (8 * i);
      }
      exchange<8>(word);
      bytes = bytes.subspan(count);
    }
  }

  [[nodiscard]] std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 14695981039346656037ULL;
};

/// What an object's state is made of: the number and sizes of its values, whatever they are. Equal
/// shapes of two builds mean that they wrote the same members.
class StateShape final : public StateStream<StateShape> {
 public:
  static constexpr bool kReads = false;
  static constexpr bool kShape = true;

  template <int kBytes>
  void exchange(std::uint64_t& /*bits*/) {
    std::uint64_t size = kBytes;
    digest_.exchange<8>(size);
  }
  void refuse() {}
  [[nodiscard]] static bool good() { return true; }
  [[nodiscard]] std::uint64_t value() const { return digest_.value(); }

 private:
  StateDigest digest_;
};

template <typename Self, typename Stream>
requires std::same_as<std::remove_const_t<Self>, TubeAddress>
void transfer(Self& self, Stream& stream) {
  auto& [row, column] = self;
  stream(row, column);
}

template <typename T>
inline constexpr bool kIsVector2 = false;
template <typename T>
inline constexpr bool kIsVector2<Vector2<T>> = true;
template <typename T>
inline constexpr bool kIsVector3 = false;
template <typename T>
inline constexpr bool kIsVector3<Vector3<T>> = true;

template <typename Self, typename Stream>
requires kIsVector2<std::remove_const_t<Self>>
void transfer(Self& self, Stream& stream) {
  auto& [x, y] = self;
  stream(x, y);
}

template <typename Self, typename Stream>
requires kIsVector3<std::remove_const_t<Self>>
void transfer(Self& self, Stream& stream) {
  auto& [x, y, z] = self;
  stream(x, y, z);
}

}  // namespace tubesight::core
