#include "board/bench/devices/serial_ports.h"

#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"

namespace tubesight::board {
namespace {

namespace fs = std::filesystem;

/// A /sys and a /dev of our own.
class SerialPortsTest : public ::testing::Test {
 protected:
  void write(const std::string& name, const std::string& text) {
    fs::create_directories(fs::path(folder_.path(name)).parent_path());
    folder_.write(name, text);
  }
  void link(const std::string& name, const std::string& to) {
    fs::create_directories(fs::path(folder_.path(name)).parent_path());
    fs::create_symlink(to, folder_.path(name));
  }
  /// As Linux 6.1 lays out an FTDI adapter.
  void plug_in_adapter() {
    const std::string usb = "sys/devices/pci0000:00/0000:00:14.0/usb1/1-2/";
    write(usb + "idVendor", "0403\n");
    write(usb + "idProduct", "6001\n");
    write(usb + "manufacturer",
          "FT\x01"
          "DI\n");
    write(usb + "product", "FT232R USB UART\n");
    write(usb + "1-2:1.0/ttyUSB0/tty/ttyUSB0/dev", "188:0\n");
    link(usb + "1-2:1.0/ttyUSB0/driver", "../../../../../../../bus/usb-serial/drivers/ftdi_sio");
    link(usb + "1-2:1.0/ttyUSB0/tty/ttyUSB0/device", "../../../ttyUSB0");
    link("sys/class/tty/ttyUSB0",
         "../../devices/pci0000:00/0000:00:14.0/usb1/1-2/1-2:1.0/ttyUSB0/tty/ttyUSB0");
  }

  support::TemporaryFolder folder_;
};

TEST_F(SerialPortsTest, AnAdapterIsNamedByItsId) {
  plug_in_adapter();
  link("dev/serial/by-id/usb-FTDI_FT232R_A1-if00-port0", "../../ttyUSB0");

  const auto ports = list_serial_ports(folder_.path(""));

  ASSERT_EQ(ports.size(), 1U);
  EXPECT_EQ(ports[0].path, "/dev/serial/by-id/usb-FTDI_FT232R_A1-if00-port0");
  EXPECT_EQ(ports[0].name, "ttyUSB0");
  EXPECT_EQ(ports[0].driver, "ftdi_sio");
  EXPECT_EQ(ports[0].vendor, "FTDI");
  EXPECT_EQ(ports[0].product, "FT232R USB UART");
  EXPECT_EQ(serial_ports_text(ports),
            "serial ports, by the path to write into the settings:\n"
            "  /dev/serial/by-id/usb-FTDI_FT232R_A1-if00-port0\n"
            "      ttyUSB0, driver ftdi_sio, FTDI FT232R USB UART\n");
}

TEST_F(SerialPortsTest, WithoutAnIdItIsNamedAsItStands) {
  plug_in_adapter();

  const auto ports = list_serial_ports(folder_.path(""));

  ASSERT_EQ(ports.size(), 1U);
  EXPECT_EQ(ports[0].path, "/dev/ttyUSB0");
}

TEST_F(SerialPortsTest, PortsOfTheBoardCountWhereTheyHaveHardware) {
  for (const std::string name : {"ttyS0", "ttyS1"}) {
    const std::string port = "sys/devices/pnp0/00:01/tty/" + name + "/";
    write(port + "type", name == "ttyS0" ? "4\n" : "0\n");
    link(port + "device", "../../../00:01");
    link("sys/class/tty/" + name, "../../devices/pnp0/00:01/tty/" + name);
  }
  link("sys/devices/pnp0/00:01/driver", "../../../bus/pnp/drivers/serial");
  write("sys/devices/virtual/tty/tty1/dev", "4:1\n");
  link("sys/class/tty/tty1", "../../devices/virtual/tty/tty1");

  const auto ports = list_serial_ports(folder_.path(""));

  ASSERT_EQ(ports.size(), 1U);
  EXPECT_EQ(ports[0].path, "/dev/ttyS0");
  EXPECT_EQ(ports[0].driver, "serial");
  EXPECT_EQ(ports[0].vendor, "");
  EXPECT_EQ(serial_ports_text(ports),
            "serial ports, by the path to write into the settings:\n"
            "  /dev/ttyS0\n      ttyS0, driver serial\n");
}

TEST_F(SerialPortsTest, AMachineWithoutPortsIsNoError) {
  EXPECT_TRUE(list_serial_ports(folder_.path("")).empty());
  EXPECT_EQ(serial_ports_text({}), "no serial ports\n");
}

}  // namespace
}  // namespace tubesight::board
