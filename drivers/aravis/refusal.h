#pragma once

#include <string>

#include "drivers/aravis/functions.h"

namespace tubesight::drivers::aravis {

/// What a function of the library says when it refuses; to be asked once after each call.
class Refusal {
 public:
  explicit Refusal(const Functions& functions) : arv_(&functions) {}
  Refusal(const Refusal&) = delete;
  Refusal& operator=(const Refusal&) = delete;
  ~Refusal() { clear(); }

  /// For the library to write to.
  [[nodiscard]] GError** out() {
    clear();
    return &error_;
  }
  /// Whether it refused, with its words.
  [[nodiscard]] bool said(std::string& why) const {
    if (error_ != nullptr) {
      why = error_->message;
    }
    return error_ != nullptr;
  }
  [[nodiscard]] bool said() const { return error_ != nullptr; }

 private:
  void clear() {
    if (error_ != nullptr) {
      arv_->g_error_free(error_);
      error_ = nullptr;
    }
  }

  const Functions* arv_;
  GError* error_ = nullptr;
};

}  // namespace tubesight::drivers::aravis
