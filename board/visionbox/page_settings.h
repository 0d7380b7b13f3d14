#pragma once

#include <string>
#include <vector>

#include "drivers/settings/settings_document.h"
#include "drivers/settings/table_reader.h"
#include "drivers/web/page_passwords.h"
#include "drivers/web/page_server.h"

namespace tubesight::board {

/// The table `[page]`: the operator's page.
struct PageSettings {
  bool wanted = false;                 ///< the table is there
  drivers::PageServerSettings server;  ///< with the texts of certificate and key
  std::vector<std::string> names;      ///< that the plant gives the box, beside its address
  drivers::PagePasswords passwords;    ///< empty: whoever sits at the box itself may do all
  std::string passwords_file;
  std::string fingerprint;  ///< of the certificate; empty: no TLS
  std::string file;         ///< of all settings, as it was read
};

/// Reads the table, and the files that it names. Beyond the machine itself nothing is served
/// without passwords and a certificate.
void read_page(const drivers::SettingsDocument& document, drivers::TableReader& table,
               PageSettings& page);

}  // namespace tubesight::board
