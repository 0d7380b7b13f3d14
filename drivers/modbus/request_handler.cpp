#include "drivers/modbus/request_handler.h"

#include <array>
#include <cstddef>

#include "core/base/assert.h"

namespace tubesight::drivers {
namespace {

using core::FieldTime;

constexpr std::uint8_t kReadHolding = 3;
constexpr std::uint8_t kReadInput = 4;
constexpr std::uint8_t kWriteAndRead = 23;
constexpr std::uint8_t kException = 0x80;

// Of the Modbus application protocol, V1.1b3.
constexpr std::int32_t kMostRead = 125;
constexpr std::int32_t kMostWritten = 123;
constexpr std::int32_t kMostWrittenAndRead = 121;

std::int32_t word_at(std::span<const std::uint8_t> bytes, std::size_t at) {
  return bytes[at] << 8 | bytes[at + 1];
}

void push(Pdu& pdu, std::int32_t byte) {
  const bool fits = pdu.try_push_back(static_cast<std::uint8_t>(byte));
  TUBESIGHT_ASSERT(fits);
}

void push_word(Pdu& pdu, std::int32_t word) {
  push(pdu, word >> 8 & 0xFF);
  push(pdu, word & 0xFF);
}

/// The words that a request brings, high byte first.
class Words {
 public:
  explicit Words(std::span<const std::uint8_t> bytes) : count_(bytes.size() / 2) {
    for (std::size_t i = 0; i < count_; ++i) {
      words_[i] = static_cast<std::uint16_t>(word_at(bytes, 2 * i));
    }
  }
  [[nodiscard]] std::span<const std::uint16_t> view() const { return {words_.data(), count_}; }

 private:
  std::array<std::uint16_t, kMostRead> words_{};
  std::size_t count_;
};

}  // namespace

RequestHandler::Outcome RequestHandler::take(std::span<const std::uint8_t> request,
                                             FieldTime arrival, Pdu& answer) {
  TUBESIGHT_ASSERT(!request.empty());
  answer.clear();
  const std::uint8_t function = request.front();
  bool waits = false;
  Refusal refusal = Refusal::kIllegalFunction;
  switch (function) {
    case kReadHolding:
    case kReadInput: refusal = read(request, arrival, answer); break;
    case kWriteOneFunction: refusal = write_one(request, arrival, answer); break;
    case kWriteManyFunction: refusal = write_many(request, arrival, answer); break;
    case kWriteAndRead: refusal = write_and_read(request, arrival, answer, waits); break;
    default: break;
  }
  if (refusal != Refusal::kNone) {
    answer.clear();
    push(answer, function | kException);
    push(answer, static_cast<std::int32_t>(refusal));
    return Outcome::kRefused;
  }
  return waits ? Outcome::kWaits : Outcome::kAnswered;
}

void RequestHandler::finish(FieldTime now, Pdu& answer) {
  answer.clear();
  answer_range(kWriteAndRead, awaited_, now, answer);
}

void RequestHandler::answer_range(std::uint8_t function, const Range& range, FieldTime now,
                                  Pdu& answer) {
  std::array<std::uint16_t, kMostRead> words{};
  const auto count = static_cast<std::size_t>(range.count);
  dialogue_->read(range.first, now, std::span(words).first(count));
  push(answer, function);
  push(answer, 2 * range.count);
  for (std::size_t i = 0; i < count; ++i) {
    push_word(answer, words[i]);
  }
}

// function, address (2), count (2)
Refusal RequestHandler::read(std::span<const std::uint8_t> request, FieldTime now, Pdu& answer) {
  if (request.size() != 5) {
    return Refusal::kIllegalValue;
  }
  const Range range{word_at(request, 1), word_at(request, 3)};
  if (range.count < 1 || range.count > kMostRead) {
    return Refusal::kIllegalValue;
  }
  if (const Refusal refusal = Dialogue::check_readable(range.first, range.count);
      refusal != Refusal::kNone) {
    return refusal;
  }
  answer_range(request.front(), range, now, answer);
  return Refusal::kNone;
}

// function, address (2), word (2): sent back as it came
Refusal RequestHandler::write_one(std::span<const std::uint8_t> request, FieldTime arrival,
                                  Pdu& answer) {
  if (request.size() != 5) {
    return Refusal::kIllegalValue;
  }
  const Words words(request.subspan(3));
  const Refusal refusal = dialogue_->write(word_at(request, 1), words.view(), arrival);
  for (const std::uint8_t byte : request) {
    push(answer, byte);
  }
  return refusal;
}

// function, address (2), count (2), bytes, words: the first five bytes are sent back
Refusal RequestHandler::write_many(std::span<const std::uint8_t> request, FieldTime arrival,
                                   Pdu& answer) {
  constexpr std::size_t kHead = 6;
  if (request.size() < kHead) {
    return Refusal::kIllegalValue;
  }
  const std::int32_t count = word_at(request, 3);
  const auto bytes = static_cast<std::size_t>(2 * count);
  if (count < 1 || count > kMostWritten || request[5] != bytes || request.size() != kHead + bytes) {
    return Refusal::kIllegalValue;
  }
  const Words words(request.subspan(kHead));
  for (std::size_t i = 0; i + 1 < kHead; ++i) {
    push(answer, request[i]);
  }
  return dialogue_->write(word_at(request, 1), words.view(), arrival);
}

// function, address and count to read (4), address and count to write (4), bytes, words
Refusal RequestHandler::write_and_read(std::span<const std::uint8_t> request, FieldTime arrival,
                                       Pdu& answer, bool& waits) {
  constexpr std::size_t kHead = 10;
  if (request.size() < kHead) {
    return Refusal::kIllegalValue;
  }
  const Range range{word_at(request, 1), word_at(request, 3)};
  const std::int32_t first = word_at(request, 5);
  const std::int32_t count = word_at(request, 7);
  const auto bytes = static_cast<std::size_t>(2 * count);
  if (range.count < 1 || range.count > kMostRead || count < 1 || count > kMostWrittenAndRead ||
      request[9] != bytes || request.size() != kHead + bytes) {
    return Refusal::kIllegalValue;
  }
  // Before the write: one that cannot be answered must not have been obeyed.
  if (const Refusal refusal = Dialogue::check_readable(range.first, range.count);
      refusal != Refusal::kNone) {
    return refusal;
  }
  const Words words(request.subspan(kHead));
  const std::uint32_t before = dialogue_->claims_taken();
  if (const Refusal refusal = dialogue_->write(first, words.view(), arrival);
      refusal != Refusal::kNone) {
    return refusal;
  }
  waits = dialogue_->claims_taken() != before;
  awaited_ = range;
  if (!waits) {
    answer_range(kWriteAndRead, range, arrival, answer);
  }
  return Refusal::kNone;
}

}  // namespace tubesight::drivers
