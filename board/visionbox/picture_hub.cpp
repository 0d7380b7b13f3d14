#include "board/visionbox/picture_hub.h"

#include <utility>

namespace tubesight::board {

bool PictureHub::ask(std::int64_t after, MonotonicTime now, Deliver deliver) {
  const std::lock_guard lock(mutex_);
  if (waiting_.size() >= kMostWaiting) {
    return false;
  }
  if (now - looked_at_ > kLooked) {
    latest_.reset();  // of the time when somebody looked last
  }
  looked_at_ = now;
  tap_->want(true, now - estimates_at_ <= kLooked);
  waiting_.push_back({after, now + kPatience, std::move(deliver)});
  return true;
}

void PictureHub::want_estimates(MonotonicTime now) {
  const std::lock_guard lock(mutex_);
  estimates_at_ = now;
}

PictureHub::Picture PictureHub::latest() const {
  const std::lock_guard lock(mutex_);
  return latest_;
}

void PictureHub::take_fields() {
  Picture made;
  while (const PictureTap::Taken* const taken = tap_->front()) {
    view_.take(taken->field);
    const bool last = made == nullptr || taken->field.number > made->field();
    if (last) {
      made = std::make_shared<const PagePicture>(view_.picture(), taken->overlay);
    }
    tap_->pop();
  }
  if (made != nullptr) {
    const std::lock_guard lock(mutex_);
    latest_ = made;
  }
}

bool PictureHub::serve(MonotonicTime now) {
  take_fields();
  std::vector<std::pair<Deliver, Picture>> due;
  bool looked_at = false;
  {
    const std::lock_guard lock(mutex_);
    looked_at = now - looked_at_ <= kLooked;
    tap_->want(looked_at, looked_at && now - estimates_at_ <= kLooked);
    std::erase_if(waiting_, [&](Waiting& each) {
      const bool served = latest_ != nullptr && latest_->field() > each.after;
      if (served || now > each.until) {
        due.emplace_back(std::move(each.deliver), served ? latest_ : nullptr);
        return true;
      }
      return false;
    });
  }
  for (const auto& [deliver, picture] : due) {
    deliver(picture);
  }
  return looked_at;
}

}  // namespace tubesight::board
