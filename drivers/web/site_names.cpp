#include "drivers/web/site_names.h"

#include <algorithm>

namespace tubesight::drivers {
namespace {

std::string small(std::string_view text) {
  std::string made(text);
  std::transform(made.begin(), made.end(), made.begin(), [](char letter) {
    return letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
  });
  return made;
}

std::string in_brackets(const std::string& address) {
  return address.find(':') == std::string::npos ? address : "[" + address + "]";
}

}  // namespace

bool is_loopback(std::string_view address) {
  return address == "::1" || (address.starts_with("127.") &&
                              address.find_first_not_of("0123456789.") == std::string_view::npos);
}

SiteNames::SiteNames(const std::string& address, std::int32_t port, bool tls,
                     const std::vector<std::string>& names)
    : scheme_(tls ? "https://" : "http://") {
  std::vector<std::string> all;
  if (address != "0.0.0.0" && address != "::") {
    all.push_back(in_brackets(address));
  }
  all.insert(all.end(), names.begin(), names.end());
  all.insert(all.end(), {"localhost", "127.0.0.1", "[::1]"});
  const std::int32_t usual = tls ? 443 : 80;
  for (const std::string& name : all) {
    hosts_.push_back(small(name) + ":" + std::to_string(port));
    if (port == usual) {
      hosts_.push_back(small(name));
    }
  }
}

bool SiteNames::is_host(std::string_view host) const {
  return std::find(hosts_.begin(), hosts_.end(), small(host)) != hosts_.end();
}

bool SiteNames::is_origin(std::string_view origin) const {
  return origin.starts_with(scheme_) && is_host(origin.substr(scheme_.size()));
}

std::string SiteNames::link() const { return hosts_.empty() ? "" : scheme_ + hosts_.front() + "/"; }

}  // namespace tubesight::drivers
