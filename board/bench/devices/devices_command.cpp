#include "board/bench/devices/devices_command.h"

#include "board/bench/devices/serial_ports.h"
#include "board/bench/output/text_output.h"

namespace tubesight::board {

ExitStatus run_devices() {
  return write_out(serial_ports_text(list_serial_ports(""))) ? ExitStatus::kDone
                                                             : ExitStatus::kJobFailed;
}

}  // namespace tubesight::board
