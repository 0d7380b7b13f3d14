#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "board/visionbox/page_json.h"
#include "board/visionbox/page_settings.h"
#include "board/visionbox/source_clock.h"
#include "drivers/web/login_throttle.h"
#include "drivers/web/page_server.h"
#include "drivers/web/page_sessions.h"
#include "drivers/web/site_names.h"

namespace tubesight::board {

[[nodiscard]] drivers::PageAnswer json_answer(const Json& json, unsigned status = 200);
[[nodiscard]] drivers::PageAnswer error_answer(unsigned status, std::string_view words);

/// Who may ask the page for what. One thread, but for what the caller guards.
class PageAccess {
 public:
  /// `settings` outlive this; `port`: where it is served.
  PageAccess(const PageSettings& settings, std::int32_t port);

  /// Refuses a request that comes to another name than the page's, from another site's page, from
  /// nobody who may, or without the token of its session.
  [[nodiscard]] std::optional<drivers::PageAnswer> refuse(const drivers::PageRequest& request,
                                                          MonotonicTime now);

  /// Whether passwords are asked.
  [[nodiscard]] bool asks_passwords() const { return !settings_->passwords.empty(); }
  [[nodiscard]] drivers::PageRole role(const drivers::PageRequest& request, MonotonicTime now);
  [[nodiscard]] drivers::PageSessions& sessions() { return sessions_; }
  [[nodiscard]] drivers::LoginThrottle& throttle() { return throttle_; }
  [[nodiscard]] const drivers::SiteNames& names() const { return names_; }
  [[nodiscard]] bool is_right(drivers::PageRole role, const std::string& password) const {
    return settings_->passwords.is_right(role, password);
  }

 private:
  [[nodiscard]] std::optional<drivers::PageAnswer> refuse_change(
      const drivers::PageRequest& request, MonotonicTime now);

  const PageSettings* settings_;
  drivers::SiteNames names_;
  drivers::PageSessions sessions_;
  drivers::LoginThrottle throttle_;
};

}  // namespace tubesight::board
