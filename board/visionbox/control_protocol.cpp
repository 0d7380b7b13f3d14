#include "board/visionbox/control_protocol.h"

#include <charconv>
#include <optional>
#include <vector>

#include "board/box/row_column_text.h"
#include "board/box/start_text.h"
#include "core/base/words.h"
#include "drivers/files/decimal.h"
#include "hal/dimmer.h"

namespace tubesight::board {
namespace {

using drivers::JsonLine;
using Words = std::vector<std::string_view>;

Words split(std::string_view text, char separator) {
  Words words;
  while (true) {
    const std::size_t end = text.find(separator);
    const std::string_view word = text.substr(0, end);
    if (separator != ' ' || !word.empty()) {
      words.push_back(word);
    }
    if (end == std::string_view::npos) {
      return words;
    }
    text.remove_prefix(end + 1);
  }
}

template <typename Number>
bool parse_whole(std::string_view text, Number least, Number most, Number& value) {
  const auto parsed = std::from_chars(text.data(), text.data() + text.size(), value);
  return parsed.ec == std::errc() && parsed.ptr == text.data() + text.size() && value >= least &&
         value <= most;
}

/// A place in the picture, to 0.001 px; whether it lies in it is the session's business.
bool parse_px(std::string_view text, double& value) {
  constexpr std::int64_t kMost = 100'000'000;  // 100,000 px
  std::int64_t thousandths = 0;
  if (!drivers::parse_decimal(text, 3, thousandths) || thousandths < -kMost ||
      thousandths > kMost) {
    return false;
  }
  value = static_cast<double>(thousandths) / 1000.0;
  return true;
}

constexpr std::int32_t kMostAddress = 100'000;

/// "R,C,U,V;...": false for anything else, and for more than a start can have.
bool parse_tubes(std::string_view text, core::Start& start) {
  for (const std::string_view one : split(text, ';')) {
    const Words parts = split(one, ',');
    core::StartPoint point;
    if (parts.size() != 4 ||
        !parse_whole(parts[0], -kMostAddress, kMostAddress, point.address.row) ||
        !parse_whole(parts[1], -kMostAddress, kMostAddress, point.address.column) ||
        !parse_px(parts[2], point.at_px[0]) || !parse_px(parts[3], point.at_px[1]) ||
        !start.tubes.try_push_back(point)) {
      return false;
    }
  }
  return true;
}

/// "field=N"; false where the word is another one.
bool parse_seen_field(std::string_view word, std::optional<std::int64_t>& seen_field) {
  constexpr std::string_view kField = "field=";
  std::int64_t number = 0;
  if (!word.starts_with(kField) ||
      !parse_whole<std::int64_t>(word.substr(kField.size()), 0, INT64_MAX, number)) {
    return false;
  }
  seen_field = number;
  return true;
}

using Content = decltype(ControlRequest::content);

Content event_of(const auto& what) {
  EventRequest request;
  request.event.origin = core::EventOrigin::kOperator;
  request.event.content = what;
  return request;
}

Content parse_start(const Words& arguments, const core::StartSettings& settings) {
  core::Start start;
  for (const std::string_view word : arguments) {
    if (word == "confirm") {
      start.confirmed = true;
    } else if (!parse_seen_field(word, start.seen_field) &&
               (!start.tubes.empty() || !parse_tubes(word, start))) {
      return WrongRequest{"start: '" + std::string(word.substr(0, 100)) +
                          "', expected R,C,U,V;R,C,U,V;... of at most 8 tubes, field=N or confirm"};
    }
  }
  if (start.tubes.empty()) {
    start.tubes = settings.tubes;
  }
  if (start.tubes.empty()) {
    return WrongRequest{"start: the settings have no [start], expected R,C,U,V;R,C,U,V;..."};
  }
  return event_of(start);
}

Content parse_pick(const Words& arguments) {
  core::Pick pick;
  const Words at = arguments.empty() ? Words() : split(arguments.front(), ',');
  if (arguments.empty() || arguments.size() > 2 || at.size() != 2 ||
      !parse_px(at[0], pick.at_px[0]) || !parse_px(at[1], pick.at_px[1]) ||
      (arguments.size() == 2 && !parse_seen_field(arguments[1], pick.seen_field))) {
    return WrongRequest{"pick: expected U,V in pixels, and perhaps field=N"};
  }
  return event_of(pick);
}

Content parse_lamp(const Words& arguments) {
  core::LampCommand command;
  command.automatic = arguments.size() == 1 && arguments[0] == "auto";
  if (!command.automatic &&
      (arguments.size() != 1 ||
       !parse_whole<std::int32_t>(arguments[0], 0, hal::kFullLevel_permille, command.permille))) {
    return WrongRequest{"lamp: expected a level of 0 to 1000 permille, or auto"};
  }
  return event_of(command);
}

Content without_arguments(const Words& arguments, Content content) {
  return arguments.empty() ? std::move(content)
                           : Content(WrongRequest{"too many words, expected the command alone"});
}

std::string answer_to(std::string_view command, const core::StartReply& reply) {
  const bool taken = reply.refusal == core::StartRefusal::kNone;
  JsonLine line = begin_answer(command, taken);
  if (!taken) {
    line.add("error", core::name_of(reply.refusal));
  }
  return line
      .add("text", taken ? std::string("taken: the box tracks") : "refused: " + refusal_text(reply))
      .finish();
}

std::string answer_to(std::string_view command, const core::PickReply& reply) {
  const bool named = reply.doubt == core::PickDoubt::kNone;
  JsonLine line = begin_answer(command, named);
  if (!named) {
    line.add("error", core::name_of(reply.doubt));
    return line.add("text", core::explain(reply.doubt)).finish();
  }
  line.add("tube", row_column_text(reply.tube));
  return line.add("text", "tube " + row_column_text(reply.tube)).finish();
}

std::string answer_to(std::string_view command, const core::LampReply& reply) {
  return begin_answer(command, true)
      .add("permille", reply.permille)
      .add("automatic", reply.automatic)
      .add("text", std::to_string(reply.permille) +
                       (reply.automatic ? " permille now, by the picture from now on"
                                        : " permille wanted from now on"))
      .finish();
}

std::string answer_to(std::string_view command, const auto& /*other*/) {
  return refusal_answer(command, "the box does not serve that");
}

}  // namespace

JsonLine begin_answer(std::string_view command, bool ok) {
  JsonLine line;
  line.add("protocol", kControlVersion).add("ok", ok).add("command", command);
  return line;
}

std::string refusal_answer(std::string_view command, std::string_view error) {
  return begin_answer(command, false).add("error", error).add("text", error).finish();
}

std::string recorded_answer(std::string_view path) {
  return begin_answer("record", true)
      .add("path", path)
      .add("text", "written: " + std::string(path) + ".y4m")
      .finish();
}

ControlRequest parse_request(std::string_view line, const core::StartSettings& start) {
  Words words = split(line, ' ');
  if (words.empty() || words.front() != std::to_string(kControlVersion)) {
    return {"", WrongRequest{"unknown version, expected a line that begins with '1 '"}};
  }
  if (words.size() < 2) {
    return {"", WrongRequest{"no command, expected status, start, pick, lamp, record or "
                             "self-test"}};
  }
  const std::string_view command = words[1];
  words.erase(words.begin(), words.begin() + 2);
  const auto request = [&](Content content) {
    return ControlRequest{std::string(command), std::move(content)};
  };
  if (command == "status") {
    return request(without_arguments(words, StatusRequest{}));
  }
  if (command == "self-test") {
    return request(without_arguments(words, SelfTestRequest{}));
  }
  if (command == "record") {
    return request(without_arguments(words, RecordRequest{}));
  }
  if (command == "start") {
    return request(parse_start(words, start));
  }
  if (command == "pick") {
    return request(parse_pick(words));
  }
  if (command == "lamp") {
    return request(parse_lamp(words));
  }
  return {"", WrongRequest{"unknown command, expected status, start, pick, lamp, record or "
                           "self-test"}};
}

std::string reply_answer(std::string_view command, const core::Reply& reply) {
  return std::visit([&](const auto& content) { return answer_to(command, content); },
                    reply.content);
}

}  // namespace tubesight::board
