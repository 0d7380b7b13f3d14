#include "board/visionbox/page_settings.h"

#include <array>

#include <arpa/inet.h>

#include "board/visionbox/settings_path.h"
#include "drivers/settings/text_files.h"
#include "drivers/web/page_certificate.h"
#include "drivers/web/site_names.h"

namespace tubesight::board {
namespace {

constexpr drivers::WholeRange kPort{1, 65'535};
constexpr std::size_t kMostNames = 16;

bool is_address(const std::string& text) {
  std::array<unsigned char, sizeof(in6_addr)> bytes{};
  return inet_pton(AF_INET, text.c_str(), bytes.data()) == 1 ||
         inet_pton(AF_INET6, text.c_str(), bytes.data()) == 1;
}

bool is_name(const std::string& text) {
  return !text.empty() && text.size() <= 253 &&
         text.find_first_not_of(
             "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789.-_[]:") ==
             std::string::npos;
}

/// The text of a file under a key; false where there is no such key, or no such file.
bool read_text(const drivers::SettingsDocument& document, drivers::TableReader& table,
               std::string_view key, std::string& text) {
  std::string name;
  if (!table.optional_text(key, name) || name.empty()) {
    return false;
  }
  const std::string path = from_its_folder(document, table, key, name);
  drivers::DiskFiles files;
  std::string message;
  if (!files.read(path, text, message)) {
    table.complain(key, "'" + path + "' cannot be read: " + message);
    return false;
  }
  return true;
}

void read_certificate(const drivers::SettingsDocument& document, drivers::TableReader& table,
                      PageSettings& page) {
  drivers::PageCertificate pair;
  const bool certificate = read_text(document, table, "certificate", pair.certificate);
  const bool key = read_text(document, table, "key", pair.key);
  if (certificate != key) {
    if (table.sound("certificate") && table.sound("key")) {
      table.complain(certificate ? "certificate" : "key", "alone, expected certificate and key");
    }
    return;
  }
  std::string message;
  if (certificate && !drivers::check_certificate(pair, message)) {
    table.complain("certificate",
                   message + ", expected what `tubesightctl page-certificate` makes");
    return;
  }
  page.server.certificate = pair.certificate;
  page.server.key = pair.key;
  page.fingerprint = pair.fingerprint;
}

void read_passwords(const drivers::SettingsDocument& document, drivers::TableReader& table,
                    PageSettings& page) {
  std::string name;
  if (!table.optional_text("passwords", name) || name.empty()) {
    return;
  }
  page.passwords_file = from_its_folder(document, table, "passwords", name);
  if (!page.passwords.load(page.passwords_file)) {
    table.complain("passwords", page.passwords.message());
  } else if (page.passwords.empty()) {
    table.complain("passwords", "'" + page.passwords_file +
                                    "' has none, expected one that `tubesightctl page-password` "
                                    "wrote");
  }
}

}  // namespace

void read_page(const drivers::SettingsDocument& document, drivers::TableReader& table,
               PageSettings& page) {
  page.wanted = true;
  table.optional_text("address", page.server.address);
  if (table.sound("address") && !is_address(page.server.address)) {
    table.complain("address", "'" + page.server.address +
                                  "' is no address, expected one such as 127.0.0.1 or 0.0.0.0");
  }
  table.optional_whole("port", kPort, page.server.port);
  table.optional_texts("names", page.names);
  for (const std::string& name : page.names) {
    if (!is_name(name) || page.names.size() > kMostNames) {
      table.complain("names", "'" + name + "', expected up to 16 names of this box without a port");
      break;
    }
  }
  read_certificate(document, table, page);
  read_passwords(document, table, page);
  if (!table.sound("address") || drivers::is_loopback(page.server.address)) {
    return;
  }
  if (page.passwords_file.empty() && table.sound("passwords")) {
    table.complain("address",
                   "others than this machine would be served without a password, "
                   "expected passwords, or 127.0.0.1");
  }
  if (page.server.certificate.empty() && table.sound("certificate") && table.sound("key")) {
    table.complain("address",
                   "passwords would cross the network in clear, expected certificate "
                   "and key, or 127.0.0.1");
  }
}

}  // namespace tubesight::board
