#pragma once

#include <string>
#include <vector>

namespace tubesight::board {

/// A serial port as the system knows it; what is not known is empty.
struct SerialPort {
  std::string path;     ///< what settings should name: by id where there is one, as it stays
  std::string name;     ///< "ttyUSB0", which may change from one start to the next
  std::string driver;   ///< "ftdi_sio"
  std::string vendor;   ///< in the maker's words, or as a number: "FTDI", "0403"
  std::string product;  ///< "FT232R USB UART", "6001"
};

/// The serial ports below `root` ("" for this machine's own), by name: those of /sys/class/tty that
/// have hardware behind them. Nothing is opened. Empty where there are none, or no /sys.
[[nodiscard]] std::vector<SerialPort> list_serial_ports(const std::string& root);

/// The list for a person.
[[nodiscard]] std::string serial_ports_text(const std::vector<SerialPort>& ports);

}  // namespace tubesight::board
