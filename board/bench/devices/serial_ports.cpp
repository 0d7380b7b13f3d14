#include "board/bench/devices/serial_ports.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <system_error>

namespace tubesight::board {
namespace {

namespace fs = std::filesystem;

/// The first line of a small file; empty where there is none. What devices say of themselves may
/// be anything: only printable ASCII is passed on.
std::string first_line(const fs::path& path) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  std::erase_if(line, [](unsigned char c) { return c < 0x20 || c > 0x7e; });
  return line;
}

std::vector<fs::path> entries(const fs::path& folder) {
  std::vector<fs::path> found;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    found.push_back(entry->path());
  }
  std::sort(found.begin(), found.end());
  return found;
}

/// Names of devices with the links of /dev/serial/by-id that lead to them; of several the first.
std::map<std::string, std::string> names_by_id(const fs::path& root) {
  std::map<std::string, std::string> found;
  for (const fs::path& link : entries(root / "dev/serial/by-id")) {
    std::error_code error;
    const fs::path to = fs::read_symlink(link, error);
    if (!error) {
      found.try_emplace(to.filename().string(), "/dev/serial/by-id/" + link.filename().string());
    }
  }
  return found;
}

/// Who made it: the nearest device above the port that says so, of USB in words or numbers, of
/// other buses in numbers.
void read_maker(fs::path device, const fs::path& top, SerialPort& port) {
  for (int level = 0; level < 8 && device != top && device.has_relative_path(); ++level) {
    const bool usb = !first_line(device / "idVendor").empty();
    const char* const vendor = usb ? "idVendor" : "vendor";
    const char* const product = usb ? "idProduct" : "device";
    port.vendor = first_line(device / "manufacturer");
    port.product = first_line(device / "product");
    std::error_code ignored;
    if (port.vendor.empty()) {
      port.vendor = first_line(device / vendor);
    }
    if (port.product.empty() && fs::is_regular_file(device / product, ignored)) {
      port.product = first_line(device / product);
    }
    if (usb || !port.vendor.empty()) {
      return;
    }
    port.product.clear();
    device = device.parent_path();
  }
}

/// Ports that the 8250 driver keeps ready without hardware have the type 0; other drivers say none.
bool has_hardware(const fs::path& tty) {
  std::error_code error;
  return fs::exists(tty / "device", error) && first_line(tty / "type") != "0";
}

}  // namespace

std::vector<SerialPort> list_serial_ports(const std::string& root) {
  const fs::path top = root.empty() ? fs::path("/") : fs::path(root);
  const auto by_id = names_by_id(top);
  std::vector<SerialPort> ports;
  for (const fs::path& tty : entries(top / "sys/class/tty")) {
    if (!has_hardware(tty)) {
      continue;
    }
    SerialPort port;
    port.name = tty.filename().string();
    const auto link = by_id.find(port.name);
    port.path = link != by_id.end() ? link->second : "/dev/" + port.name;
    std::error_code error;
    const fs::path driver = fs::read_symlink(tty / "device/driver", error);
    port.driver = error ? "" : driver.filename().string();
    const fs::path device = fs::canonical(tty / "device", error);
    if (!error) {
      read_maker(device, top, port);
    }
    ports.push_back(port);
  }
  return ports;
}

std::string serial_ports_text(const std::vector<SerialPort>& ports) {
  if (ports.empty()) {
    return "no serial ports\n";
  }
  std::string text = "serial ports, by the path to write into the settings:\n";
  for (const SerialPort& port : ports) {
    text += "  " + port.path + "\n      " + port.name;
    text += port.driver.empty() ? "" : ", driver " + port.driver;
    text += port.vendor.empty() && port.product.empty() ? "" : ", " + port.vendor;
    text += (port.product.empty() ? "" : " " + port.product) + "\n";
  }
  return text;
}

}  // namespace tubesight::board
