#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace tubesight::drivers {

/// Whether an address is this machine's own for itself alone: 127.x.x.x or ::1.
[[nodiscard]] bool is_loopback(std::string_view address);

/// What the page's site is called: the values of Host and Origin that a browser may come with. A
/// page of another site, or another name that leads to this machine, is refused.
class SiteNames {
 public:
  SiteNames() = default;
  /// `names`: further ones that the plant gives the box; port: where it listens.
  SiteNames(const std::string& address, std::int32_t port, bool tls,
            const std::vector<std::string>& names);

  [[nodiscard]] bool is_host(std::string_view host) const;
  [[nodiscard]] bool is_origin(std::string_view origin) const;
  /// Where a person opens the page.
  [[nodiscard]] std::string link() const;

 private:
  std::vector<std::string> hosts_;  ///< each with its port, the usual one left out as well
  std::string scheme_;
};

}  // namespace tubesight::drivers
