#include "board/box/box_loop.h"

#include "core/base/assert.h"

namespace tubesight::board {
namespace {

using core::Error;
using core::Result;
using core::Unexpected;

/// Garbled messages that one turn looks past: a line of noise must not keep the field waiting.
constexpr std::int32_t kMostGarbled = core::kMaxEventsPerField;

/// That of a frame's other field.
constexpr core::Parity other(core::Parity parity) {
  switch (parity) {
    case core::Parity::kEven: return core::Parity::kOdd;
    case core::Parity::kOdd: return core::Parity::kEven;
    case core::Parity::kProgressive: break;
  }
  return core::Parity::kProgressive;
}

}  // namespace

template <core::Scalar S, typename Margin>
BoxLoop<S, Margin>::BoxLoop(core::session::Session<S, Margin>& session, const BoxPorts& ports,
                            const BoxServices& services)
    : session_(&session), ports_(ports), services_(services) {
  TUBESIGHT_ASSERT(ports.grabber != nullptr && ports.clock != nullptr);
}

template <core::Scalar S, typename Margin>
Result<void> BoxLoop<S, Margin>::start() {
  if (started_) {
    return Unexpected(Error::kNotReady);
  }
  const auto started = [this]() -> Result<void> {
    if (ports_.dimmer != nullptr) {
      TUBESIGHT_TRY(ports_.dimmer->start());
      TUBESIGHT_TRY(ports_.dimmer->set_level(hal::kFullLevel_permille));
      session_->take_lamp(services_.lamp);
    }
    if (ports_.link != nullptr) {
      TUBESIGHT_TRY(ports_.link->start());
    }
    return ports_.station != nullptr ? ports_.station->start() : Result<void>();
  }();
  started_ = true;
  if (!started) {
    stop();
  } else if (services_.recorder != nullptr) {
    keep_state();
  }
  return started;
}

template <core::Scalar S, typename Margin>
void BoxLoop<S, Margin>::stop() {
  if (!started_) {
    return;
  }
  started_ = false;
  if (ports_.station != nullptr) {
    ports_.station->stop();
  }
  if (ports_.link != nullptr) {
    ports_.link->stop();
  }
  if (ports_.dimmer != nullptr) {
    ports_.dimmer->stop();
  }
}

template <core::Scalar S, typename Margin>
Result<void> BoxLoop<S, Margin>::turn(std::chrono::milliseconds timeout) {
  if (frame_half_missing_) {
    turn_without_field();
    return {};
  }
  const auto lease = ports_.grabber->grab_for(timeout);
  if (lease) {
    core::Field field = lease->field();
    number(field);
    take(field);
    return {};
  }
  if (lease.error() != Error::kTimeout) {
    return Unexpected(lease.error());
  }
  turn_without_field();
  return {};
}

template <core::Scalar S, typename Margin>
void BoxLoop<S, Margin>::turn_without_field() {
  const bool progressive = parity_ == core::Parity::kProgressive;
  core::Field field;
  field.status = core::FieldStatus::kMissing;
  field.mid_exposure = ports_.clock->now();
  field.lamp_permille = input_.field.lamp_permille;
  // Files count two numbers a frame, of which a progressive one uses the first.
  const std::int64_t numbers = progressive ? 2 : 1;
  field.number = last_number_ + (last_number_ < 0 ? 1 : numbers);
  if (!progressive) {
    field.parity = field.number % 2 == 0 ? first_parity_ : other(first_parity_);
  } else {
    field.parity = core::Parity::kProgressive;
  }
  number_shift_ += numbers;
  frame_half_missing_ = !progressive && !frame_half_missing_;
  ++counters_.missing;
  take(field);
}

/// Numbers go on where missing fields took some, and where a grabber that was started anew counts
/// from 0 again. They are shifted by whole frames, so that an earlier field's stays even.
template <core::Scalar S, typename Margin>
void BoxLoop<S, Margin>::number(core::Field& field) {
  const std::int64_t behind = last_number_ + 1 - (field.number + number_shift_);
  if (behind > 0) {
    number_shift_ += behind + behind % 2;
  }
  field.number += number_shift_;
  parity_ = field.parity;
  first_parity_ = field.number % 2 == 0 ? parity_ : other(parity_);
}

template <core::Scalar S, typename Margin>
void BoxLoop<S, Margin>::take(const core::Field& field) {
  input_.field = field;
  last_number_ = field.number;
  input_.lamp_dimmed = ports_.dimmer != nullptr;
  if (input_.lamp_dimmed) {
    input_.field.lamp_permille = ports_.lamp_history == nullptr
                                     ? ports_.dimmer->level_permille()
                                     : ports_.lamp_history->level_permille_at(field.mid_exposure);
  }
  gather_events();
  session_->step(input_, output_);
  ++counters_.fields;
  answer();
  set_lamp();
  serve_poses();
  publish();
  if (services_.journal != nullptr) {
    services_.journal->take(input_, output_);
  }
  record();
}

/// The events since the last field in time order, as many as a step takes; the others wait where
/// they are.
template <core::Scalar S, typename Margin>
void BoxLoop<S, Margin>::gather_events() {
  input_.events.clear();
  asked_enough_.fill(false);
  garbled_now_ = 0;
  while (!input_.events.full()) {
    // Asked anew after each event, as ports may know an order among themselves: those of a
    // recording hand out its rows one after the other.
    fetch(kLink);
    fetch(kStation);
    fetch(kPoses);
    std::optional<core::Event>* const next = earliest();
    if (next == nullptr) {
      return;
    }
    static_cast<void>(input_.events.try_push_back(**next));  // there is room
    next->reset();
  }
}

template <core::Scalar S, typename Margin>
void BoxLoop<S, Margin>::fetch(Source source) {
  if (next_[source] || asked_enough_[source]) {
    return;
  }
  if (source == kLink) {
    fetch_from(ports_.link, source, counters_.link);
  } else if (source == kStation) {
    fetch_from(ports_.station, source, counters_.station);
  } else if (services_.poses != nullptr) {
    next_[source] = services_.poses->take_result();
  }
  if (next_[source] && !next_[source]->at) {
    next_[source]->at = ports_.clock->now();
  }
}

template <core::Scalar S, typename Margin>
template <typename Port>
void BoxLoop<S, Margin>::fetch_from(Port* port, Source source, PortCounters& counters) {
  while (port != nullptr) {
    const auto polled = port->poll_event();
    if (polled) {
      next_[source] = *polled;
      return;
    }
    if (polled.error() != Error::kDataLoss) {
      ++counters.gone;
      break;
    }
    ++counters.garbled;
    if (++garbled_now_ >= kMostGarbled) {
      break;
    }
  }
  asked_enough_[source] = true;
}

template <core::Scalar S, typename Margin>
std::optional<core::Event>* BoxLoop<S, Margin>::earliest() {
  std::optional<core::Event>* first = nullptr;
  for (std::optional<core::Event>& event : next_) {
    if (event && (first == nullptr || event->at < (*first)->at)) {
      first = &event;
    }
  }
  return first;
}

template <core::Scalar S, typename Margin>
void BoxLoop<S, Margin>::answer() {
  for (const core::Reply& reply : output_.replies) {
    if (reply.origin == core::EventOrigin::kRobot) {
      send(ports_.link, reply, counters_.link);
    } else {
      send(ports_.station, reply, counters_.station);
    }
  }
  if (ports_.link != nullptr) {
    // A line that is gone was counted when it was polled, and the next sighting replaces this.
    static_cast<void>(ports_.link->send_sighting(output_.sighting));
  }
}

/// Whoever gets no answer asks again.
template <core::Scalar S, typename Margin>
template <typename Port>
void BoxLoop<S, Margin>::send(Port* port, const core::Reply& reply, PortCounters& counters) {
  if (port == nullptr || !port->send_reply(reply)) {
    ++counters.lost_replies;
  }
}

/// A level that the dimmer refused is tried again after the next field. A session that nobody told
/// a level wants what is in force, which on the way to another level says nothing.
template <core::Scalar S, typename Margin>
void BoxLoop<S, Margin>::set_lamp() {
  if (ports_.dimmer == nullptr) {
    return;
  }
  const std::int32_t wanted = output_.lamp_permille;
  const bool meant = output_.lamp_ruled || wanted != input_.field.lamp_permille;
  if (meant && wanted != ports_.dimmer->level_permille() && !ports_.dimmer->set_level(wanted)) {
    ++counters_.dimmer_errors;
  }
}

template <core::Scalar S, typename Margin>
void BoxLoop<S, Margin>::serve_poses() {
  if (services_.poses != nullptr) {
    services_.poses->take(input_.field, input_.field.number, output_.order);
  }
  if (services_.pairs != nullptr) {
    services_.pairs->take(input_.events, output_.replies);
  }
}

template <core::Scalar S, typename Margin>
void BoxLoop<S, Margin>::publish() {
  if (services_.view != nullptr) {
    services_.view->take(input_.field);
  }
  if (services_.overlay != nullptr || services_.tap != nullptr) {
    publish_marks();
  }
}

template <core::Scalar S, typename Margin>
void BoxLoop<S, Margin>::publish_marks() {
  PictureTap* const tap = services_.tap;
  const bool estimates = services_.estimates || (tap != nullptr && tap->estimates_wanted());
  news_.take(input_, output_);
  describe<S>(*session_, output_, news_, input_.field.number, estimates, overlay_);
  if (services_.overlay != nullptr) {
    services_.overlay->publish(overlay_);
  }
  if (tap != nullptr && tap->wanted()) {
    tap->take(input_.field, overlay_);
  }
}

/// Last of all, when everybody has his answer.
template <core::Scalar S, typename Margin>
void BoxLoop<S, Margin>::record() {
  if (services_.recorder != nullptr) {
    services_.recorder->take(input_, output_);
    keep_state();
  }
}

/// Before the next step, where the recorder wants to begin a segment with it.
template <core::Scalar S, typename Margin>
void BoxLoop<S, Margin>::keep_state() {
  const std::span<std::byte> into = services_.recorder->state_wanted();
  if (!into.empty()) {
    services_.recorder->put_state(session_->save(into).value_or(0));
  }
}

TUBESIGHT_INSTANTIATE_POLICY_CLASS(BoxLoop)

}  // namespace tubesight::board
