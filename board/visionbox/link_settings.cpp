#include "board/visionbox/link_settings.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>

#include <arpa/inet.h>
#include <netinet/in.h>

#include "board/visionbox/refused_keys.h"

namespace tubesight::board {
namespace {

using drivers::TableReader;

constexpr std::array<std::string_view, 2> kLinkKinds = {"none", "modbus"};
constexpr std::array<std::string_view, 3> kParities = {"none", "even", "odd"};
constexpr std::array<std::string_view, 2> kWordOrders = {"high-first", "low-first"};

constexpr std::array<std::string_view, 5> kLineKeys = {"device", "baud", "parity", "stop_bits",
                                                       "rs485"};
constexpr std::array<std::string_view, 4> kOtherKeys = {"unit", "word_order", "tcp_address",
                                                        "tcp_port"};

/// Any other rate would be opened as 9600 without a word.
constexpr std::array<std::int32_t, 11> kBauds = {1200,   2400,    4800,    9600,    19'200, 38'400,
                                                 57'600, 115'200, 230'400, 460'800, 921'600};
constexpr drivers::WholeRange kBaud{kBauds.front(), kBauds.back()};
constexpr drivers::WholeRange kStopBits{1, 2};
constexpr drivers::WholeRange kUnit{1, 247};
constexpr drivers::WholeRange kPort{1, 65535};
constexpr std::size_t kLongestDevice = 255;

/// What stands there and can never be a line, in words; nothing where nothing is: a line that is
/// not plugged in yet, or settings for another machine.
std::string no_line_at(const std::string& path) {
  std::error_code unknown;
  switch (std::filesystem::status(path, unknown).type()) {
    case std::filesystem::file_type::directory: return "a folder";
    case std::filesystem::file_type::regular: return "a file";
    default: return {};
  }
}

void read_line(TableReader& table, drivers::SerialSettings& line) {
  std::size_t parity = static_cast<std::size_t>(line.parity);
  if (table.text("device", line.device) &&
      (line.device.empty() || line.device.size() > kLongestDevice || line.device[0] != '/')) {
    table.complain("device",
                   "'" + line.device + "', expected a path from the root of up to 255 bytes");
  } else if (const std::string what = no_line_at(line.device); !what.empty()) {
    table.complain("device", "'" + line.device + "' is " + what + ", expected a serial line");
  }
  if (table.optional_whole("baud", kBaud, line.baud) &&
      std::ranges::find(kBauds, line.baud) == kBauds.end()) {
    table.complain("baud", std::to_string(line.baud) +
                               ", expected a usual rate: 9600, 19200, 38400, 57600, 115200 …");
  }
  if (table.optional_word("parity", kParities, parity)) {
    line.parity = static_cast<drivers::SerialParity>(parity);
  }
  table.optional_whole("stop_bits", kStopBits, line.stop_bits);
  table.optional_switch("rs485", line.rs485);
}

void read_tcp(TableReader& table, drivers::ModbusSettings& modbus) {
  table.whole("tcp_port", kPort, modbus.tcp_port);
  in_addr address{};
  if (table.optional_text("tcp_address", modbus.tcp_address) &&
      inet_pton(AF_INET, modbus.tcp_address.c_str(), &address) != 1) {
    table.complain("tcp_address", "'" + modbus.tcp_address +
                                      "', expected four numbers: \"127.0.0.1\" for this machine "
                                      "alone, \"0.0.0.0\" for all that reach it");
  }
}

void read_modbus(TableReader& table, drivers::ModbusSettings& modbus) {
  std::int32_t unit = modbus.serial.unit;
  if (table.optional_whole("unit", kUnit, unit)) {
    modbus.serial.unit = static_cast<std::uint8_t>(unit);
  }
  std::size_t order = static_cast<std::size_t>(modbus.word_order);
  if (table.optional_word("word_order", kWordOrders, order)) {
    modbus.word_order = static_cast<drivers::WordOrder>(order);
  }
  const bool line = table.has("device");
  const bool tcp = table.has("tcp_port");
  if (!line && !tcp) {
    table.complain("kind", "modbus without a line, expected a device, a tcp_port or both");
  }
  if (line) {
    read_line(table, modbus.serial.line);
  } else {
    refuse_keys(table, kLineKeys, "of a serial line, which needs a device");
  }
  if (tcp) {
    read_tcp(table, modbus);
  } else {
    refuse_keys(table, std::array<std::string_view, 2>{"tcp_address", "tcp_port"},
                "of TCP, which needs a tcp_port");
  }
}

}  // namespace

void read_link(TableReader& table, LinkSettings& link) {
  std::size_t kind = 0;
  if (!table.word("kind", kLinkKinds, kind)) {
    ignore_keys(table, kLineKeys);
    ignore_keys(table, kOtherKeys);
    return;
  }
  link.kind = static_cast<LinkKind>(kind);
  if (link.kind == LinkKind::kModbus) {
    read_modbus(table, link.modbus);
  } else {
    refuse_keys(table, kLineKeys, "of another kind of link");
    refuse_keys(table, kOtherKeys, "of another kind of link");
  }
}

}  // namespace tubesight::board
